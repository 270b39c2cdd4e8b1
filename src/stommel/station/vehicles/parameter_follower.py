"""Follows the parameters of one vehicle: what becomes of writings, and what has changed."""

import math
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from stommel.link.endings import Ending
from stommel.link.parameters.client import ParameterClient
from stommel.link.parameters.known import KnownSet
from stommel.link.parameters.single import SingleOutcome
from stommel.station.vehicles.line import VehicleLine
from stommel.station.vehicles.parameter_rows import ParameterRow, ParameterRows

EVERY = 0.2
"""Between two looks [s]."""
WITHIN = 3600.0
"""Time within which a refreshing ends [s]."""
MOST_WRITES = 200
"""Writings that are remembered."""


@dataclass
class Write:
    """A value that somebody sets."""

    ticket: int
    component: int
    name: str
    value: float
    user: str
    t: float
    """When it was asked for, by the vehicle's clock [s since 1970]."""
    state: str = "waiting"
    """waiting, done, refused or failed."""
    words: str = ""
    holds: float | None = None
    """Value that holds aboard, as far as the vehicle said."""

    def told(self) -> dict[str, Any]:
        """As the API tells it."""
        return {
            "ticket": self.ticket, "component": self.component, "name": self.name, "value": self.value,
            "user": self.user, "t": self.t, "state": self.state, "words": self.words, "holds": self.holds,
        }  # fmt: skip


class ParameterFollower:
    """Brings what the link knows of parameters into the archive, and tells it.

    Parameters
    ----------
    rows
        Of the archive.
    tell
        Is called with what has changed, as the API tells it.
    """

    def __init__(self, rows: ParameterRows, tell: Callable[[int, dict[str, Any]], None]) -> None:
        self._rows, self._tell = rows, tell
        self._due = 0.0
        self._sets: dict[int, KnownSet] = {}
        """As they were when they were written down."""
        self.latest: dict[tuple[int, str], ParameterRow] | None = None
        """What the archive has; None before it was read."""
        self.writes: deque[Write] = deque(maxlen=MOST_WRITES)
        self._asked_at: float | None = None
        self._refreshed: object = None
        self.refreshing: dict[str, Any] | None = None
        """How far a refreshing was when the line looked last; None while there is none."""

    def refresh(self, client: ParameterClient, t: float) -> None:
        """Ask the vehicle for all."""
        client.refresh(t, WITHIN)
        self._see(client, t)

    def _see(self, client: ParameterClient, t: float) -> None:
        progress = client.progress(t)
        self.refreshing = progress._asdict() if client.refreshed is None and progress.of > 0 else None

    def look(self, line: VehicleLine, t: float) -> None:
        """Write what has changed; the first time that the vehicle is heard, ask it."""
        real = time.monotonic()
        if real < self._due:
            return
        self._due = real + EVERY
        client = line.end.parameters
        if self.latest is None:
            self.latest = self._rows.latest(line.vehicle)
        if self._asked_at is None and line.end.is_heard(t):
            self._asked_at = t
            self.refresh(client, t)
        for outcome in client.outcomes():
            self._take(line, outcome)
        self._compare(line)
        if client.refreshed is not self._refreshed:
            self._refreshed = client.refreshed
            if client.refreshed is not None:
                self._tell(line.vehicle, {"refreshed": True})
        self._see(client, t)

    def _take(self, line: VehicleLine, outcome: SingleOutcome) -> None:
        for write in self.writes:
            if write.ticket == outcome.ticket and write.state == "waiting":
                write.state = {Ending.WHOLE: "done", Ending.REFUSED: "refused"}.get(outcome.ending, "failed")
                write.words = outcome.words
                write.holds = None if outcome.value is None else float(outcome.value)
                self._tell(line.vehicle, write.told())

    def _compare(self, line: VehicleLine) -> None:
        """Write values that are other than those that the archive has."""
        assert self.latest is not None
        now, new = line.clock.now(), list[ParameterRow]()
        changed = {
            component: known
            for component, known in line.end.parameters.known.sets.items()
            if self._sets.get(component) is not known
        }
        for component, known in changed.items():
            for described, value in zip(known.descriptions, known.values, strict=True):
                before = self.latest.get((component, described.id))
                if value is None or not math.isfinite(value) or (before is not None and before.value == float(value)):
                    continue
                user = self._writer(component, described.id, float(value))
                new.append(ParameterRow(
                    component, described.id, float(value), described.kind.name.lower(), now, user,
                    "vehicle" if user is None else "written",
                ))  # fmt: skip
        self._rows.add(line.vehicle, new)
        self.latest |= {(row.component, row.name): row for row in new}
        self._sets |= changed

    def _writer(self, component: int, name: str, value: float) -> str | None:
        """Who has set a value that the vehicle holds now."""
        for write in reversed(self.writes):
            if (write.component, write.name) == (component, name) and write.state == "done" and write.holds == value:
                return write.user
        return None
