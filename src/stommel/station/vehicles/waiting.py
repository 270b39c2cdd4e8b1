"""What waits for a vehicle: commands, writings of parameters, missions and files that have had no last word."""

import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any, Literal

from stommel.link.commands.report import Report
from stommel.link.commands.states import State
from stommel.station.vehicles.line import VehicleLine

EVERY = 0.25
"""Between two looks [s]."""
AbortStep = Literal["waits", "sent", "aboard"]


@dataclass(frozen=True)
class OpenAbort:
    """The newest abort of which the vehicle has not said the last word."""

    id: str
    step: AbortStep
    """It waits here, may have left, or the vehicle has it."""
    words: str
    """What is known of it."""
    given: float
    expires: float


@dataclass(frozen=True)
class Waiting:
    """How many of each have had no last word; files that somebody lets rest are not counted."""

    commands: int
    """With aborts."""
    parameters: int
    missions: int
    transfers: int
    abort: OpenAbort | None


NOTHING: dict[str, Any] = asdict(Waiting(0, 0, 0, 0, None))


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
        abort = _abort(max(aborts, key=lambda report: report.given), line) if aborts else None
        self.told = asdict(Waiting(len(reports), self._parameters(), self._missions(), self._transfers(), abort))


def _abort(report: Report, line: VehicleLine) -> OpenAbort:
    step: AbortStep = "waits"
    if report.state is not State.NOT_KNOWN:
        step = "aboard"
    elif report.sent:
        step = "sent"
    given, expires = line.clock.of_link(report.given), line.clock.of_link(report.expires)
    return OpenAbort(id=f"{report.id:016x}", step=step, words=report.words, given=given, expires=expires)
