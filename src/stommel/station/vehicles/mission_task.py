"""One request about missions, and what is true of it when it ends before the vehicle has answered."""

from dataclasses import dataclass, field
from math import inf
from typing import NamedTuple

from stommel.station.vehicles.mission_rows import MissionRow, MissionState

ASK_WITHIN = 600.0
"""Time within which the vehicle says which orders it holds [s]."""
HAS_NOT = "the vehicle has not switched to it, and keeps the one that it has"
MAYBE = "the vehicle may have switched to it already, and is asked what it holds"


@dataclass(eq=False)
class Task:
    """One request to the vehicle."""

    kind: str
    """ask, upload or roll-back."""
    user: str | None = None
    row: MissionRow | None = None
    """Of an upload."""
    within: float = ASK_WITHIN
    until: float = field(default=inf)
    """When its time is over, by the clock of the link [s]; an ask has its time when it begins."""
    may_be_aboard: bool = False
    """It was on its way when the station stopped, and the vehicle has not said since what it holds."""

    @property
    def is_of_people(self) -> bool:
        """Whether somebody has given it."""
        return self.kind != "ask"

    @property
    def title(self) -> str:
        """What it is, in words."""
        return "the return to the mission before" if self.row is None else f"“{self.row.name}”"


class EndedTask(NamedTuple):
    """What became of a request, until the archive has it."""

    task: Task
    state: str
    words: str
    user: str | None
    """Who ended it."""
    t: float
    """By the vehicle's clock [s since 1970]."""

    @property
    def as_state(self) -> MissionState:
        """As the archive has it."""
        return MissionState(self.t, self.user, self.state, self.words)
