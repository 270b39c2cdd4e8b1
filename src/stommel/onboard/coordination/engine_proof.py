"""The last proof of the buoyancy engine, while the vehicle still floats.

A pump that dies while it rests is noticed when it is next asked, and a valve that sticks open when it is next shut. In
a descent that is too late for a vehicle without a drop weight. So a descent stops for two or three seconds where the
ballast of the climb is left outside, with which the vehicle climbs in all of its water: there the valve shuts, and the
pump lifts a little oil. If it does not come, or does not stay, the vehicle waits there afloat, until the motion node
says what is stuck or all is well.
"""

from enum import Enum
from math import inf
from typing import NamedTuple

from stommel.control.dive_cycle import DESCENT

STROKES = 500.0
"""Strokes of the proof that make the engine's whole range."""
COMES_AT_ONCE = 0.8
"""Part of a stroke that a sound engine has at the next look; one that has less is looked at longer."""
PAST = 4.0
"""Strokes below the climb's ballast at which the valve stops if no look finds the oil before: it need not slow down."""
LONGER = 10.0
"""Strokes that the pump then lifts."""
STAYS_FOR = 15.0
"""How long it must then keep the oil without a word from the motion node [s]; that takes some 10 s to see it slip."""


class Stage(Enum):
    """Where the proof is."""

    VENTING = "oil runs in down to the ballast of the climb"
    STROKE = "the pump lifts a stroke"
    LIFTING = "the pump lifts ten"
    STAYING = "the oil must stay"
    PROVEN = "proven, for this descent"


class Oil(NamedTuple):
    """The oil outside as the coordinator hears it."""

    volume: float
    """As ballast volume [m3]."""
    told_at: float
    """When it was told [s]."""
    stuck: bool
    """Whether the motion node says that pump or valve is stuck."""


class EngineProof:
    """Goes through the stages in each descent.

    Parameters
    ----------
    least, greatest
        Ballast volumes with all oil inside, and outside [m3].
    """

    def __init__(self, least: float, greatest: float) -> None:
        self.stage = Stage.VENTING
        self._greatest, self._stroke = greatest, (greatest - least) / STROKES
        self._from, self._since = inf, -inf

    def allowed(self, t: float, phase: int, wanted: float, climb: float, oil: Oil) -> float:
        """Return the ballast volume to go to at a time [s], the one that is wanted or a greater one [m3].

        Parameters
        ----------
        t
            Time of the decision [s].
        phase
            Of the dive cycle.
        wanted
            By `stommel.control` [m3].
        climb
            Ballast volume of the ascent [m3].
        oil
            As heard last.
        """
        if phase != DESCENT:
            self.stage = Stage.VENTING
            return wanted
        enough = min(climb, self._greatest - 2.0 * self._stroke)
        if self.stage is Stage.PROVEN:
            return wanted
        self._look(t, enough, oil)
        goals = {
            Stage.VENTING: enough - PAST * self._stroke,
            Stage.STROKE: self._from + self._stroke,
            Stage.PROVEN: wanted,
        }
        return max(wanted, goals.get(self.stage, self._lifted(enough)))

    def _lifted(self, enough: float) -> float:
        return min(self._greatest, enough + LONGER * self._stroke)

    def _look(self, t: float, enough: float, oil: Oil) -> None:
        """Take the oil, and go on to the stage that follows."""
        stroke = self._stroke
        if self.stage is Stage.VENTING and oil.volume <= enough:
            self._enter(Stage.STROKE, t)
            self._from = oil.volume
        elif self.stage is Stage.STROKE and oil.told_at > self._since:
            came = oil.volume - self._from >= COMES_AT_ONCE * stroke and not oil.stuck
            self._enter(Stage.PROVEN if came else Stage.LIFTING, t)
        elif self.stage is Stage.LIFTING and oil.volume >= self._lifted(enough) - stroke:
            self._enter(Stage.STAYING, t)
        elif self.stage is Stage.STAYING and oil.stuck:
            self._enter(Stage.LIFTING, t)
        elif self.stage is Stage.STAYING and t - self._since >= STAYS_FOR:
            self._enter(Stage.PROVEN, t)

    def _enter(self, stage: Stage, t: float) -> None:
        self.stage, self._since = stage, t
