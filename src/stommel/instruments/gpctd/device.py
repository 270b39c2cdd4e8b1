"""A simulated CTD: it samples, keeps what it has sampled, lists its casts and uploads them."""

import math
import time
from typing import NamedTuple

from stommel.instruments.gpctd.live import VARIANTS, live_line
from stommel.instruments.gpctd.stream import PROMPT
from stommel.instruments.gpctd.upload import sample_line

_LONGEST_COMMAND = 100
_MOST_SAMPLES = 200_000
"""That its memory holds; after them it goes on sending live."""
_MOST_AT_ONCE = 16


class CtdTruth(NamedTuple):
    """What it measures; not a number where a sensor is broken."""

    pressure: float
    """Of the sea [dbar]."""
    temperature: float
    """[degC]"""
    conductivity: float
    """[S/m]"""
    utc: float = 0.0
    """By its own clock, seconds since 1970."""
    oxygen: float = math.nan
    """[Hz]"""


class _Stored:
    """A cast in its memory."""

    def __init__(self, utc: float, first: int) -> None:
        self.utc, self.first = utc, first
        self.lines: list[bytes] = []
        self.stop = "stop cmd"

    def text(self, number: int, interval: float) -> str:
        at = time.gmtime(self.utc)
        last = self.first + len(self.lines) - 1
        return (
            f"cast {number:3d} {time.strftime('%d %b %Y %H:%M:%S', at)} samples {self.first} to {last}, "
            f"int = {interval:g}, stop = {self.stop}"
        )


class CtdDevice:
    """The instrument. Its memory outlives a loss of power, its sampling does not."""

    def __init__(self, variant: str = "plain", oxygen: bool = False, interval: float = 1.0) -> None:
        self._variant = VARIANTS[variant]
        self._oxygen = oxygen
        self._interval = interval
        self._casts: list[_Stored] = []
        self._stored = 0
        self.restart()

    def restart(self) -> None:
        """Lose power and come back."""
        self._line = b""
        self._next = math.inf

    def take(self, data: bytes, truth: CtdTruth, t: float) -> bytes:
        """Bytes that it sends after these have come to it."""
        out = b""
        if data:
            *lines, rest = (self._line + data).split(b"\n")
            self._line = rest[-_LONGEST_COMMAND:]
            out = b"".join(self._command(line.decode("ascii", "replace").strip(), truth, t) for line in lines)
        sent = 0
        while t >= self._next - 1e-6 and sent < _MOST_AT_ONCE:
            self._next += self._interval
            sent += 1
            out += self._sample(truth)
        if t >= self._next:
            self._next = t + self._interval
        return out

    def _command(self, line: str, truth: CtdTruth, t: float) -> bytes:
        if line == "start":
            if self._next == math.inf:
                self._casts.append(_Stored(truth.utc, self._stored + 1))
                self._next = t
            return b"start\r\n"
        if line == "stop":
            self._next = math.inf
            return b"stop\r\n" + PROMPT
        if line == "UH":
            casts = (cast.text(n, self._interval) for n, cast in enumerate(self._casts, 1) if cast.lines)
            return "".join(f"{text}\r\n" for text in ("UH", *casts)).encode("ascii") + PROMPT
        if line.startswith("UC") and line[2:].isdecimal() and 0 < int(line[2:]) <= len(self._casts):
            lines = self._casts[int(line[2:]) - 1].lines
            return b"\r\n".join((line.encode("ascii"), *lines, PROMPT))
        return b"?cmd S\r\n" + PROMPT if line else PROMPT if self._next == math.inf else b""

    def _sample(self, truth: CtdTruth) -> bytes:
        oxygen = truth.oxygen if self._oxygen else None
        if self._stored < _MOST_SAMPLES:
            line = sample_line(truth.pressure, truth.temperature, truth.conductivity, oxygen)
            self._casts[-1].lines.append(line)
            self._stored += 1
        values = {"pressure": truth.pressure, "temperature": truth.temperature, "conductivity": truth.conductivity}
        return live_line(self._variant, values | {"oxygen": truth.oxygen}) + b"\r\n"
