"""One drive with feedback: how long to run its motor, and whether it follows."""

from dataclasses import dataclass, field
from math import copysign, inf, isnan, nan
from typing import NamedTuple

LEAST_SPEED = 0.05
"""Part of the expected speed below which a drive does not follow."""
LOOK = 1.0
"""Running time after which a speed is taken, however small the way [s]."""
STOPS_WITHIN = 0.25
"""Part of the tolerance within which a movement ends."""
PLAUSIBLE = 0.25
"""Part of the way by which a reading may lie beyond an end; farther off it is an error value."""
BLIND = 1.5
"""Part of the whole way's time for which a drive runs towards its end without a sensor."""
SLIPS, SLIPS_WITHIN = 0.1, 10.0
"""Share of the time for which a drive that is at its set point works upwards only to stay there, above which what it
moves slips away; and the time over which the share is taken [s]."""
PATIENT, RARELY = 5.0, 150.0
"""Longest pauses in the last reaction [s]: at first, and once a drive has run for as long as its whole way takes and
was never seen to follow."""


class AxisLimits(NamedTuple):
    """What is known of a drive; units of its way are the axis's own."""

    low: float
    high: float
    tolerance: float
    speed_up: float
    """Expected towards `high` [1/s]."""
    speed_down: float
    fastest_up: float
    """What a movement of unknown speed reckons with [1/s]."""
    fastest_down: float
    current: float
    """Greatest current [A]."""
    stuck_after: float
    """[s]"""
    pause: float
    """[s]"""
    retries: int


@dataclass
class Effort:
    """A drive in one direction."""

    speed: float = nan
    """As last seen in this movement; not a number until then."""
    tries: int = 0
    """Failures in a row."""
    failed_at: float = -inf
    """[s]"""
    run: float = 0.0
    moved: float = 0.0
    """Running time and way since the speed was last taken."""
    watched: float = 0.0
    followed: float = 0.0
    """Running time and way since it was last seen to follow."""
    blind: float = 0.0
    """Running time without a sensor."""

    def begin(self) -> None:
        """Begin a movement of unknown speed."""
        self.speed, self.run, self.moved = nan, 0.0, 0.0

    def learn(self, ran: float, moved: float, expected: float, limits: AxisLimits) -> bool:
        """Take what a run did; return whether the drive has failed to follow."""
        self.run += ran
        self.moved += moved
        if self.moved >= limits.tolerance or self.run >= LOOK:
            if self.moved > LEAST_SPEED * expected * self.run:
                self.speed = self.moved / self.run
            self.run = self.moved = 0.0
        self.watched += ran
        self.followed += moved
        if self.watched < limits.stuck_after:
            return False
        follows = self.followed >= LEAST_SPEED * expected * self.watched
        self.watched = self.followed = 0.0
        if follows:
            self.tries = 0
        return not follows

    def fail(self, t: float) -> None:
        """Rest until the next try."""
        self.tries += 1
        self.watched = self.followed = 0.0
        self.failed_at = t


