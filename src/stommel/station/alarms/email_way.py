"""Alerts by e-mail."""

import smtplib
import ssl
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from email.message import EmailMessage
from email.utils import formatdate, make_msgid

from stommel.station.alarms.alert_policy import Alert
from stommel.station.alarms.alert_settings import EmailSettings
from stommel.station.alarms.alert_words import Sender, subject, text
from stommel.station.alarms.delivery import PATIENCE_S, DeliveryError, PartlyDeliveredError, reason_of, secret_of


class EmailWay:
    """Writes to all recipients, in one message."""

    def __init__(self, settings: EmailSettings, sender: Sender) -> None:
        self._settings, self._sender = settings, sender

    @property
    def name(self) -> str:
        """What people call it."""
        return f"e-mail through {self._settings.host}"

    @property
    def file(self) -> str:
        """There is one mail server."""
        return "email"

    def send(self, alerts: Sequence[Alert]) -> None:
        """Send one message with all of them.

        Raises
        ------
        DeliveryError
            It did not go out.
        PartlyDeliveredError
            Some recipients were refused; the others were told.
        """
        try:
            with self._server() as server:
                refused = server.send_message(self._message(alerts))
        except smtplib.SMTPRecipientsRefused as error:
            raise DeliveryError(f"{self.name}: refuses {', '.join(error.recipients)}") from error
        except (smtplib.SMTPException, ssl.SSLError, OSError, UnicodeError, ValueError) as error:
            raise DeliveryError(f"{self.name}: {_reason(error)}") from error
        if refused:
            raise PartlyDeliveredError(f"{self.name}: refuses {', '.join(refused)}; the others were told")

    @contextmanager
    def _server(self) -> Iterator[smtplib.SMTP]:
        settings = self._settings
        context = _trust(settings)
        if settings.tls == "tls":
            server: smtplib.SMTP = smtplib.SMTP_SSL(settings.host, settings.port, timeout=PATIENCE_S, context=context)
        else:
            server = smtplib.SMTP(settings.host, settings.port, timeout=PATIENCE_S)
        with server:
            if settings.tls == "starttls":
                server.starttls(context=context)
            if settings.password_file is not None:
                server.login(settings.user, secret_of(settings.password_file))
            yield server

    def _message(self, alerts: Sequence[Alert]) -> EmailMessage:
        settings = self._settings
        message = EmailMessage()
        message["From"] = settings.sender
        message["To"] = ", ".join(settings.recipients)
        message["Subject"] = subject(alerts, self._sender)
        message["Date"] = formatdate()
        message["Message-ID"] = make_msgid(domain=settings.sender.rpartition("@")[2])
        message["Auto-Submitted"] = "auto-generated"
        message.set_content(text(alerts, self._sender))
        return message


def _trust(settings: EmailSettings) -> ssl.SSLContext:
    return ssl.create_default_context(cafile=None if settings.ca_file is None else str(settings.ca_file))


def _reason(error: Exception) -> str:
    if isinstance(error, smtplib.SMTPResponseException):
        words = error.smtp_error.decode(errors="replace") if isinstance(error.smtp_error, bytes) else error.smtp_error
        return f"answers {error.smtp_code} {' '.join(words.split())[:150]}"
    return reason_of(error)
