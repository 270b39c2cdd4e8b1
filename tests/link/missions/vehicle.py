"""A vehicle with orders and waypoints in memory, as a test needs it."""

import hashlib
import random
from collections.abc import Sequence

from stommel.errors import FileError, Problem, StommelError
from stommel.link.missions.orders_client import OrdersClient
from stommel.link.missions.orders_server import OrdersServer
from stommel.link.missions.port import HeldOrders, Waypoint, WaypointPlan, WaypointProgress, WaypointRefusal
from stommel.link.missions.waypoint_client import WaypointClient
from stommel.link.missions.waypoint_server import WaypointServer
from tests.link.line import End, Line


def plan(count: int, seed: int = 0, depth: float | None = None, radius: float | None = None) -> WaypointPlan:
    draw = random.Random(seed)
    places = [(draw.randint(-900_000_000, 900_000_000), draw.randint(-(10**9), 10**9)) for _ in range(count)]
    return WaypointPlan(tuple(Waypoint(*place) for place in places), depth, radius)


class Vehicle:
    """Both ports. A file that begins with `bad` breaks limits, one for each of its lines."""

    def __init__(self, held: WaypointPlan | None = None) -> None:
        self.waypoints = held or plan(3, 99, 100.0, 500.0)
        self.files = [b"the first orders"]
        self.content: bytearray | None = None
        self.gaps: list[tuple[int, int]] = []
        self.sha256 = b""
        self.repeated = 0
        self.switched: list[object] = []
        self.current = 0
        self.refusals: list[WaypointRefusal] = []

    # waypoints

    def plan(self) -> WaypointPlan | None:
        return self.waypoints

    def take_plan(self, plan: WaypointPlan) -> Sequence[WaypointRefusal]:
        if not self.refusals:
            held = self.waypoints
            self.waypoints = WaypointPlan(plan.waypoints, plan.depth or held.depth, plan.radius or held.radius)
            self.switched.append(self.waypoints)
        return self.refusals

    def progress(self) -> WaypointProgress:
        return WaypointProgress(self.current, self.current - 1 if self.current else None, 3)

    def aim_at(self, number: int) -> str:
        if number >= len(self.waypoints.waypoints):
            return f"waypoint {number}: must be between 0 and {len(self.waypoints.waypoints) - 1}"
        self.current = number
        return ""

    # orders

    def held(self) -> HeldOrders:
        hashes = [hashlib.sha256(content).digest() for content in self.files[-2:]]
        return HeldOrders(len(self.files), "in memory", hashes[-1], hashes[0] if len(hashes) > 1 else b"")

    def announce(self, size: int, sha256: bytes) -> None:
        if size > 1 << 20:
            raise StommelError(f"mission: size = {size}: must be between 1 and {1 << 20} bytes")
        if self.sha256 != sha256:
            self.content, self.gaps, self.sha256 = bytearray(size), [(0, size)], sha256

    def announced(self) -> bytes:
        return self.sha256

    def take_piece(self, offset: int, piece: bytes) -> None:
        assert self.content is not None
        end, before = offset + len(piece), sum(last - first for first, last in self.gaps)
        if end > len(self.content):
            raise StommelError("outside")
        self.content[offset:end] = piece
        gaps = []
        for first, last in self.gaps:
            gaps += [(first, min(last, offset)), (max(first, end), last)]
        self.gaps = [(first, last) for first, last in gaps if first < last]
        self.repeated += len(piece) - (before - sum(last - first for first, last in self.gaps))

    def missing(self) -> Sequence[tuple[int, int]]:
        return self.gaps

    def check(self) -> None:
        assert self.content is not None
        if self.gaps or hashlib.sha256(self.content).digest() != self.sha256:
            raise StommelError("mission: is not whole")
        if self.content.startswith(b"bad"):
            lines = self.content.decode().splitlines()
            raise FileError([Problem("mission", "", f"{line}: must be good") for line in lines])

    def switch(self) -> None:
        self.check()
        assert self.content is not None
        self.files.append(bytes(self.content))
        self.switched.append(bytes(self.content))
        self.content, self.gaps, self.sha256 = None, [], b""

    def roll_back(self) -> None:
        self.files.append(self.files[-2])
        self.switched.append(self.files[-1])

    def restart(self) -> None:
        """Forget the file that is being received."""
        self.content, self.gaps, self.sha256 = None, [], b""


def waypoints_joined(vehicle: Vehicle) -> tuple[WaypointClient, Line]:
    client = WaypointClient(1)
    servers = [WaypointServer(1, 1, vehicle), OrdersServer(1, 1, vehicle, vehicle)]
    return client, Line(End(255, 190, [client]), End(1, 1, servers))


def orders_joined(vehicle: Vehicle, seed: int = 1) -> tuple[OrdersClient, Line]:
    client = OrdersClient(1, random.Random(seed))
    return client, Line(End(255, 190, [client]), End(1, 1, [OrdersServer(1, 1, vehicle, vehicle)]))
