"""What came twice and what is missing, by the sequence numbers of a peer's frames."""

import math
from dataclasses import dataclass

_NUMBERS = 256
_MEMORY = 3.0
"""How long a frame is remembered, to know it again, and missed, to find it late [s]."""
_BEHIND = 128
"""How many frames later it is another one, whose number came round."""
_SILENCE = 5.0, 60.0
"""After which nobody can tell how much is missing [s]: half of a round at the peer's pace, within these."""
_PACE = 1.0
"""Over which the peer's pace is averaged [s]."""


@dataclass
class SequenceCounts:
    """Frames of a peer."""

    good: int = 0
    duplicate: int = 0
    lost: int = 0
    """Missing between those that came; one that comes late is missing no longer."""
    restarts: int = 0
    """How often the numbers began anew."""


class SequenceWatch:
    """Watches the numbers of one peer.

    A gap is a loss if the peer can have sent so much at its pace; else it has restarted. One that goes back to a number
    that nobody missed has restarted too. Both are no losses.
    """

    def __init__(self) -> None:
        self.counts = SequenceCounts()
        self._next: int | None = None
        """Number of the frame that is expected, where numbers go on after 255."""
        self._heard = -math.inf
        self._seen: dict[int, tuple[int, int, float]] = {}
        self._missing: dict[int, tuple[int, float]] = {}
        self._recent = 0.0
        """Frames sent lately, older ones weighing less."""

    def is_duplicate(self, number: int, content: int, t: float) -> bool:
        """Whether a frame that came at a time [s] came before; `content` tells it from another of its number."""
        seen = self._seen.get(number)
        if seen is None or seen[0] != content or not self._is_recent(seen[1], seen[2], t):
            return False
        self.counts.duplicate += 1
        return True

    def take(self, number: int, content: int, t: float) -> None:
        """Take note of a frame that is none of those."""
        self.counts.good += 1
        missed = self._missing.pop(number, None)
        if missed is not None and self._is_recent(*missed, t):
            self.counts.lost -= 1
            self._seen[number] = content, missed[0], t
            return
        self._seen[number] = content, self._go_on(number, t), t

    def _is_recent(self, place: int, at: float, t: float) -> bool:
        return t - at <= _MEMORY and (self._next or 0) - place <= _BEHIND

    def _go_on(self, number: int, t: float) -> int:
        """Take note of a number that was not missed, and return its place."""
        silence = max(t - self._heard, 0.0)
        expected = number if self._next is None else self._next
        gap = (number - expected) % _NUMBERS
        restarted = gap and self._is_restart(number, gap, silence)
        if restarted or silence > self._longest_silence():
            self.counts.restarts += bool(restarted)
            self._missing.clear()
            expected, gap = expected + gap, 0
        for missing in range(expected, expected + gap):
            self._missing[missing % _NUMBERS] = missing, t
        self.counts.lost += gap
        self._recent = self._recent * math.exp(-silence / _PACE) + gap + 1
        self._next, self._heard = expected + gap + 1, t
        return expected + gap

    def _longest_silence(self) -> float:
        low, high = _SILENCE
        return min(max(_BEHIND * _PACE / self._recent, low), high) if self._recent else low

    def _is_restart(self, number: int, gap: int, silence: float) -> bool:
        plausible = 8.0 + 2.0 * self._recent / _PACE * silence
        return gap > plausible or (gap >= 16 and number < 4)
