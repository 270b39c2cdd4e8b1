"""What safety remembers from one situation to the next: whether the vehicle is down, sinks, rises, stands still."""

import math
from dataclasses import dataclass

from stommel.control.dive_cycle import DESCENT, DRIFT
from stommel.onboard.coordination.situation import Situation

SINKING = 0.02
"""Smoothed speed down above which the vehicle sinks [m/s]."""
SMOOTHING_TIME = 10.0
"""Of the speed down [s]."""
RISE = 1.0
"""Less depth by which it has risen [m]."""
STIR = 0.2
"""Change of depth by which the pressure sensor shows that it lives [m]."""
LONGEST_TICK = 10.0
"""A longer time between two situations counts as this [s]: a clock that jumps raises no alarm."""

_DOWN = (DESCENT, DRIFT)


@dataclass(slots=True)
class Track:
    """Memory of the situations so far."""

    clock: float = 0.0
    """Time that safety counts with [s]: that of the situations without their jumps."""
    tick: float = 0.0
    """Since the situation before [s], by the same clock."""
    submerged: bool = False
    """Deeper than the waves. Without a pressure sensor: was when it was last heard, or told to sink since, and has had
    no position since."""
    speed_down: float = 0.0
    """Smoothed [m/s]."""
    sinking: bool = False
    asked_up: bool = False
    """Whether control or the executive wants it up."""
    asked_up_for: float = 0.0
    """How long [s]."""
    not_risen: bool = False
    """Whether it is down, asked up, and has not risen by `RISE` since this became true."""
    depth_still: bool = False
    """Whether the depth has not changed by `STIR` since this became true."""
    node_restarted: bool = False
    unproven: tuple[str, ...] = ()
    """Start checks that have not passed."""
    _t: float = math.nan
    _depth: float = math.nan
    _risen_to: float = math.inf
    _stood_at: float = math.nan
    _restarts: int = 0

    def follow(self, now: Situation, submerged_depth: float) -> None:
        """Take the next situation."""
        tick = now.t - self._t
        self.tick = tick = min(tick, LONGEST_TICK) if tick > 0.0 else 0.0
        self._t = now.t
        self.clock += tick
        self.node_restarted = now.restarts > self._restarts
        self._restarts = now.restarts
        if now.pressure_silent:
            self.submerged = (self.submerged or now.phase in _DOWN) and not now.readings.fixed
            self.sinking = False
        else:
            self._follow_depth(now.readings.depth, tick, submerged_depth)
        self._follow_climb(now, tick)

    def _follow_depth(self, depth: float, tick: float, submerged_depth: float) -> None:
        self.submerged = depth > submerged_depth
        if tick > 0.0 and self._depth == self._depth:  # not a number before the first depth
            speed = (depth - self._depth) / tick
            self.speed_down += min(1.0, tick / SMOOTHING_TIME) * (speed - self.speed_down)
        self._depth = depth
        self.sinking = self.submerged and self.speed_down > SINKING
        self.depth_still = abs(depth - self._stood_at) <= STIR
        if not self.depth_still:
            self._stood_at = depth

    def _follow_climb(self, now: Situation, tick: float) -> None:
        """Whether it is asked up and rises; a silent pressure sensor does not tell."""
        self.asked_up = now.coming_up or now.phase not in _DOWN
        if not (self.asked_up and self.submerged):
            self.asked_up_for, self._risen_to, self.not_risen = 0.0, math.inf, False
            return
        self.asked_up_for += tick
        if now.pressure_silent:
            self.not_risen = False
            return
        self.not_risen = now.readings.depth > self._risen_to - RISE
        if not self.not_risen:
            self._risen_to = now.readings.depth
