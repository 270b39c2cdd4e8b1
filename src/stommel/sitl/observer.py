"""What is remembered of a flight while it is watched: the last events and the last dives, in words and numbers."""

from collections import deque
from dataclasses import dataclass, field
from typing import NamedTuple

from stommel.onboard.coordination.executive import State
from stommel.onboard.coordination.view import View
from stommel.sitl.system import System

EVENTS = 8
"""Events that are kept."""
DEPTHS = 160
"""Depths of the trace."""
LONGEST_INTERVAL = 60.0
"""Between two depths of a long trace [s]; then the oldest go."""


class Happened(NamedTuple):
    """One event."""

    t: float
    """[s]"""
    words: str
    grave: bool
    """Whether it is an alarm that was raised."""


@dataclass
class Observer:
    """Looks at a system after each step; it takes microseconds."""

    events: deque[Happened] = field(default_factory=lambda: deque(maxlen=EVENTS))
    depths: deque[float] = field(default_factory=deque)
    """By the vehicle's own sensor [m], `interval` apart."""
    interval: float = 5.0
    """[s]"""
    _due: float = 0.0
    _before: tuple[State, int] | None = None

    def __call__(self, system: System) -> None:
        """Note what is new."""
        view = system.coordinator.view
        if view is None:
            return
        state = (view.executive.state, view.executive.phase)
        if state != self._before:
            self._note_state(view, state)
        for name in view.safety.raised:
            self.events.append(Happened(view.t, name, True))
        for name in view.safety.cleared:
            self.events.append(Happened(view.t, f"over: {name}", False))
        if view.t >= self._due:
            self._note_depth(view)

    def _note_state(self, view: View, state: tuple[State, int]) -> None:
        before, self._before = self._before, state
        if before is not None and before[0] is state[0] is not State.MISSION:
            return  # a phase of control that is not flown
        within = before is not None and before[0] is state[0]
        because = "" if within else f" ({view.executive.because})"
        self.events.append(Happened(view.t, f"{view.executive.words}{because}", False))

    def _note_depth(self, view: View) -> None:
        depths = self.depths
        depths.append(view.situation.readings.depth)
        self._due = view.t + self.interval
        if len(depths) > DEPTHS:
            if 2.0 * self.interval <= LONGEST_INTERVAL:
                self.interval *= 2.0
                self.depths = deque(list(depths)[::2])
            else:
                depths.popleft()
