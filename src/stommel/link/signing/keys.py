"""Keys of a vehicle: 32 random bytes that both ends hold, and within a change the new one beside them."""

import hashlib
from typing import NamedTuple, Protocol

SIZE = 32
"""Bytes of a key."""
FIRST_MADE, LAST_MADE = 1_735_689_600, 3_313_526_400
"""2025 to 2075: when a key can have been made [s of UTC since 1970]."""


class Key:
    """A secret, which shows only its fingerprint."""

    __slots__ = ("fingerprint", "secret")

    def __init__(self, secret: bytes) -> None:
        if len(secret) != SIZE:
            raise ValueError(f"a key has {SIZE} bytes, not {len(secret)}")
        self.secret = secret
        digest = hashlib.sha256(b"stommel link key " + secret).hexdigest()[:16]
        self.fingerprint = "-".join(digest[at : at + 4] for at in range(0, 16, 4))
        """64 bits of a hash, by which people compare keys."""

    def __repr__(self) -> str:
        return f"Key({self.fingerprint})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Key) and self.secret == other.secret

    def __hash__(self) -> int:
        return hash(self.secret)


class Keys(NamedTuple):
    """What a key file holds."""

    vehicle: int
    """MAVLink system of the vehicle."""
    made: int
    """When the key was made [s of UTC since 1970]."""
    current: Key
    next: Key | None = None
    """Agreed with the other end, which may sign with it already; None but within a change."""
    unused: bool = False
    """No end has signed with it yet: so no stamps can be missing."""


class KeyStore(Protocol):
    """Where an end keeps its keys."""

    def read(self) -> Keys:
        """Return them; a StommelError says why there are none."""

    def write(self, keys: Keys) -> None:
        """Keep them, whole and on the disk when it returns; a StommelError leaves what was kept before."""
