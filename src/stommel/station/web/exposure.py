"""Who can reach the station's page, and what it therefore asks of them."""

import ssl
from dataclasses import dataclass
from ipaddress import ip_address
from pathlib import Path
from typing import Self

from stommel.errors import StommelError
from stommel.station.settings import StationSettings

LOOPBACK_NAMES = ("127.0.0.1", "localhost", "::1")
"""By which a browser at the station's own machine asks for it."""


class ExposureError(StommelError):
    """The station may not be served like this; the message says what to do."""


@dataclass(frozen=True)
class Exposure:
    """Where the station listens, and who keeps what is said there secret."""

    host: str = "127.0.0.1"
    port: int = 0
    certificate: Path | None = None
    key_file: Path | None = None
    behind_proxy: bool = False
    proxies: tuple[str, ...] = ("127.0.0.1", "::1")
    """Addresses of the proxy, which is believed about from where and how somebody asks."""
    login: bool = False
    """Ask people at the station's own machine too."""
    names: tuple[str, ...] = ()
    """Names by which people reach it; none allows any, where people log in."""

    @classmethod
    def told(cls, settings: StationSettings) -> Self:
        """As the settings say."""
        return cls(
            settings.host, settings.port, settings.certificate, settings.key_file, settings.behind_proxy,
            settings.proxies, settings.login, tuple(name.casefold() for name in settings.known_as),
        )  # fmt: skip

    @property
    def on_loopback(self) -> bool:
        """Whether only programs of this machine reach it."""
        if self.host == "localhost":
            return True
        try:
            return ip_address(self.host.strip("[]")).is_loopback
        except ValueError:
            return False

    @property
    def login_required(self) -> bool:
        """Whether people must say who they are."""
        return self.login or self.behind_proxy or not self.on_loopback

    @property
    def address(self) -> str:
        """Address of the page, as a browser takes it."""
        host = f"[{self.host}]" if ":" in self.host.strip("[]") else self.host
        return f"{'http' if self.certificate is None else 'https'}://{host}:{self.port}/"

    def require_secret(self) -> None:
        """Refuse to send passwords and commands where others can read them.

        Raises
        ------
        ExposureError
            Others can reach the station without TLS, or its certificate cannot be used.
        """
        if self.certificate is None and self.key_file is not None:
            raise ExposureError("--key-file: is of use only with --certificate")
        if self.certificate is not None:
            self._require_certificate(self.certificate)
        elif not self.on_loopback and not self.behind_proxy:
            raise ExposureError(
                f"--host {self.host}: others can reach the station there, so it needs TLS: give --certificate and "
                "--key-file, or --behind-proxy where a proxy in front serves TLS; or stay at --host 127.0.0.1"
            )

    def require_people(self, admins: int) -> None:
        """Refuse to start where people must log in and nobody could let them in.

        Raises
        ------
        ExposureError
            There is no admin.
        """
        if self.login_required and not admins:
            raise ExposureError(
                "people must log in at this station, and nobody is its admin yet; add one first: "
                "stommel station user add NAME --role admin"
            )

    def _require_certificate(self, certificate: Path) -> None:
        for option, path in (("--certificate", certificate), ("--key-file", self.key_file)):
            if path is not None and not path.is_file():
                raise ExposureError(f"{option} {path}: there is no such file")
        try:
            ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER).load_cert_chain(certificate, self.key_file, lambda: "")
        except (ssl.SSLError, OSError, ValueError) as error:
            reason = getattr(error, "reason", None) or getattr(error, "strerror", None) or "not PEM"
            raise ExposureError(
                f"--certificate {certificate}: cannot be used with {self.key_file or 'the key in it'} ({reason}); "
                "give a certificate in PEM, and its key without a passphrase"
            ) from None
