"""Missions of a vehicle, as the link sees them."""

from collections.abc import Sequence
from typing import NamedTuple, Protocol


class Waypoint(NamedTuple):
    """A place, as MISSION_ITEM_INT holds it."""

    latitude: int
    """[1e-7 deg]"""
    longitude: int
    """[1e-7 deg]"""


class WaypointPlan(NamedTuple):
    """Waypoints, and what goes with all of them."""

    waypoints: tuple[Waypoint, ...]
    depth: float | None
    """Of the dives [m]; None: as the orders aboard have it."""
    radius: float | None
    """Within which a waypoint is reached [m]; None: as the orders aboard have it."""


class WaypointRefusal(NamedTuple):
    """Why a plan is not taken."""

    words: str
    """Key, value, and what is allowed."""
    item: int | None = None
    """Number of the waypoint, from 0; None: it is the whole."""


class WaypointProgress(NamedTuple):
    """How far the vehicle has come."""

    current: int | None
    """Number of the waypoint that is aimed at, from 0; None for no mission."""
    reached: int | None = None
    """Number of the last one that was reached."""
    state: int = 0
    """MISSION_STATE."""
    total: int | None = None
    """Number of waypoints that are flown; None: as many as are held."""


class WaypointPort(Protocol):
    """Where waypoints are kept."""

    def plan(self) -> WaypointPlan | None:
        """What is held, with depth and radius; None for no mission."""

    def take_plan(self, plan: WaypointPlan) -> Sequence[WaypointRefusal]:
        """Make orders of a plan and switch over to them as one; reasons why not, and then nothing has changed."""

    def progress(self) -> WaypointProgress:
        """How far the vehicle has come."""

    def aim_at(self, number: int) -> str:
        """Aim at a waypoint; why not, in words, or nothing."""


class HeldOrders(NamedTuple):
    """Which orders the vehicle holds; hashes are SHA-256, empty for none."""

    number: int
    """Of the mission; 0 for none."""
    name: str
    sha256: bytes
    previous: bytes


class OrdersPort(Protocol):
    """Where orders files are kept. Every method may raise StommelError, in whose words a request is then refused."""

    def held(self) -> HeldOrders:
        """Which orders are held."""

    def announce(self, size: int, sha256: bytes) -> None:
        """Begin to receive a file; the same one again goes on where it was."""

    def announced(self) -> bytes:
        """SHA-256 of the file that is being received; empty for none."""

    def take_piece(self, offset: int, piece: bytes) -> None:
        """Take some bytes of the file that is being received."""

    def missing(self) -> Sequence[tuple[int, int]]:
        """First byte and the one behind the last of every gap of the file that is being received."""

    def check(self) -> None:
        """Hold the file that was received against the vehicle; FileError has a problem for each limit it breaks."""

    def switch(self) -> None:
        """Hold the file that was received, after the same check; if it raises, nothing has changed."""

    def roll_back(self) -> None:
        """Hold the orders before again; if it raises, nothing has changed."""
