"""The last proof of the buoyancy engine, while the vehicle still floats: oil that the pump does not bring back is not let in.

A pump that dies while it rests is noticed when it is next asked, and a valve that sticks open when it is next shut. In
a descent that is too late for a vehicle without a drop weight. So a descent stops for two seconds where the ballast of
the climb is left outside, with which the vehicle climbs in all of its water: there the valve shuts, and the pump lifts
a little oil. If it does not come, or does not stay, the vehicle waits there afloat, until the motion node says what is
stuck or all is well.
"""

from enum import Enum
from math import inf
from typing import NamedTuple

from stommel.control.dive_cycle import DESCENT

STROKES = 500.0
"""Strokes of the proof that make the engine's whole range."""
COMES_AT_ONCE = 0.8
"""Part of a stroke that a sound engine has at the next look; one that has less is looked at longer."""
NEAR = 4.0
"""Looks before the oil is down, from which on the valve is told to stop there: some frames may be lost."""
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
        self._before = inf
        """Oil at the look before, in a descent."""

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
            self.stage, self._before = Stage.VENTING, inf
            return wanted
        enough = min(climb, self._greatest - 2.0 * self._stroke)
        if self.stage is Stage.PROVEN:
            return wanted
        fell = max(0.0, self._before - oil.volume) if self._before < inf else 0.0
        self._before = oil.volume
        self._look(t, enough, fell, oil)
        return max(wanted, self._goal(wanted, enough, fell, oil.volume))

    def _goal(self, wanted: float, enough: float, fell: float, volume: float) -> float:
        """Ballast volume to go to, with what ran in since the last look, and what is outside [m3]."""
        if self.stage is Stage.STROKE:
            return self._from + self._stroke
        if self.stage in (Stage.LIFTING, Stage.STAYING):
            return self._lifted(enough)
        far = volume - NEAR * fell > enough
        # told to stop where one look more will find it, so as not to slow down before
        return wanted if self.stage is Stage.PROVEN or far else enough - fell - self._stroke

    def _lifted(self, enough: float) -> float:
        return min(self._greatest, enough + LONGER * self._stroke)

    def _look(self, t: float, enough: float, fell: float, oil: Oil) -> None:
        """Take the oil, and go on to the stage that follows."""
        stroke = self._stroke
        if self.stage is Stage.VENTING and oil.volume <= enough:
            self._enter(Stage.STROKE, t)
            self._from = oil.volume
        elif self.stage is Stage.STROKE and oil.told_at > self._since:
            came = oil.volume - self._from >= COMES_AT_ONCE * stroke and not oil.stuck
            self._enter(Stage.PROVEN if came else Stage.LIFTING, t)
        elif self.stage is Stage.LIFTING and oil.volume >= self._lifted(enough) - 0.5 * stroke:
            self._enter(Stage.STAYING, t)
        elif self.stage is Stage.STAYING and oil.stuck:
            self._enter(Stage.LIFTING, t)
        elif self.stage is Stage.STAYING and t - self._since >= STAYS_FOR:
            self._enter(Stage.PROVEN, t)

    def _enter(self, stage: Stage, t: float) -> None:
        self.stage, self._since = stage, t
