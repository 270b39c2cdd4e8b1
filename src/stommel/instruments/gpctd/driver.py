"""Driver of the CTD: bytes in, readings out, live or out of its memory."""

import math
from collections import deque
from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

from stommel.instruments.framing import Framer
from stommel.instruments.gpctd.live import VARIANTS, live_reading
from stommel.instruments.gpctd.reading import CtdReading
from stommel.instruments.gpctd.stream import PROMPT, look
from stommel.instruments.gpctd.upload import FLUSHED, Cast, cast_of, sample
from stommel.instruments.health import Health
from stommel.instruments.settings import refuse, require_positive

_MOST_CASTS = 1000
"""That are kept of one list."""


class CtdState(StrEnum):
    """How the CTD does."""

    STARTING = "starting"
    IDLE = "idle"
    """It is not told to sample."""
    SAMPLING = "sampling"
    UPLOADING = "uploading"
    SILENT = "silent"
    GARBLED = "garbled"
    """Bytes come, but no line that it could send: another baud rate or variant."""
    NO_READING = "no reading"
    """It samples, and every value is an error value or out of range."""


class Upload(NamedTuple):
    """How the upload of a cast ended."""

    cast: Cast
    samples: int
    """That came."""
    complete: bool
    """Whether that is as many as the cast holds."""


@dataclass(frozen=True)
class CtdSettings:
    """How the CTD talks."""

    variant: str = "plain"
    """Of its live lines, one of `VARIANTS`."""
    oxygen: bool = False
    """Whether it has an SBE 43F: stored samples have a fourth value."""
    drop_flushed: bool = True
    """Whether the last samples of an upload are dropped, which are garbage of the instrument."""
    silence: float = 5.0
    """Without a line before it is told again to sample [s]."""

    def __post_init__(self) -> None:
        if self.variant not in VARIANTS:
            raise refuse("ctd.variant", self.variant, VARIANTS)
        require_positive("ctd.silence", self.silence)


class CtdDriver:
    """Tells the CTD to sample, lists its casts and uploads them. Its lines have no checksum: their form is all."""

    def __init__(self, settings: CtdSettings | None = None) -> None:
        self._set = settings or CtdSettings()
        self._variant = VARIANTS[self._set.variant]
        self._framer: Framer[bytes] = Framer(look, gap=math.inf)
        self._sampling = False
        self._queue = b""
        self._told = self._heard = self._lined = self._last = float("-inf")
        self._good = self._refused = 0
        self._whole = False
        self._reason = ""
        self._wanted: int | None = None
        self._came = 0
        self._held: deque[CtdReading] = deque()
        self.casts: dict[int, Cast] = {}
        """Casts of the last `list_casts`, by number."""
        self.uploaded: Upload | None = None
        """How the last upload ended."""

    def sample(self, on: bool) -> None:
        """Let it sample, or rest."""
        if on != self._sampling:
            self._sampling = on
            self._queue += b"\r\nstart\r\n" if on else b"\r\nstop\r\n"

    def list_casts(self) -> None:
        """Ask for the list of its casts."""
        self.casts = {}
        self._queue += b"UH\r\n"

    def upload(self, number: int) -> None:
        """Upload a cast of the list.

        Raises
        ------
        SettingError
            The list has no such cast.
        """
        if number not in self.casts:
            raise refuse("cast of the ctd", number, self.casts or ("those of a list that has come",))
        self._wanted, self._came, self.uploaded = number, 0, None
        self._held.clear()
        self._queue += b"UC%d\r\n" % number

    def poll(self, t: float) -> bytes:
        """Bytes to send now."""
        out, self._queue = self._queue, b""
        if out:
            self._told = t
        elif self._wanted is not None and t - max(self._told, self._lined) > self._set.silence:
            self._end_upload(t)
        elif self._sampling and t - max(self._told, self._lined) > self._set.silence:
            self._told, self._whole = t, False
            out = b"\r\nstart\r\n"
        return out

    def take(self, data: bytes, t: float) -> list[CtdReading]:
        """Readings that are complete with these bytes."""
        if data:
            self._heard = t
        readings = []
        for line, at in self._framer.take(data, t):
            readings += self._line(line, at)
        return readings

    def health(self, t: float) -> Health:
        """Return how the CTD does."""
        state, reason = self._state_at(t)
        return Health("ctd", state, self._last, self._good, self._framer.runs + self._refused, reason)

    def _line(self, line: bytes, t: float) -> list[CtdReading]:
        whole, self._whole = self._whole, True
        if line == PROMPT:
            if self._came:  # and not the prompt before the answer
                self._end_upload(t)
            return []
        if not line:
            return []
        got = self._reading(line, t) if whole else None  # the first line may have lost its beginning
        if got is None:
            return self._other(line, t)
        self._good += 1
        self._lined = t
        values = (got.pressure, got.temperature, got.conductivity)
        if any(value == value for value in values):  # noqa: PLR0124 - not all NaN
            self._last = t
        self._reason = "; ".join(got.refused)
        return self._hold(got) if self._wanted is not None else [got]

    def _reading(self, line: bytes, t: float) -> CtdReading | None:
        if self._wanted is None:
            return live_reading(line, self._variant, t)
        cast = self.casts[self._wanted]
        return sample(line, self._set.oxygen, t, cast.utc + self._came * cast.interval)

    def _hold(self, got: CtdReading) -> list[CtdReading]:
        """Hold so many samples back as may be garbage at the end."""
        self._came += 1
        self._held.append(got)
        keep = FLUSHED[self._set.oxygen] if self._set.drop_flushed else 0
        return [self._held.popleft()] if len(self._held) > keep else []

    def _other(self, line: bytes, t: float) -> list[CtdReading]:
        """Lists and echoes of commands; anything else is refused."""
        text = line.decode("ascii", "replace")
        cast = cast_of(text)
        if cast and len(self.casts) < _MOST_CASTS:
            self.casts[cast.number] = cast
            self._lined = t
        elif not (cast or text.strip() in ("start", "stop", "UH") or text.startswith("UC")):
            self._refused += 1
            return []
        self._good += 1  # an echo is understood, and says nothing about samples
        return []

    def _end_upload(self, t: float) -> None:
        if self._wanted is None:
            return
        cast = self.casts[self._wanted]
        self.uploaded = Upload(cast, self._came, self._came == cast.samples)
        self._wanted, self._told = None, t
        self._held.clear()

    def _state_at(self, t: float) -> tuple[CtdState, str]:
        quiet = self._set.silence
        if not self._sampling and self._wanted is None:
            return CtdState.IDLE, "not told to sample"
        if t - self._last <= quiet:
            return (CtdState.SAMPLING if self._wanted is None else CtdState.UPLOADING), self._reason
        if t - self._lined <= quiet:
            return CtdState.NO_READING, self._reason or "lines come, but no samples"
        if t - self._heard <= quiet:
            return CtdState.GARBLED, f"bytes come, but no line of variant {self._set.variant}: is the baud rate right?"
        if self._heard == float("-inf") and not t - self._told > quiet:
            return CtdState.STARTING, "not heard yet"
        return CtdState.SILENT, f"no byte for more than {quiet:g} s"
