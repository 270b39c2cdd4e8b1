"""How much is lost, by the size of frames, and which size of segment carries most."""

import math

MOST_SEGMENT = 244
"""Bytes of data in FILE_DATA."""
LEAST_SEGMENT = 32
OVERHEAD = 12 + 13 + 11
"""Bytes of a FILE_DATA beside its data: frame, signature, header."""
SHORT_EVERY = 8
"""While the loss is measured by size, every so many frames, by their number, have half a segment."""
_WINDOW = 400.0
"""Frames over which is averaged."""
_ENOUGH = 12.0
"""Lost frames of a size, without which nothing is concluded."""
_PROBE_ABOVE = 0.03
_SURE, _NEAR = 250.0, 0.7
"""Short frames, or nearness of the worst that may be, that settle that the segment stays for `_PROBE_AGAIN` frames."""
_PROBE_AGAIN = 1000


class _Size:
    """Frames of one size: came and lost, the older the lighter."""

    def __init__(self) -> None:
        self.came = self.lost = 0.0

    def note(self, came: int, lost: int) -> None:
        fade = math.exp(-(came + lost) / _WINDOW)
        self.came, self.lost = self.came * fade + came, self.lost * fade + lost

    @property
    def total(self) -> float:
        return self.came + self.lost

    @property
    def log_passed(self) -> float:
        """Logarithm of the share that came; never of nothing."""
        return math.log((self.came + 0.5) / (self.total + 0.5))


class LossBySize:
    """Counts frames by their numbers, and chooses the segment.

    A frame of `n` bytes comes with probability `exp(-a - b n)`: `a` is lost whatever its size (fades, collisions), `b`
    by every byte (flipped bits). Frames of half a segment beside whole ones tell the two apart. The segment `s` that
    carries most with `h` bytes of overhead maximises `s / (s + h) exp(-b (s + h))`.
    """

    def __init__(self) -> None:
        self.segment = MOST_SEGMENT
        self._whole, self._short = _Size(), _Size()
        self._next: int | None = None
        self.frames_lost = self.frames_came = 0
        self.is_probing = False
        self._probe_at = 50

    @property
    def share(self) -> float:
        """Of frames that are lost."""
        total = self._whole.total + self._short.total
        return 0.0 if total < 1.0 else (self._whole.lost + self._short.lost) / total

    def forget_number(self) -> None:
        """The next frame counts from wherever it is: the sender has begun anew."""
        self._next = None

    def note(self, number: int, *, probing: bool = False) -> None:
        """Note the number of a frame that came, 16 bits that go round, and whether its sender makes short ones."""
        ahead = 0 if self._next is None else (number - self._next) & 0xFFFF
        if ahead >= 0x8000:
            return  # one that was overtaken: it was counted as lost, and that is forgiven by the average
        if ahead < 4096:  # more is silence, not loss
            skipped = [(number - k) & 0xFFFF for k in range(1, ahead + 1)]
            short = sum(each % SHORT_EVERY == 0 for each in skipped) if probing else 0
            self._whole.note(0, ahead - short)
            self._short.note(0, short)
            self.frames_lost += ahead
        is_short = probing and number % SHORT_EVERY == 0
        (self._short if is_short else self._whole).note(1, 0)
        self.frames_came += 1
        self._next = (number + 1) & 0xFFFF

    def choose(self) -> int:
        """Return the segment for the next request, and whether to probe in `is_probing`."""
        counted = self.frames_came + self.frames_lost
        if not self.is_probing:
            self.is_probing = counted >= self._probe_at and self.share > _PROBE_ABOVE
            return self.segment
        whole, short = self._whole, self._short
        if whole.lost >= _ENOUGH and whole.total >= 60.0 and short.total >= 10.0:
            apart = self.segment - self.segment // 2
            by_byte = (short.log_passed - whole.log_passed) / apart
            doubt = 2.0 * math.sqrt(_variance(whole) + _variance(short)) / apart
            best = min(max(self.segment, best_segment(by_byte + doubt)), best_segment(by_byte - doubt))
            if best != self.segment:
                self.segment = best
                self._whole, self._short = _Size(), _Size()
            elif short.total >= _SURE or best_segment(by_byte + doubt) > _NEAR * self.segment:
                self.is_probing, self._probe_at = False, counted + _PROBE_AGAIN
        return self.segment


def _variance(size: _Size) -> float:
    """Of the logarithm of the share that came."""
    came = size.came + 0.5
    return max(size.lost, 0.5) / (came * (size.total + 0.5))


def best_segment(loss_by_byte: float) -> int:
    """Return the segment that carries most where each byte loses so much."""
    if loss_by_byte <= 0.0:
        return MOST_SEGMENT
    best = (math.sqrt(OVERHEAD**2 + 4.0 * OVERHEAD / loss_by_byte) - OVERHEAD) / 2.0
    return min(max(round(best), LEAST_SEGMENT), MOST_SEGMENT)
