"""Follows the parameters of one vehicle: what becomes of writings, and what has changed."""

import math
import time
from collections import deque
from collections.abc import Callable, Sequence
from typing import Any

from stommel.link.endings import Ending
from stommel.link.parameters.client import ParameterClient
from stommel.link.parameters.encoding import ParameterValueError, fitting
from stommel.link.parameters.known import KnownSet
from stommel.link.parameters.single import SingleOutcome
from stommel.station.vehicles.line import VehicleLine
from stommel.station.vehicles.parameter_rows import ParameterRow, ParameterRows
from stommel.station.vehicles.parameter_writes import DONE, FAILED, REFUSED, WAITING, Write, WriteRows

EVERY = 0.2
"""Between two looks [s]."""
WITHIN = 3600.0
"""Time within which a refreshing ends [s]."""
MOST_WRITES = 200
"""Writings that are remembered."""
AGAIN = 60.0
"""Between two questions about what was set before the station began [s]."""
STARTED_ANEW = "the station was started anew; the vehicle is asked what it holds"
HOLDS = "the vehicle holds this value; the station was started anew before it had answered"


class ParameterFollower:
    """Brings what the link knows of parameters into the archive, and tells it.

    Parameters
    ----------
    rows, writes
        Of the archive.
    tell
        Is called with what has changed, as the API tells it.
    left
        What was set until the station began; of what waits, the vehicle is asked what it holds.
    """

    def __init__(
        self,
        rows: ParameterRows,
        writes: WriteRows,
        tell: Callable[[int, dict[str, Any]], None],
        left: Sequence[Write] = (),
    ) -> None:
        self._rows, self._write_rows, self._tell = rows, writes, tell
        self._due = 0.0
        self._sets: dict[int, KnownSet] = {}
        """As they were when they were written down."""
        self.latest: dict[tuple[int, str], ParameterRow] | None = None
        """What the archive has; None before it was read."""
        self.writes: deque[Write] = deque(left, maxlen=MOST_WRITES)
        self._left = [write for write in left if write.state == WAITING]
        for write in self._left:
            write.words = STARTED_ANEW
        self._ended: deque[Write] = deque()
        """Those of which the archive does not have the outcome yet."""
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
        if self._must_ask(client, t) and line.end.is_heard(t):
            self._asked_at = t
            self.refresh(client, t)
        for outcome in client.outcomes():
            self._take(outcome)
        self._settle_left(client)
        while self._ended:
            self._write_rows.change(self._ended[0])
            self._tell(line.vehicle, self._ended.popleft().told())
        self._compare(line)
        if client.refreshed is not self._refreshed:
            self._refreshed = client.refreshed
            if client.refreshed is not None:
                self._tell(line.vehicle, {"refreshed": True})
        self._see(client, t)

    def _must_ask(self, client: ParameterClient, t: float) -> bool:
        """Whether it is time to ask for all: at first, and again for what was set before the station began."""
        if self._asked_at is None:
            return True
        return bool(self._left) and client.refreshed is not None and t - self._asked_at >= AGAIN

    def _take(self, outcome: SingleOutcome) -> None:
        for write in self.writes:
            if write.ticket == outcome.ticket and write.state == WAITING:
                write.state = {Ending.WHOLE: DONE, Ending.REFUSED: REFUSED}.get(outcome.ending, FAILED)
                write.words = outcome.words
                write.holds = None if outcome.value is None else float(outcome.value)
                self._ended.append(write)

    def _settle_left(self, client: ParameterClient) -> None:
        """End what was set before the station began, by what the vehicle has told since that it holds."""
        if not self._left:
            return
        whole = {outcome.component for outcome in client.refreshed or () if outcome.ending is Ending.WHOLE}
        for write in [write for write in self._left if write.component in whole]:
            known = client.known.sets.get(write.component)
            number = None if known is None else known.number(write.name)
            value = None if known is None or number is None else known.values[number]
            write.holds = None if value is None else float(value)
            is_so = known is not None and number is not None and value == _held(known, number, write.value)
            write.state, write.words = (DONE, HOLDS) if is_so else (FAILED, _not_held(write.holds))
            self._left.remove(write)
            self._ended.append(write)

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
            if (write.component, write.name) == (component, name) and write.state == DONE and write.holds == value:
                return write.user
        return None


def _held(known: KnownSet, number: int, value: float) -> object:
    """A value as its parameter holds it; what it cannot hold is itself."""
    try:
        return fitting(known.descriptions[number], value)
    except ParameterValueError:
        return value


def _not_held(holds: float | None) -> str:
    told = "does not say what it holds" if holds is None else f"holds {holds:.9g}"
    return f"the station was started anew before the vehicle had answered; the vehicle {told}"
