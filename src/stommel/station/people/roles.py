"""What a person may do: look, fly or look after the station. Each role may all that the roles below it may."""

from enum import StrEnum
from typing import NamedTuple


class Role(StrEnum):
    """From the least to the most."""

    VIEWER = "viewer"
    PILOT = "pilot"
    ADMIN = "admin"

    @property
    def rank(self) -> int:
        """Its place in the order."""
        return list(Role).index(self)

    def may(self, least: "Role") -> bool:
        """Whether it is at least that role."""
        return self.rank >= least.rank


class User(NamedTuple):
    """Who asks, and how the station knows: `local` at the machine itself, by a `session` or by a `token`."""

    name: str
    role: Role
    via: str = "session"


LOCAL = User("local", Role.ADMIN, "local")
"""Whoever sits at the station's own machine, where nobody has to log in."""
