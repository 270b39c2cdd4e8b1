"""Health: of each node and instrument how much was heard, lost and refused, how long ago, and one word for it.

One lost frame is a count, not an alarm: a source is late after one missed period, and silent only after several.
"""

import math
from enum import Enum
from typing import NamedTuple

from stommel.errors import StommelError


class Source(NamedTuple):
    """Something that is to be heard again and again."""

    name: str
    period: float
    """Between two messages [s]."""
    missed: int
    """Periods without a message after which it is silent."""


SOURCES = (
    Source("motion node", 1.0, 5),
    Source("acquisition node", 1.0, 5),
    Source("compass", 1.0, 5),
    Source("GPS", 1.0, 10),
    Source("CTD", 1.0, 10),
    Source("pressure sensor", 1.0, 5),
    Source("altimeter", 1.0, 10),
    Source("battery gauge", 1.0, 5),
    Source("radio", 60.0, 5),
)
"""What the paper's vehicle listens to."""


class Condition(Enum):
    """One word for a source."""

    OFF = "off"
    WAITING = "waiting"
    WELL = "well"
    LATE = "late"
    SILENT = "silent"
    REFUSED = "refused"


CONDITION_WORDS = {
    Condition.OFF: "switched off, nothing is expected",
    Condition.WAITING: "switched on, not heard yet, and not for long",
    Condition.WELL: "heard within its period",
    Condition.LATE: "a period or more is missing: a count, no alarm",
    Condition.SILENT: "so many periods are missing that nothing more is expected",
    Condition.REFUSED: "heard, but of another version",
}


class SourceHealth(NamedTuple):
    """What is known of one source."""

    name: str
    condition: Condition
    age: float
    """Since it was last heard [s]; not a number before."""
    heard: int
    """Good messages."""
    lost: int
    """Messages that are missing between those, by their counters."""
    rejected: int
    """Messages that were not believed: wrong checksum, repeated, out of range."""
    silences: int
    """How often it has fallen silent."""
    restarts: int


class Health(NamedTuple):
    """Snapshot for log, telemetry and live view; it does not change any more."""

    t: float
    """Time of the vehicle [s]."""
    sources: tuple[SourceHealth, ...]
    unknown: tuple[int, ...]
    """Identifiers on the bus that the database does not know."""
    alarms: tuple[str, ...]
    """Names of the active alarms of safety."""
    unproven: tuple[str, ...]
    """Names of the start checks that have not passed."""


class UnknownSourceError(StommelError):
    """No such source is listened to."""


class _Record:
    """Counts of one source."""

    __slots__ = ("age_from", "heard", "heard_at", "lost", "on", "refused", "rejected", "restarts", "silences", "silent")

    def __init__(self) -> None:
        self.on = self.refused = self.silent = False
        self.heard = self.lost = self.rejected = self.restarts = self.silences = 0
        self.heard_at = math.nan
        self.age_from = math.nan
        """When it was last heard, or switched on if that is later [s]."""


class HealthMonitor:
    """Counts what is heard.

    Parameters
    ----------
    sources
        What to listen to; each is off until it is switched on.
    """

    def __init__(self, sources: tuple[Source, ...] = SOURCES) -> None:
        self._sources = {source.name: source for source in sources}
        self._records = {source.name: _Record() for source in sources}
        self._unknown: set[int] = set()

    def switch(self, name: str, on: bool, t: float) -> None:
        """Say whether messages of a source are expected; its age counts from here."""
        record = self._record(name)
        if on and not record.on:
            record.age_from, record.silent = t, False
        record.on = on

    def hear(self, name: str, t: float, lost: int = 0) -> None:
        """Count a good message, and those that are missing before it."""
        record = self._record(name)
        record.heard += 1
        record.lost += lost
        record.heard_at = record.age_from = t
        record.silent = False

    def reject(self, name: str) -> None:
        """Count a message that was not believed."""
        self._record(name).rejected += 1

    def restarted(self, name: str) -> None:
        """Count a restart."""
        self._record(name).restarts += 1

    def refuse(self, name: str, refused: bool) -> None:
        """Say whether a node is of another version."""
        self._record(name).refused = refused

    def meet_stranger(self, identifier: int) -> None:
        """Note an identifier that the database does not know."""
        self._unknown.add(identifier)

    @property
    def unknown(self) -> int:
        """Number of unknown identifiers so far."""
        return len(self._unknown)

    def silent(self, name: str, t: float) -> bool:
        """Whether a source that is switched on has missed so many periods that nothing more is expected."""
        record, source = self._record(name), self._sources[name]
        silent = record.on and t - record.age_from > source.missed * source.period
        if silent and not record.silent:
            record.silences += 1
        record.silent = silent
        return silent

    def snapshot(self, t: float, alarms: tuple[str, ...] = (), unproven: tuple[str, ...] = ()) -> Health:
        """Return all of it as it is now."""
        sources = tuple(self._health(name, t) for name in self._sources)
        return Health(t, sources, tuple(sorted(self._unknown)), alarms, unproven)

    def _health(self, name: str, t: float) -> SourceHealth:
        silent, record = self.silent(name, t), self._records[name]
        if not record.on:
            condition = Condition.OFF
        elif record.refused:
            condition = Condition.REFUSED
        elif silent:
            condition = Condition.SILENT
        elif not record.heard_at >= record.age_from:
            condition = Condition.WAITING
        else:
            late = t - record.heard_at > 1.5 * self._sources[name].period
            condition = Condition.LATE if late else Condition.WELL
        return SourceHealth(
            name, condition, t - record.heard_at, record.heard, record.lost, record.rejected, record.silences,
            record.restarts,
        )  # fmt: skip

    def _record(self, name: str) -> _Record:
        try:
            return self._records[name]
        except KeyError:
            raise UnknownSourceError(f"{name}: is no source; known are {', '.join(self._records)}") from None
