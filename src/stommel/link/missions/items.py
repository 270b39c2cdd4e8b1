"""Mission items: what of MAVLink's a glider understands, and why an item is refused.

A waypoint is MAV_CMD_NAV_WAYPOINT in a global frame. The sea's surface is the home altitude, so that frames with
absolute and with relative altitude say the same; z is minus the depth of the dives, or 0 to keep it; param2 is the
acceptance radius, or 0 to keep it. Depth and radius are those of the mission: all items have the same.
"""

import hashlib
import struct
from collections.abc import Sequence
from enum import IntEnum
from math import isfinite, isnan
from typing import NamedTuple

from stommel.link.missions.port import Waypoint, WaypointPlan
from stommel.link.values import real, whole
from stommel.messages.mavlink import Fields

NAV_WAYPOINT = 16
RELATIVE = 6
"""MAV_FRAME_GLOBAL_RELATIVE_ALT_INT: the only one of the four that MAVSDK's missions know."""
MISSION = 0
"""MAV_MISSION_TYPE_MISSION, the one that we have."""
MOST_WAYPOINTS = 5000
GLOBAL_FRAMES = (0, 3, 5, 6)
"""MAV_FRAME_GLOBAL, _RELATIVE_ALT, and both as _INT."""
_E7 = 10_000_000
_NOWHERE = 1 << 31
"""Stands for what is no number; is no place on earth."""
_MOST_DEPTH, _MOST_RADIUS = 12000.0, 100_000.0
DIGEST = 16


class MissionResult(IntEnum):
    """MAV_MISSION_RESULT."""

    ACCEPTED = 0
    ERROR = 1
    UNSUPPORTED_FRAME = 2
    UNSUPPORTED = 3
    NO_SPACE = 4
    INVALID = 5
    INVALID_PARAM1 = 6
    INVALID_PARAM2 = 7
    INVALID_PARAM3 = 8
    INVALID_PARAM4 = 9
    INVALID_X = 10
    INVALID_Y = 11
    INVALID_Z = 12
    INVALID_SEQUENCE = 13
    DENIED = 14
    CANCELLED = 15


class Item(NamedTuple):
    """A mission item as it was received."""

    seq: int
    command: int
    frame: int
    param1: float
    param2: float
    param3: float
    param4: float
    x: int
    """Latitude [1e-7 deg]."""
    y: int
    """Longitude [1e-7 deg]."""
    z: float
    """[m], up"""

    @property
    def radius(self) -> float:
        """Within which the waypoint is reached [m]; 0 to keep it."""
        return 0.0 if isnan(self.param2) else self.param2


class ItemRefusal(NamedTuple):
    """Why an item is refused."""

    result: MissionResult
    words: str


def item_of(number: int, plan: WaypointPlan, current: int | None) -> Fields:
    """Fields of MISSION_ITEM_INT, without target, of a waypoint."""
    latitude, longitude = plan.waypoints[number]
    return {
        "seq": number, "frame": RELATIVE, "command": NAV_WAYPOINT, "current": int(number == current), "autocontinue": 1,
        "param1": 0.0, "param2": plan.radius or 0.0, "param3": 0.0, "param4": 0.0, "x": latitude, "y": longitude,
        "z": -(plan.depth or 0.0), "mission_type": MISSION,
    }  # fmt: skip


def in_degrees(item: Fields) -> Fields:
    """Fields of MISSION_ITEM, for software that asks for it."""
    return {**item, "frame": 0, "x": item["x"] / _E7, "y": item["y"] / _E7}  # type: ignore[operator]


def item_in(values: Fields, *, degrees: bool) -> Item:
    """Return the item of a MISSION_ITEM_INT, or of a MISSION_ITEM, which is in degrees."""
    seq, command, frame = (whole(values, key) for key in ("seq", "command", "frame"))
    places = [real(values, key) * (_E7 if degrees else 1) for key in ("x", "y")]
    x, y = (round(place) if isfinite(place) else _NOWHERE for place in places)
    param1, param2, param3, param4, z = (real(values, key) for key in ("param1", "param2", "param3", "param4", "z"))
    return Item(seq, command, frame, param1, param2, param3, param4, x, y, z)


def refusal_of(item: Item) -> ItemRefusal | None:
    """Why the vehicle cannot do what an item says; None if it can."""
    number, command, frame, param1, radius, param3, param4, x, y, z = item
    latitude, longitude = x / _E7, y / _E7
    rows = (
        (command == NAV_WAYPOINT, MissionResult.UNSUPPORTED,
         f"command = {command}: must be {NAV_WAYPOINT}, NAV_WAYPOINT"),
        (frame in GLOBAL_FRAMES, MissionResult.UNSUPPORTED_FRAME,
         f"frame = {frame}: must be a global one, {', '.join(map(str, GLOBAL_FRAMES))}"),
        (param1 == 0.0 or isnan(param1), MissionResult.INVALID_PARAM1,
         f"param1 = {param1:g} s: must be 0, a glider cannot hold its place"),
        (0.0 <= radius <= _MOST_RADIUS or isnan(radius), MissionResult.INVALID_PARAM2,
         f"param2 = {radius:g} m: must be the acceptance radius up to {_MOST_RADIUS:g} m, or 0 to keep it"),
        (param3 == 0.0 or isnan(param3), MissionResult.INVALID_PARAM3,
         f"param3 = {param3:g} m: must be 0, a glider goes through its waypoints"),
        (param4 == 0.0 or isnan(param4), MissionResult.INVALID_PARAM4,
         f"param4 = {param4:g} deg: must be 0 or no number, a glider heads where it goes"),
        (-90.0 <= latitude <= 90.0, MissionResult.INVALID_X,
         f"x = {latitude:.7f} deg: must be between -90 and 90 deg"),
        (-180.0 <= longitude <= 180.0, MissionResult.INVALID_Y,
         f"y = {longitude:.7f} deg: must be between -180 and 180 deg"),
        (bool(latitude or longitude), MissionResult.INVALID_X,
         "x, y = 0, 0: is what software says that has no position"),
        (-_MOST_DEPTH <= z <= 0.0, MissionResult.INVALID_Z,
         f"z = {z:g} m: must be minus the depth of the dives, or 0 to keep it"),
    )  # fmt: skip
    for is_right, result, words in rows:
        if not is_right:
            return ItemRefusal(result, f"item {number}: {words}")
    return None


def plan_of(items: Sequence[Item]) -> WaypointPlan | ItemRefusal:
    """Return the plan that sound items make, or why they make none."""
    first = items[0]
    for item in items:
        if item.z != first.z:
            words = f"item {item.seq}: z = {item.z:g} m: must be {first.z:g} m as of item 0, all dives are alike"
            return ItemRefusal(MissionResult.INVALID_Z, words)
        if item.radius != first.radius:
            words = f"item {item.seq}: param2 = {item.radius:g} m: must be {first.radius:g} m as of item 0"
            return ItemRefusal(MissionResult.INVALID_PARAM2, words)
    waypoints = tuple(Waypoint(item.x, item.y) for item in items)
    return WaypointPlan(waypoints, -first.z or None, first.radius or None)


def waypoints_digest(waypoints: Sequence[Waypoint]) -> bytes:
    """Digest of waypoints, as ORDERS_STATE says it."""
    return hashlib.sha256(b"".join(struct.pack("<ii", *each) for each in waypoints)).digest()[:DIGEST]
