"""Alerts by POST to an address on the web, signed so that the receiver knows who tells."""

import hashlib
import hmac
import http.client
import json
import ssl
import time
import urllib.error
import urllib.request
from collections.abc import Sequence
from typing import Any
from urllib.parse import urlsplit

from stommel.station.alarms.alert_policy import Alert
from stommel.station.alarms.alert_settings import WebhookSettings, is_this_machine
from stommel.station.alarms.alert_words import Sender, subject, text
from stommel.station.alarms.delivery import PATIENCE_S, DeliveryError, reason_of, secret_of

SIGNATURE = "X-Stommel-Signature"
"""Header: `sha256=` and the HMAC-SHA256 of the body with the secret, in hexadecimal."""


class _NoRedirect(urllib.request.HTTPRedirectHandler):
    """Goes nowhere else than where it was told to."""

    def redirect_request(self, *_: Any) -> None:
        """Refuse."""


class WebhookWay:
    """Tells one address."""

    def __init__(self, settings: WebhookSettings, sender: Sender) -> None:
        self._settings, self._sender = settings, sender
        self._host = urlsplit(settings.url).hostname or ""

    @property
    def name(self) -> str:
        """What people call it: the address may hold a secret in its path, so only the host."""
        return f"webhook at {self._host}"

    @property
    def file(self) -> str:
        """By the whole address, of which it tells nothing."""
        return f"webhook-{hashlib.sha256(self._settings.url.encode()).hexdigest()[:16]}"

    def send(self, alerts: Sequence[Alert]) -> None:
        """Send one message with all of them.

        Raises
        ------
        DeliveryError
            It was not taken with a status of 200 to 299.
        """
        body = self._body(alerts)
        headers = {"Content-Type": "application/json", "User-Agent": "stommel"}
        if self._settings.secret_file is not None:
            headers[SIGNATURE] = signature(secret_of(self._settings.secret_file), body)
        request = urllib.request.Request(self._settings.url, body, headers, method="POST")
        try:
            with self._opener().open(request, timeout=PATIENCE_S):
                pass
        except urllib.error.HTTPError as error:
            error.close()
            led = "; it leads elsewhere, which is not followed" if 300 <= error.code < 400 else ""
            raise DeliveryError(f"{self.name}: answers {error.code}{led}") from error
        except urllib.error.URLError as error:
            reason = reason_of(error.reason) if isinstance(error.reason, Exception) else str(error.reason)
            raise DeliveryError(f"{self.name}: {reason}") from error
        except (OSError, http.client.HTTPException, ValueError) as error:
            raise DeliveryError(f"{self.name}: {reason_of(error)}") from error

    def _body(self, alerts: Sequence[Alert]) -> bytes:
        told = {
            "station": self._sender.station,
            "sent": time.time(),
            "subject": subject(alerts, self._sender),
            "text": text(alerts, self._sender),
            "alerts": [alert.as_row() for alert in alerts],
        }
        return json.dumps(told, allow_nan=False).encode()

    def _opener(self) -> urllib.request.OpenerDirector:
        ca_file = self._settings.ca_file
        context = ssl.create_default_context(cafile=None if ca_file is None else str(ca_file))
        handlers: list[urllib.request.BaseHandler] = [_NoRedirect(), urllib.request.HTTPSHandler(context=context)]
        if is_this_machine(self._host):
            handlers.append(urllib.request.ProxyHandler({}))
        return urllib.request.build_opener(*handlers)


def signature(secret: str, body: bytes) -> str:
    """What the header of the signature says."""
    return "sha256=" + hmac.new(secret.encode(), body, hashlib.sha256).hexdigest()
