"""How often values come: as the table of channels says, or less often where a slow line lets them."""

from collections import deque
from collections.abc import Sequence
from statistics import median

from stommel.station.channels import Channel, channel_named, channels_of

INTERVALS = 9
"""Of a message are remembered; what lies between most of them is usual, and a silence is none of those."""


class Periods:
    """Learns from when messages come; times by one clock [s]."""

    def __init__(self) -> None:
        self._last: dict[str, float] = {}
        self._intervals: dict[str, deque[float]] = {}

    def take(self, message: str, at: float) -> None:
        """Take note that a message came."""
        interval = at - self._last.get(message, at)
        if interval < 0.0:  # the clock was set back, or it is a value of before
            return
        self._last[message] = at
        if interval > 0.0 and channels_of(message):
            self._intervals.setdefault(message, deque(maxlen=INTERVALS)).append(interval)

    def take_samples(self, samples: Sequence[tuple[str, float, float]]) -> None:
        """Take key, time and value of samples in the order in which they came, all of one message at one time."""
        for key, t, _ in samples:
            channel = channel_named(key)
            if channel is not None:
                self.take(channel.message, t)

    def of(self, channel: Channel) -> float:
        """Usual time between two values of a channel [s]."""
        return max(channel.period_s, median(tuple(self._intervals.get(channel.message, ())) or (0.0,)))

    def of_key(self, key: str) -> float:
        """The same by the key of the channel; 0 where there is no such channel."""
        channel = channel_named(key)
        return 0.0 if channel is None else self.of(channel)
