"""What of the bytes was of use: goodput, and how much was sent again."""

from collections import deque

_OVER = 10.0
"""Over which goodput is averaged [s]."""


class Traffic:
    """Counts that the services of an end share."""

    def __init__(self) -> None:
        self.sent_bytes = 0
        """Of files and lists."""
        self.again_bytes = 0
        """Of those, what was sent before."""
        self.new_bytes = 0
        """That came and were new."""
        self._recent: deque[tuple[float, int]] = deque()
        self._in_recent = 0

    def sent(self, count: int, *, again: bool = False) -> None:
        """Take note of payload that was sent."""
        self.sent_bytes += count
        self.again_bytes += count if again else 0

    def received(self, count: int, t: float) -> None:
        """Take note of payload that came at a time [s] and was new."""
        self.new_bytes += count
        if self._recent and t - self._recent[-1][0] < 0.1:
            at, before = self._recent.pop()
            self._recent.append((at, before + count))
        else:
            self._recent.append((t, count))
        self._in_recent += count
        self._forget(t)

    def goodput(self, t: float) -> float:
        """New payload a second, over the last ten or since the first [B/s]."""
        self._forget(t)
        if not self._recent:
            return 0.0
        return self._in_recent / _OVER if self.new_bytes > self._in_recent else self._young(t)

    @property
    def retransmit_ratio(self) -> float:
        """Bytes sent again to bytes sent."""
        return self.again_bytes / self.sent_bytes if self.sent_bytes else 0.0

    def _young(self, t: float) -> float:
        return self._in_recent / min(max(t - self._recent[0][0], 1.0), _OVER)

    def _forget(self, t: float) -> None:
        while self._recent and t - self._recent[0][0] > _OVER:
            self._in_recent -= self._recent.popleft()[1]
