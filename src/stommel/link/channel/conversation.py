"""Two sessions over a simulated channel, on virtual time."""

from collections.abc import Callable

from stommel.link.channel.channel import Channel
from stommel.link.exchange import exchange
from stommel.link.rate import bytes_ahead
from stommel.link.session import Session


class Conversation:
    """Lets a vehicle and a shore station talk.

    Parameters
    ----------
    vehicle, shore
        Both sessions; either may be replaced meanwhile, as by a restart.
    channel
        What is between them.
    step
        How often each end looks at its modem [s].
    """

    def __init__(self, vehicle: Session, shore: Session, channel: Channel, step: float = 0.005) -> None:
        self.vehicle, self.shore, self.channel = vehicle, shore, channel
        self.t = 0.0
        """Now [s]."""
        self._begin, self._steps, self._step = 0.0, 0, step
        self._ahead = int(bytes_ahead(channel.settings.bit_rate))

    def run(self, until: Callable[[], bool], longest: float, step: float | None = None) -> bool:
        """Go on until something is so, and return whether it is; for at most so long [s]."""
        end = self.t + longest
        if step is not None and step != self._step:
            self._begin, self._steps, self._step = self.t, 0, step
        while not until():
            if self.t >= end:
                return False
            self._steps += 1
            self.t = self._begin + self._steps * self._step  # a sum of steps would drift
            exchange(self.vehicle, self.channel.vehicle, self.t, self._ahead)
            exchange(self.shore, self.channel.shore, self.t, self._ahead)
        return True
