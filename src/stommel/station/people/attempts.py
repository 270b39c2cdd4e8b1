"""How often somebody may try a password: the more are wrong, the longer the wait."""

import time
from ipaddress import IPv6Address, ip_address
from typing import TYPE_CHECKING

from stommel.station.people.errors import TooManyTriesError

if TYPE_CHECKING:
    from limits import RateLimitItem

BY_NAME_AND_ADDRESS = "5/minute; 10/15 minutes; 20/hour; 40/day"
BY_NAME = "30/15 minutes; 100/day"
"""Wider: nobody shall lock a person out from afar with a few wrong passwords."""
BY_ADDRESS = "20/minute; 60/15 minutes; 100/hour; 300/day"
_WIDEST = 64
"""Bits of an IPv6 address that one household has to itself."""


class Attempts:
    """Wrong passwords and tokens of late, in memory: by name, by address, and by both."""

    def __init__(self) -> None:
        from limits import parse_many  # noqa: PLC0415 - not for commands that only show help
        from limits.storage import MemoryStorage  # noqa: PLC0415
        from limits.strategies import MovingWindowRateLimiter  # noqa: PLC0415

        self._limiter = MovingWindowRateLimiter(MemoryStorage())
        self._both, self._name, self._address = map(parse_many, (BY_NAME_AND_ADDRESS, BY_NAME, BY_ADDRESS))

    def check(self, name: str | None, address: str) -> None:
        """Refuse who has to wait.

        Raises
        ------
        TooManyTriesError
            With the seconds to wait.
        """
        free_at = [
            self._limiter.get_window_stats(item, *key).reset_time
            for item, key in self._keys(name, address)
            if not self._limiter.test(item, *key)
        ]
        if free_at:
            wait = max(1.0, max(free_at) - time.time())
            raise TooManyTriesError(f"too many wrong tries; try again in {_in_words(wait)}", wait)

    def failed(self, name: str | None, address: str) -> None:
        """Count a wrong try."""
        for item, key in self._keys(name, address):
            self._limiter.hit(item, *key)

    def succeeded(self, name: str, address: str) -> None:
        """Forget what the person mistyped here; what others tried is kept."""
        for item in self._both:
            self._limiter.clear(item, "both", name, network(address))

    def _keys(self, name: str | None, address: str) -> list[tuple["RateLimitItem", tuple[str, ...]]]:
        origin = network(address)
        keys: list[tuple[RateLimitItem, tuple[str, ...]]] = [(item, ("address", origin)) for item in self._address]
        if name is not None:
            keys += [(item, ("both", name, origin)) for item in self._both]
            keys += [(item, ("name", name)) for item in self._name]
        return keys


def network(address: str) -> str:
    """What counts as one origin: an IPv4 address, or the /64 of an IPv6 address."""
    try:
        ip = ip_address(address)
    except ValueError:
        return address
    if isinstance(ip, IPv6Address):
        return str(ip.ipv4_mapped) if ip.ipv4_mapped else f"{int(ip) >> _WIDEST:x}/{_WIDEST}"
    return str(ip)


def _in_words(wait: float) -> str:
    if wait < 90:
        return f"{wait:.0f} s"
    return f"{wait / 60:.0f} min" if wait < 5400 else f"{wait / 3600:.0f} h"
