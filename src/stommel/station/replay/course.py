"""How far a replay has come: a clock that goes at any speed, stands still and jumps, and knows no other clock."""

from dataclasses import dataclass

LEAST_SPEED, MOST_SPEED = 0.1, 1000.0
LONGEST_STEP = 0.5
"""Of real time that is made up for at once [s]: a replay that was held up goes on, and does not hurry after."""


@dataclass
class Course:
    """Where a replay is; times are those of the vehicle [s since 1970]."""

    begin: float
    end: float
    speed: float
    """Times real time."""
    at: float
    """All up to this time has been told."""
    paused: bool = False
    skip_silence: bool = False
    """Where nothing was received for a while, it goes on at what came next."""

    @property
    def is_at_end(self) -> bool:
        """Whether there is nothing more to tell."""
        return self.at >= self.end

    @property
    def goes_on(self) -> bool:
        """Whether time passes in it."""
        return not self.paused and not self.is_at_end

    def due(self, elapsed: float) -> float:
        """Until when it shall tell, if it has not told anything for a real time [s]."""
        step = self.speed * min(max(elapsed, 0.0), LONGEST_STEP)
        return min(self.at + step, self.end) if self.goes_on else self.at

    def jump(self, at: float) -> None:
        """Go on from a time between begin and end."""
        self.at = min(max(at, self.begin), self.end)
