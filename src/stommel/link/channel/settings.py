"""What a simulated radio channel does to the bytes that go through it."""

import math
from dataclasses import dataclass

from stommel.errors import StommelError

BITS_A_BYTE = 10
"""Of a serial line with one start and one stop bit."""
_SHARES = ("loss", "fade_loss", "bit_error_rate", "duplication", "reordering")
_TIMES = ("latency", "jitter", "turn_round", "longest_turn", "fade_length", "reordering_delay")
_LONGEST = 3600.0


class ChannelError(StommelError):
    """A channel that cannot be."""


@dataclass(frozen=True)
class ChannelSettings:
    """A channel; as it stands, the vehicle's radio on a calm day."""

    bit_rate: float = 115_200.0
    """Bits per second, start and stop bits among them: a byte takes ten."""
    latency: float = 0.05
    """One way, from the end of a packet to its arrival [s]."""
    jitter: float = 0.0
    """Up to so much more [s], evenly distributed; packets do not overtake each other by it."""
    half_duplex: bool = True
    """Whether only one end speaks at a time."""
    turn_round: float = 0.01
    """Silence before the other end speaks [s]."""
    longest_turn: float = 0.1
    """How long one end goes on while the other one waits [s]."""
    packet: int = 172
    """Bytes that the radio sends and loses together at most; 172 is the greatest of a FreeWave hop."""
    whole_frames: bool = False
    """Whether a packet is one MAVLink frame instead, so that `loss` is the loss of frames."""
    loss: float = 0.0
    """Share of packets that are lost, each by itself."""
    fade_every: float = math.inf
    """Mean time between fades [s]; Gilbert and Elliott's two states, in time: waves do not wait for packets."""
    fade_length: float = 0.0
    """Mean duration of a fade [s]; both are distributed exponentially."""
    fade_loss: float = 1.0
    """Share of packets that are lost in a fade."""
    bit_error_rate: float = 0.0
    """Share of bits that arrive flipped."""
    duplication: float = 0.0
    """Share of packets that arrive twice."""
    reordering: float = 0.0
    """Share of packets that are overtaken by later ones."""
    reordering_delay: float = 0.2
    """By how much those are late [s], and the second copy of a packet that arrives twice."""
    outages: tuple[tuple[float, float], ...] = ()
    """From when until when nothing passes [s]: the vehicle is under water."""
    buffer: int = 8192
    """Bytes that the modem of each end holds; more are refused."""
    tethered: bool = False
    """Whether a cable holds the vehicle's antenna above the water, so that radios hear each other during dives too."""

    def __post_init__(self) -> None:
        for name in _SHARES:
            _require(name, getattr(self, name), 0.0, 1.0)
        for name in _TIMES:
            _require(name, getattr(self, name), 0.0, _LONGEST)
        _require("bit_rate", self.bit_rate, 10.0, 1e9)
        _require("packet", self.packet, 1, 65_536)
        _require("buffer", self.buffer, 300, 2**24)
        if not self.fade_every > 0.0:
            raise ChannelError(f"channel.fade_every = {self.fade_every}: must be above 0")
        for begin, end in self.outages:
            if not begin < end:
                raise ChannelError(f"channel.outages: from {begin} to {end}: must end after it begins")

    @property
    def bytes_a_second(self) -> float:
        """What the line carries."""
        return self.bit_rate / BITS_A_BYTE


def _require(name: str, value: float, low: float, high: float) -> None:
    if not low <= value <= high:
        raise ChannelError(f"channel.{name} = {value}: must be from {low:g} to {high:g}")
