"""Who can reach the station's page, and what it therefore asks of them."""

from dataclasses import dataclass
from ipaddress import ip_address
from pathlib import Path

LOOPBACK_NAMES = ("127.0.0.1", "localhost", "::1")
"""By which a browser at the station's own machine asks for it."""


@dataclass(frozen=True)
class Exposure:
    """Where the station listens, and who keeps what is said there secret."""

    host: str = "127.0.0.1"
    certificate: Path | None = None
    key_file: Path | None = None
    behind_proxy: bool = False
    login: bool = False
    """Ask people at the station's own machine too."""
    names: tuple[str, ...] = ()
    """Names by which people reach it; none allows any, where people log in."""

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
