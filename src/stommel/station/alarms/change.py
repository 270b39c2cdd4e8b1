"""What the watches tell: an alarm of a vehicle begins or ends."""

from collections.abc import Iterable
from typing import NamedTuple

from stommel.station.alarms.severity import Severity
from stommel.station.alarms.threshold import Transition


class Change(NamedTuple):
    """An alarm begins or ends."""

    key: str
    """Which alarm: `limit:depth_m:high`, `vehicle:leak`, `surfacing_missed`, ..."""
    raised: bool
    t: float
    """When, by the vehicle's clock [s]."""
    value: float | None
    """What decided it, where it was a number."""
    words: str
    severity: Severity


def changes_of(key: str, transitions: Iterable[Transition], words: str, severity: Severity) -> list[Change]:
    """Say which alarm begins or ends."""
    return [Change(key, told.raised, told.t, told.value, words, severity) for told in transitions]
