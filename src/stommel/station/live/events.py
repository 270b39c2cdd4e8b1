"""What the hub hands on."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

Vehicle = int | str
"""Number of a vehicle, or `replay:...`."""


class Samples(NamedTuple):
    """Values that came."""

    vehicle: Vehicle
    now: float
    """Time of the vehicle [s since 1970]."""
    samples: Sequence[tuple[str, float, float]]
    """Key, time and value, in the order of time for each key."""


class Summary(NamedTuple):
    """How a vehicle is."""

    vehicle: Vehicle
    summary: Mapping[str, Any]
    """As `GET /vehicles` tells it."""


class Happening(NamedTuple):
    """Something that people should know at once."""

    kind: str
    """alarm, command, limit, mission, parameter, transfer, note, holder, text, dive, log or replay."""
    vehicle: Vehicle | None
    data: Mapping[str, Any]
    """As `web.live_messages` declares it."""


Event = Samples | Summary | Happening
