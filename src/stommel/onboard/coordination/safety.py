"""The safety monitor: goes through the table of failsafes at every decision, and says what the vehicle must do."""

from typing import NamedTuple

from stommel.errors import StommelError
from stommel.onboard.coordination.failsafes import FAILSAFES, Cleared, Reaction
from stommel.onboard.coordination.limits import SafetyLimits
from stommel.onboard.coordination.situation import Situation
from stommel.onboard.coordination.start_checks import StartChecks
from stommel.onboard.coordination.track import Track

_ROWS = tuple((k, row.holds, row.debounce) for k, row in enumerate(FAILSAFES))
_NUMBERS = {row.name: k for k, row in enumerate(FAILSAFES)}


class UnknownFailsafeError(StommelError):
    """There is no failsafe of this name."""


class ActiveAlarm(NamedTuple):
    """An alarm that is raised and not yet over."""

    name: str
    """Of its row in `FAILSAFES`."""
    since: float
    """When it was raised, time of the vehicle [s]."""
    reaction: Reaction
    """Of the row; without a drop weight the last one is `ABORT`."""


class SafetyState(NamedTuple):
    """What safety says at one decision."""

    active: tuple[ActiveAlarm, ...]
    """In the order in which they were raised."""
    worst: Reaction
    """The strongest reaction of those."""
    raised: tuple[str, ...]
    """Names of those that were raised at this decision."""
    cleared: tuple[str, ...]
    """Names of those that are over since this decision."""
    reason: str
    """Word for the worst in the CAN database's `Abort.reason`; of equals the first raised."""
    unproven: tuple[str, ...]
    """Names of the start checks that have not passed."""
    submerged: bool
    """Whether the vehicle is under water, by all that is known."""


class SafetyMonitor:
    """Looks at one situation after the other.

    Parameters
    ----------
    limits
        Numbers of the vehicle.
    has_drop_weight
        Whether the vehicle has one; else the last resort is the last reaction.
    standing
        Names of alarms that stood before a restart of the software and that a restart does not clear; of others nothing
        is kept.

    Raises
    ------
    UnknownFailsafeError
        A name in `standing` is none of the table.
    """

    def __init__(self, limits: SafetyLimits, has_drop_weight: bool, standing: tuple[str, ...] = ()) -> None:
        self.limits = limits
        self.checks = StartChecks(limits)
        self.track = Track()
        self._has_drop_weight = has_drop_weight
        self._held_since: dict[int, float] = {}
        self._gone_since: dict[int, float] = {}
        self._active: dict[int, ActiveAlarm] = {}
        for name in standing:
            if name not in _NUMBERS:
                raise UnknownFailsafeError(f"{name}: is no failsafe; known are {', '.join(_NUMBERS)}")
            if FAILSAFES[_NUMBERS[name]].cleared_by in (Cleared.OPERATOR, Cleared.NEVER):
                self._active[_NUMBERS[name]] = ActiveAlarm(name, 0.0, self._reaction(_NUMBERS[name]))
        self._alarms: tuple[ActiveAlarm, ...] = tuple(self._active.values())

    def update(self, now: Situation, *, clear: bool = False) -> SafetyState:
        """Look at the next situation.

        Parameters
        ----------
        now
            What is known.
        clear
            Whether the operator clears the alarms: those that an operator may clear and whose cause is gone.
        """
        track, limits, held, active = self.track, self.limits, self._held_since, self._active
        track.follow(now, limits.submerged_depth)
        track.unproven = self.checks.unproven(now)
        raised: list[int] = []
        holding: set[int] = set()
        for k, holds, debounce in _ROWS:
            if holds(now, track, limits):
                holding.add(k)
                since = held.setdefault(k, track.clock)
                if track.clock - since >= debounce and k not in active:
                    raised.append(k)
            elif held:
                held.pop(k, None)
        for k in raised:
            active[k] = ActiveAlarm(FAILSAFES[k].name, now.t, self._reaction(k))
        cleared = self._cleared(holding, clear) if active else []
        if raised or cleared:
            self._alarms = tuple(active.values())
        return self._state(raised, cleared)

    def _reaction(self, k: int) -> Reaction:
        reaction = FAILSAFES[k].reaction
        return reaction if self._has_drop_weight else min(reaction, Reaction.ABORT)

    def _cleared(self, holding: set[int], clear: bool) -> list[int]:
        """Take out the alarms that are over, each as its row says."""
        clock, gone = self.track.clock, self._gone_since
        cleared = []
        for k in self._active:
            if k in holding:
                gone.pop(k, None)
                continue
            row, since = FAILSAFES[k], gone.setdefault(k, clock)
            by_itself = row.cleared_by is Cleared.SELF and clock - since >= row.clear_after
            if by_itself or (clear and row.cleared_by in (Cleared.SELF, Cleared.OPERATOR)):
                cleared.append(k)
        for k in cleared:
            del self._active[k], gone[k]
        return cleared

    def _state(self, raised: list[int], cleared: list[int]) -> SafetyState:
        worst, reason = Reaction.NONE, "None"
        for alarm in self._alarms:
            if alarm.reaction > worst:
                worst, reason = alarm.reaction, FAILSAFES[_NUMBERS[alarm.name]].reason
        track = self.track
        names, over = tuple(FAILSAFES[k].name for k in raised), tuple(FAILSAFES[k].name for k in cleared)
        return SafetyState(self._alarms, worst, names, over, reason, track.unproven, track.submerged)


def standing_alarms(state: SafetyState) -> tuple[str, ...]:
    """Names of the active alarms that a restart does not clear, to be kept where a restart finds them."""
    kept = (Cleared.OPERATOR, Cleared.NEVER)
    return tuple(alarm.name for alarm in state.active if FAILSAFES[_NUMBERS[alarm.name]].cleared_by in kept)
