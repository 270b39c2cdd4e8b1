"""`[alarms]` and `[alerts]` of station.toml: what is an alarm, and who is told when nobody sits before the page."""

import ipaddress
from pathlib import Path
from typing import Annotated, Literal, Self
from urllib.parse import urlsplit

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, model_validator

from stommel.files.kinds import Flag
from stommel.files.ranges import between
from stommel.station.alarms.severity import Severity


class _Table(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


def _is_address(text: str) -> str:
    name, at, domain = text.rpartition("@")
    if not (name and at and domain) or not text.isprintable() or any(sign in text for sign in ' <>,;:"()[]\\'):
        raise ValueError(f"{text[:80]!r}: must be an e-mail address, as pilot@example.org")
    return text


def _is_web_address(text: str) -> str:
    try:
        parts = urlsplit(text)
        host, _ = parts.hostname, parts.port
    except ValueError:
        host, parts = None, urlsplit("")
    if not host or not text.isprintable() or " " in text or parts.username is not None:
        raise ValueError(f"{text[:80]!r}: must be an address, as https://example.org/alarms")
    if parts.scheme != "https" and not (parts.scheme == "http" and is_this_machine(host)):
        raise ValueError(f"{text[:80]!r}: must begin with https://; http:// is allowed on this machine only")
    return text


def is_this_machine(host: str) -> bool:
    """Whether a host is this machine by its name or number, without asking anybody."""
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"


EmailAddress = Annotated[str, Field(max_length=254), AfterValidator(_is_address)]
WebAddress = Annotated[str, Field(max_length=2000), AfterValidator(_is_web_address)]
Secret = Annotated[str, Field(min_length=1, max_length=500)]


class EmailSettings(_Table):
    """`[alerts.email]`: the mail server, and who is written to."""

    host: Annotated[str, Field(min_length=1, max_length=253, pattern=r"^[A-Za-z0-9.:_-]+$")]
    """Mail server."""
    port: Annotated[int, between(1, 65_535)] = 587
    tls: Literal["starttls", "tls", "none"] = "starttls"
    """`tls` from the first byte (port 465), `starttls` after the greeting (587), `none` on this machine only."""
    user: Annotated[str, Field(max_length=254)] = ""
    """Name at the mail server; empty: nobody logs in."""
    password_file: Path | None = None
    """File that holds the password, so that it is in no settings."""
    sender: EmailAddress
    recipients: Annotated[tuple[EmailAddress, ...], Field(min_length=1, max_length=50)]
    ca_file: Path | None = None
    """Certificate of who signed the server's; what the machine trusts if left out."""

    @model_validator(mode="after")
    def _is_private(self) -> Self:
        if self.tls == "none" and not is_this_machine(self.host):
            raise ValueError(f'tls = "none": allowed with a mail server on this machine only, not {self.host}')
        if bool(self.user) != (self.password_file is not None):
            raise ValueError("user and password_file go together")
        return self


class WebhookSettings(_Table):
    """`[[alerts.webhooks]]`: an address that is told by POST, as JSON."""

    url: WebAddress
    secret_file: Path | None = None
    """File that holds the secret by which the receiver knows that it was us."""
    ca_file: Path | None = None
    """Certificate of who signed the server's; what the machine trusts if left out."""


class AlertSettings(_Table):
    """`[alerts]`: who is told of alarms, and how often."""

    least_severity: Severity = "warning"
    """What is less is told to nobody."""
    quiet_s: Annotated[float, between(0, 86_400)] = 900.0
    """For how long after an alert the same alarm is only counted."""
    cleared: Flag = True
    """Whether the end of an alarm is told as well."""
    email: EmailSettings | None = None
    webhooks: Annotated[tuple[WebhookSettings, ...], Field(max_length=20)] = ()


class AlarmSettings(_Table):
    """`[alarms]`: when a silence is an alarm."""

    surfacing_margin_s: Annotated[float, between(0, 604_800)] = 900.0
    """For how long after the expected time a surfacing is not yet missed, by the vehicle's clock."""
    longest_silence_s: Annotated[float, between(10, 604_800)] = 600.0
    """For how long a link may be silent without a dive that explains it, by the vehicle's clock."""
    longest_dive_s: Annotated[float, between(60, 2_592_000)] = 43_200.0
    """For how long it may be silent in a dive whose end nobody knows, as the first one."""
