"""What waits for a vehicle: commands, writings of parameters, missions and files that have had no last word."""

import time
from collections.abc import Callable
from typing import Any, Literal, NamedTuple

from stommel.link.commands.report import Report
from stommel.link.commands.states import State
from stommel.station.vehicles.line import VehicleLine

EVERY = 0.25
"""Between two looks [s]."""
AbortStep = Literal["waits", "sent", "aboard"]


class OpenAbort(NamedTuple):
    """The newest abort of which the vehicle has not said the last word."""

    id: str
    step: AbortStep
    """It waits here, may have left, or the vehicle has it."""
    words: str
    """What is known of it."""
    given: float
    expires: float


class Waiting(NamedTuple):
    """How many of each have had no last word; files that somebody lets rest are not counted."""

    commands: int = 0
    """With aborts."""
    parameters: int = 0
    missions: int = 0
    transfers: int = 0
    abort: OpenAbort | None = None

    def told(self) -> dict[str, Any]:
        """As the summary tells it."""
        return self._asdict() | {"abort": None if self.abort is None else self.abort._asdict()}


NOTHING: dict[str, Any] = Waiting().told()


class WaitingThings:
    """Counts what waits for one vehicle, also while the archive takes nothing.

    Parameters
    ----------
    parameters, missions, transfers
        How many there are.
    """

    def __init__(
        self, parameters: Callable[[], int], missions: Callable[[], int], transfers: Callable[[], int]
    ) -> None:
        self._parameters, self._missions, self._transfers = parameters, missions, transfers
        self._due = 0.0
        self.told = NOTHING
        """As the summary tells it."""

    def look(self, line: VehicleLine, t: float) -> None:
        """Count anew."""
        real = time.monotonic()
        if real < self._due:
            return
        self._due = real + EVERY
        reports = [report for report in line.end.commands.reports(t) if not report.is_last]
        aborts = [report for report in reports if report.name == "abort"]
        self.told = Waiting(
            commands=len(reports), parameters=self._parameters(), missions=self._missions(),
            transfers=self._transfers(),
            abort=_abort(max(aborts, key=lambda report: report.given), line) if aborts else None,
        ).told()  # fmt: skip


def _abort(report: Report, line: VehicleLine) -> OpenAbort:
    step: AbortStep = "waits"
    if report.state is not State.NOT_KNOWN:
        step = "aboard"
    elif report.sent:
        step = "sent"
    given, expires = line.clock.of_link(report.given), line.clock.of_link(report.expires)
    return OpenAbort(id=f"{report.id:016x}", step=step, words=report.words, given=given, expires=expires)
