"""No more bytes than the line carries, so that what is urgent finds no long queue in a modem before it."""

from stommel.errors import StommelError

AHEAD = 0.25
"""Time of bytes that a modem is given ahead [s]."""


_HEARD = 0.9
"""Part of what comes that is held against what goes; a peer that never stops leaves the rest."""


_FRAME = 280.0
"""Bytes of the longest frame, which must fit."""


class RateError(StommelError):
    """A rate that cannot be."""


class LineRate:
    """A token bucket.

    Parameters
    ----------
    bit_rate
        Of the line; a byte takes ten bits.
    half_duplex
        Whether bytes that come take the time of bytes that go.
    ahead
        What may be sent at once [s].
    """

    def __init__(self, bit_rate: float, *, half_duplex: bool = True, ahead: float = AHEAD) -> None:
        if not 10.0 <= bit_rate <= 1e9:
            raise RateError(f"link.bit_rate = {bit_rate}: must be from 10 to 1e9")
        self.bytes_a_second = bit_rate / 10.0
        self._half_duplex = half_duplex
        self._most = bytes_ahead(bit_rate, ahead)
        self._tokens = self._most
        self._t: float | None = None

    def allowance(self, t: float) -> int:
        """Bytes that may be sent at a time [s]."""
        if self._t is not None and t > self._t:
            self._tokens = min(self._tokens + (t - self._t) * self.bytes_a_second, self._most)
        self._t = t
        return max(0, int(self._tokens))

    def sent(self, count: int) -> None:
        """Take note of bytes that were sent."""
        self._tokens -= count

    def heard(self, count: int) -> None:
        """Take note of bytes that came; they delay ours by no more than what may be sent at once."""
        if self._half_duplex:
            self._tokens = max(self._tokens - _HEARD * count, min(self._tokens, -self._most))


def bytes_ahead(bit_rate: float, ahead: float = AHEAD) -> float:
    """Bytes that a modem is given before they can be sent."""
    return ahead * bit_rate / 10.0 + _FRAME