@dataclass
class Axis:
    """A drive that is held at a set point by shares of the time that its motor runs."""

    limits: AxisLimits
    reading: float = nan
    share: float = 0.0
    """Of the time until the next step, positive towards `high`."""
    over_current: bool = False
    """A motor took too much and was stopped; until it runs again without."""
    crept: float = 0.0
    """Way that it went to keep a set point that it had reached, both directions added."""
    slips: bool = False
    """Whether it slips away from set points that it has reached, until failures are cleared."""
    up: Effort = field(default_factory=Effort)
    down: Effort = field(default_factory=Effort)
    _t: float = nan
    _interval: float = 0.0
    _moved_before: float = 0.0
    """Direction of the movement before this time: +1, -1, or 0."""
    _moving: float = 0.0
    _held: float = nan
    """Set point that was reached last."""
    _keeps: float = 0.0
    """Speed at which the drive runs to keep the set point; zero while it runs towards a new one."""
    _keeping: float = 0.0
    """Share of the time for which it worked upwards to keep a set point, smoothed."""
    _current_untrue: bool = False
    """Whether the current was too high although the motor did not run: the last reaction then does without it."""

    @property
    def measured(self) -> bool:
        """Whether its sensor answers."""
        return not isnan(self.reading)

    @property
    def stuck(self) -> bool:
        """Whether it was given up in a direction."""
        return self.given_up(self.up) or self.given_up(self.down)

    def given_up(self, effort: Effort) -> bool:
        """Whether a direction was tried as often as it may be."""
        return effort.tries > self.limits.retries

    def clear(self) -> None:
        """Forget failures, as told."""
        self.over_current, self.slips, self._keeping = False, False, 0.0
        for effort in (self.up, self.down):
            effort.tries, effort.failed_at, effort.blind = 0, -inf, 0.0
            effort.watched = effort.followed = 0.0

    def observe(self, t: float, reading: float, current: float) -> None:
        """Take readings at a time; of the first step at a time the drive learns what it did since the step before."""
        limits = self.limits
        margin = PLAUSIBLE * (limits.high - limits.low)
        if not limits.low - margin <= reading <= limits.high + margin:
            reading = nan
        before, self.reading = self.reading, reading
        if t == self._t:
            return
        passed = 0.0 if isnan(self._t) else t - self._t
        ran = min(passed, abs(self.share) * self._interval)
        self._t, self._moved_before = t, self._moving
        self._watch_slipping(passed, ran)
        self._watch_current(t, current, ran > 0.0)
        if ran > 0.0:
            self.crept += ran * self._keeps
            self._learn(t, ran, before)

    def drive(
        self, goal: float | None, interval: float, endless: bool = False, may_up: bool = True, may_down: bool = True
    ) -> float:
        """Return the share of an interval [s] for which the motor runs; None as goal stops it.

        `endless` holds for the last reaction: the goal is an end of the way, a drive that does not follow is tried
        for ever, and one without a sensor runs for as long as the whole way takes.
        """
        self.share, self._moving, self._interval = 0.0, 0.0, interval
        if goal is None or not interval > 0.0 or (self._current_untrue and not endless):
            return 0.0
        limits = self.limits
        if isnan(self.reading):
            if endless:
                self._drive_blindly(1.0 if goal > 0.5 * (limits.low + limits.high) else -1.0, may_up, may_down)
            return self.share
        missing = min(limits.high, max(limits.low, goal)) - self.reading
        goes_on = self._moved_before * missing > 0.0
        if abs(missing) <= (STOPS_WITHIN * limits.tolerance if goes_on else limits.tolerance):
            self._held = goal
            return 0.0
        if self._moved_before * missing < 0.0:
            self._held = goal  # it was there, and went past
        self._moving = copysign(1.0, missing)
        effort, may, fastest = (
            (self.up, may_up, limits.fastest_up) if missing > 0.0 else (self.down, may_down, limits.fastest_down)
        )
        if not goes_on:
            effort.begin()
        if may and self._may_try(effort, self._moving, endless):
            speed = fastest if isnan(effort.speed) else effort.speed
            self.share = copysign(min(1.0, abs(missing) / (speed * interval)), missing)
            self._keeps = speed if goal == self._held else 0.0
        return self.share

    def _may_try(self, effort: Effort, direction: float, endless: bool) -> bool:
        pause = self.limits.pause
        if endless:
            # settings that are wrong must not keep the vehicle down
            often = effort.tries * self.limits.stuck_after < self._blind_time(direction)
            pause = min(pause, PATIENT) if often else RARELY
        return self._t >= effort.failed_at + pause and (endless or not self.given_up(effort))

    def _drive_blindly(self, direction: float, may_up: bool, may_down: bool) -> None:
        effort, may = (self.up, may_up) if direction > 0.0 else (self.down, may_down)
        if may and effort.blind < self._blind_time(direction) and self._may_try(effort, direction, endless=True):
            self.share = self._moving = direction
            self._keeps = 0.0

    def _blind_time(self, direction: float) -> float:
        limits = self.limits
        return BLIND * (limits.high - limits.low) / (limits.speed_up if direction > 0.0 else limits.speed_down)

    def _learn(self, t: float, ran: float, before: float) -> None:
        direction = copysign(1.0, self.share)
        effort, expected = (self.up, self.limits.speed_up) if direction > 0.0 else (self.down, self.limits.speed_down)
        if isnan(self.reading):
            effort.blind += ran
            return
        effort.blind = 0.0
        if not isnan(before) and effort.learn(ran, direction * (self.reading - before), expected, self.limits):
            effort.fail(t)

    def _watch_slipping(self, passed: float, ran: float) -> None:
        """Take for how long of the time that passed it worked upwards to keep a set point [s]."""
        if not passed > 0.0:
            return
        share = ran / passed if self._keeps > 0.0 and self.share > 0.0 else 0.0
        self._keeping += min(1.0, passed / SLIPS_WITHIN) * (share - self._keeping)
        self.slips = self.slips or self._keeping > SLIPS

    def _watch_current(self, t: float, current: float, running: bool) -> None:
        too_much = bool(current > self.limits.current)  # NumPy's own truth is no number for a frame
        if not (running and too_much):
            self._current_untrue = too_much
        elif not self._current_untrue:
            (self.up if self.share > 0.0 else self.down).fail(t)
        # a motor at rest that took too much has not shown yet that it no longer does
        self.over_current = too_much or (self.over_current and not running)
