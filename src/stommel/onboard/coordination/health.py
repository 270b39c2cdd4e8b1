"""Health: of each node and instrument how much was heard, lost and refused, how long ago, and one word for it.

Nothing is counted here that another part counts: `Told` is what decoder, watch of the nodes and drivers know of a
source. Health adds since when a source has power, how often it has fallen silent, and the word.

One lost frame is a count, not an alarm: a source is late after one missed period, and silent only after several.
"""

import math
from collections.abc import Collection, Sequence
from enum import Enum
from typing import NamedTuple

from stommel.errors import StommelError

MOTION_NODE, ACQUISITION_NODE = "motion node", "acquisition node"
COMPASS, GPS, CTD, RADIO = "compass", "GPS", "CTD", "radio"
PRESSURE_SENSOR, ALTIMETER, BATTERY_GAUGE = "pressure sensor", "altimeter", "battery gauge"
SOURCES = (
    MOTION_NODE, ACQUISITION_NODE, COMPASS, GPS, CTD, PRESSURE_SENSOR, ALTIMETER, BATTERY_GAUGE, RADIO,
)  # fmt: skip
"""What the paper's vehicle listens to, in the order of every snapshot."""
LATE_AFTER = 1.5
"""Periods without a message after which a source is late."""


class Condition(Enum):
    """One word for a source."""

    OFF = "off"
    WAITING = "waiting"
    WELL = "well"
    LATE = "late"
    SILENT = "silent"
    REFUSED = "refused"


CONDITIONS = tuple(condition.value for condition in Condition)
"""As a record of the log numbers them."""
CONDITION_WORDS = {
    Condition.OFF: "switched off, or not fitted: nothing is expected",
    Condition.WAITING: "switched on, and has said nothing of use since: a GPS looks for its satellites",
    Condition.WELL: "heard within its period",
    Condition.LATE: "a period or more is missing: a count, no alarm",
    Condition.SILENT: "so many periods are missing that safety expects nothing more",
    Condition.REFUSED: "heard, but of another version",
}


class Told(NamedTuple):
    """What other parts know of a source; counts since their start."""

    period: float
    """Between two messages [s]."""
    heard_at: float
    """When it was last heard [s]; minus infinity before."""
    heard: int
    """Good messages."""
    lost: int
    """Messages that are missing between those, by their counters."""
    rejected: int
    """Messages that were not believed: wrong checksum, repeated, out of range."""
    silent: bool
    """Whether so many periods are missing that nothing more is expected."""
    refused: bool = False
    """Whether it is a node of another version."""
    restarts: int = 0


class SourceHealth(NamedTuple):
    """What is known of one source; counts as in `Told`."""

    name: str
    condition: Condition
    age: float
    """Since it was last heard [s]; not a number before."""
    heard: int
    lost: int
    rejected: int
    silences: int
    """How often it has fallen silent."""
    restarts: int


class Health(NamedTuple):
    """Snapshot for log, telemetry and live view; it does not change any more."""

    t: float
    """Time of the vehicle [s]."""
    sources: tuple[SourceHealth, ...]
    """In the order of `SOURCES`."""
    unknown: tuple[int, ...]
    """Identifiers on the bus that the database does not know."""


class UnknownSourceError(StommelError):
    """No such source is listened to."""


class _Record:
    """What is remembered of one source."""

    __slots__ = ("silences", "silent", "since")

    def __init__(self) -> None:
        self.since = math.inf
        """When it was switched on [s]; infinite while it is off."""
        self.silent = False
        self.silences = 0


class HealthMonitor:
    """Puts together what is known of every source.

    Parameters
    ----------
    sources
        Names of what is listened to; each is off until it is switched on.
    """

    def __init__(self, sources: tuple[str, ...] = SOURCES) -> None:
        self._records = {name: _Record() for name in sources}
        self._unknown: tuple[int, ...] = ()

    def switch(self, name: str, on: bool, t: float) -> None:
        """Say whether messages of a source are expected, from a time on [s]."""
        record = self._record(name)
        record.since = min(record.since, t) if on else math.inf

    def since(self, name: str) -> float:
        """When a source was switched on [s]; infinite while it is off."""
        return self._record(name).since

    def snapshot(self, t: float, told: Sequence[Told], strangers: Collection[int] = ()) -> Health:
        """Return all of it as it is now.

        Parameters
        ----------
        t
            Time of the vehicle [s].
        told
            Of each source, in their order.
        strangers
            Identifiers that the database does not know; they only become more.
        """
        if len(strangers) != len(self._unknown):
            self._unknown = tuple(sorted(strangers))
        records = self._records.items()
        sources = tuple([_health(name, record, of, t) for (name, record), of in zip(records, told, strict=True)])
        return Health(t, sources, self._unknown)

    def _record(self, name: str) -> _Record:
        try:
            return self._records[name]
        except KeyError:
            raise UnknownSourceError(f"{name}: is no source; known are {', '.join(self._records)}") from None


def _health(name: str, record: _Record, of: Told, t: float) -> SourceHealth:
    on = record.since != math.inf
    silent = on and of.silent
    record.silences += silent and not record.silent
    record.silent = silent
    age = t - of.heard_at
    if not on:
        condition = Condition.OFF
    elif of.refused:
        condition = Condition.REFUSED
    elif silent:
        condition = Condition.SILENT
    elif of.heard_at < record.since:
        condition = Condition.WAITING
    else:
        condition = Condition.LATE if age > LATE_AFTER * of.period else Condition.WELL
    if age == math.inf:
        age = math.nan
    return SourceHealth(name, condition, age, of.heard, of.lost, of.rejected, record.silences, of.restarts)
