"""Driver of the satellite receiver: bytes in, fixes out."""

from dataclasses import dataclass, field
from enum import StrEnum

from stommel.instruments.framing import Framer
from stommel.instruments.gnss.fix import Fix, FixLimits, FixRules, NoFix
from stommel.instruments.gnss.nmea import READ, believed, kind_of, parsed
from stommel.instruments.gnss.novatel.codec import Message, from_ascii, from_binary
from stommel.instruments.gnss.positions import NmeaPositions, NovatelPositions
from stommel.instruments.gnss.stream import Kind, Piece, look
from stommel.instruments.health import Health
from stommel.instruments.settings import refuse, require_positive

LOGS: dict[str, tuple[str, ...]] = {
    "novatel_binary": ("TIMEB", "BESTVELB", "BESTPOSB"),
    "novatel_ascii": ("TIMEA", "BESTVELA", "BESTPOSA"),
    "nmea": ("GPRMC", "GPGGA"),
}
"""Logs that the receiver is told to send, by format; the position comes last, when the rest of its second is known.
ZDA, GSA and VTG are read too where a receiver sends them."""


class GnssState(StrEnum):
    """How the receiver does."""

    STARTING = "starting"
    SEARCHING = "searching"
    """It sends, and has no position."""
    FIXED = "fixed"
    REFUSED = "refused"
    """It sends positions that are not believed."""
    SILENT = "silent"
    """No byte comes: under water it has no power."""
    GARBLED = "garbled"
    """Bytes come, but nothing with a right checksum: another baud rate, noise."""
    NO_POSITIONS = "no positions"
    """It sends, but not the logs that it was told to."""


@dataclass(frozen=True)
class GnssSettings:
    """How the receiver is to talk, and what is believed."""

    format: str = "novatel_binary"
    """One of `LOGS`."""
    port: str = "COM1"
    """Of the receiver, at which the vehicle is."""
    interval: float = 1.0
    """Between two positions [s]."""
    limits: FixLimits = field(default_factory=FixLimits)
    earliest: float = 0.0
    """No time of the receiver lies before this, seconds since 1970: one that has lost count of the roll-overs of GPS
    weeks is corrected by 1024 weeks. The day that the software was built is a good choice; 0 corrects nothing."""
    silence: float = 5.0
    """Without a position log before it is configured again [s]."""
    gap: float = 0.2
    """Longest between two bytes of a line [s]."""

    def __post_init__(self) -> None:
        if self.format not in LOGS:
            raise refuse("gnss.format", self.format, LOGS)
        for name in ("interval", "silence", "gap"):
            require_positive(f"gnss.{name}", getattr(self, name))


class GnssDriver:
    """Tells the receiver what to send, and holds its positions against the rules."""

    def __init__(self, settings: GnssSettings | None = None) -> None:
        self._set = settings or GnssSettings()
        self._framer: Framer[Piece] = Framer(look, self._set.gap)
        self._rules = FixRules(self._set.limits)
        self._novatel = NovatelPositions(self._set.earliest)
        self._nmea = NmeaPositions(self._set.earliest)
        self._told = self._heard = self._believed = self._position = self._last = float("-inf")
        self._good = self._refused = 0
        self._outcome: Fix | NoFix | None = None
        self._complaint = ""

    def poll(self, t: float) -> bytes:
        """Bytes to send now: which logs it shall send, while it does not."""
        quiet = self._set.silence
        if t - max(self._told, self._position) <= quiet:
            return b""
        self._told = t
        period, port = self._set.interval, self._set.port
        logs = (f"LOG {port} {name} ONTIME {period:g}\r\n" for name in LOGS[self._set.format])
        return "".join((f"\r\nUNLOGALL {port}\r\n", *logs)).encode("ascii")

    def take(self, data: bytes, t: float, depth: float = 0.0) -> list[Fix | NoFix]:
        """Fixes, and positions that are none, that are complete with these bytes, heard at a depth [m]."""
        if data:
            self._heard = t
        outcomes = []
        for piece, at in self._framer.take(data, t):
            found = self._of(piece, at)
            if found is None:
                continue
            self._position = at
            outcome = self._rules.judge(found, t, depth) if isinstance(found, Fix) else found
            if isinstance(outcome, Fix):
                self._last = at
            self._outcome = outcome
            outcomes.append(outcome)
        return outcomes

    def health(self, t: float) -> Health:
        """Return how the receiver does."""
        state, reason = self._state_at(t)
        return Health("gnss", state, self._last, self._good, self._framer.runs + self._refused, reason)

    def _of(self, piece: Piece, t: float) -> Fix | NoFix | None:
        kind, data = piece
        if kind is Kind.NMEA:
            return self._sentence(data, t)
        if kind is Kind.ANSWER:
            if not data.startswith((b"<OK", b"[")):
                self._complaint = data[1:].decode("ascii").strip()
            return None
        message = from_binary(data) if kind is Kind.BINARY else from_ascii(data)
        if message is None:
            self._refused += 1
            return None
        return self._log(message, t)

    def _log(self, message: Message, t: float) -> Fix | NoFix | None:
        self._good += 1
        self._believed = t
        return self._novatel.take(message, t)

    def _sentence(self, data: bytes, t: float) -> Fix | NoFix | None:
        if not believed(data):
            self._refused += 1
            return None
        self._good += 1
        self._believed = t
        if kind_of(data) not in READ:
            return None
        message = parsed(data)
        if message is None:
            self._good, self._refused = self._good - 1, self._refused + 1
            return None
        return self._nmea.take(message, t)

    def _state_at(self, t: float) -> tuple[GnssState, str]:
        quiet = self._set.silence
        if t - self._position <= quiet:
            if isinstance(self._outcome, Fix):
                return GnssState.FIXED, ""
            assert self._outcome is not None
            searching = self._outcome.reason.value == "no solution"
            return GnssState.SEARCHING if searching else GnssState.REFUSED, self._outcome.detail
        if t - self._believed <= quiet:
            return GnssState.NO_POSITIONS, self._complaint or f"none of {', '.join(LOGS[self._set.format])} comes"
        if t - self._heard <= quiet:
            return GnssState.GARBLED, "bytes come, but nothing with a right checksum: is the baud rate right?"
        if self._heard == float("-inf") and not t - self._told > quiet:
            return GnssState.STARTING, "not heard yet"
        return GnssState.SILENT, f"no byte for more than {quiet:g} s"
