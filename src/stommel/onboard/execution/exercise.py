"""The moving part of the motion-control node's self-test: each drive goes a little way and comes back.

A drive that says nothing wrong while it stands may still be stuck; only one that has moved is proven.
"""

from typing import NamedTuple

from stommel.onboard.execution.motion_drives import MotionDrives

OIL_STILL, MASS_STILL, STEERING_STILL = 64, 128, 256
"""Bits of what a self-test found, beside those of the drives at rest: a drive that did not follow."""

OIL_WAY, MASS_WAY, STEERING_WAY = 2e-6, 3e-3, 0.05
"""How far each goes [m3], [m], [rad]; farther where its tolerance is wide."""
LEG_TIME = 20.0
"""Time in which it must have gone there, and the same back [s]."""
_TOLERANCES = 4.0
_ARRIVED = 2.0
"""Distances in tolerances: of the way, and within which the drive has arrived."""

Goals = tuple[float, float, float]


class _Leg(NamedTuple):
    goals: Goals
    axis: int
    """Of ballast, moving mass and steering."""
    bit: int


class Exercise:
    """Goes through the legs; `found` says which drives did not follow, once it is `done`.

    Parameters
    ----------
    drives
        Whose places are measured; they are brought back to where they are.
    t
        Time of the node [s].
    """

    def __init__(self, drives: MotionDrives, t: float) -> None:
        s, self._drives = drives.settings, drives
        self._tolerances = (s.oil_tolerance, s.mass_tolerance, s.steering_tolerance)
        home = (drives.engine.reading, drives.mass.reading, drives.steering.reading)
        lows = (s.ballast_low, s.mass_low, -s.steering_limit)
        self._legs: list[_Leg] = []
        bits, ways = (OIL_STILL, MASS_STILL, STEERING_STILL), (OIL_WAY, MASS_WAY, STEERING_WAY)
        for axis, (bit, way) in enumerate(zip(bits, ways, strict=True)):
            step = max(way, _TOLERANCES * self._tolerances[axis])
            there = list(home)
            there[axis] += -step if home[axis] - step >= lows[axis] else step
            self._legs += [_Leg((there[0], there[1], there[2]), axis, bit), _Leg(home, axis, bit)]
        self._began = t
        self.found = 0

    @property
    def done(self) -> bool:
        """Whether all legs are over."""
        return not self._legs

    @property
    def goals(self) -> Goals:
        """Where the drives shall stand now; not asked for once it is done."""
        return self._legs[0].goals

    def observe(self, t: float) -> None:
        """Look where the drives are at a time [s]."""
        leg, drives = self._legs[0], self._drives
        axis = (drives.engine, drives.mass, drives.steering)[leg.axis]
        away = abs(axis.reading - leg.goals[leg.axis])
        if axis.measured and away <= _ARRIVED * self._tolerances[leg.axis]:
            self._next(t)
        elif t - self._began >= LEG_TIME or not axis.measured:
            self.found |= leg.bit
            self._next(t)

    def _next(self, t: float) -> None:
        del self._legs[0]
        self._began = t
