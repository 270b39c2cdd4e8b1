"""No more bytes than the line carries, so that what is urgent finds no long queue in a modem before it."""

from stommel.errors import StommelError

AHEAD = 0.25
"""Time of bytes that a modem is given ahead [s]."""


_LEAST = 0.1
"""Part of the line that is taken even while the peer never stops."""


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
    turn_round
        Silence of such a line whenever the other end begins to speak [s].
    ahead
        What may be sent at once [s].
    """

    def __init__(
        self, bit_rate: float, *, half_duplex: bool = True, turn_round: float = 0.01, ahead: float = AHEAD
    ) -> None:
        if not 10.0 <= bit_rate <= 1e9:
            raise RateError(f"link.bit_rate = {bit_rate}: must be from 10 to 1e9")
        if not 0.0 <= turn_round <= 10.0:
            raise RateError(f"link.turn_round = {turn_round}: must be from 0 to 10")
        self.bytes_a_second = bit_rate / 10.0
        self._half_duplex = half_duplex
        self._turns = 2.0 * turn_round * self.bytes_a_second
        self._spoke = False
        self._most = bytes_ahead(bit_rate, ahead)
        self._tokens = self._most
        self._taken = 0.0
        """Bytes that the line could have carried while the peer spoke."""
        self._t: float | None = None

    def allowance(self, t: float) -> int:
        """Bytes that may be sent at a time [s]."""
        if self._t is not None and t > self._t:
            passed = (t - self._t) * self.bytes_a_second
            by_peer = min(self._taken, (1.0 - _LEAST) * passed)
            self._taken -= by_peer
            self._tokens = min(self._tokens + passed - by_peer, self._most)
        self._t = t
        return max(0, int(self._tokens))

    def sent(self, count: int) -> None:
        """Take note of bytes that were sent."""
        self._tokens -= count
        self._spoke = self._spoke or count > 0

    def heard(self, count: int) -> None:
        """Take note of bytes that came; they delay ours."""
        if not self._half_duplex:
            return
        turns = self._turns if self._spoke else 0.0  # there and back
        self._spoke = False
        self._taken = min(self._taken + count + turns, self._most)


def bytes_ahead(bit_rate: float, ahead: float = AHEAD) -> float:
    """Bytes that a modem is given before they can be sent."""
    return ahead * bit_rate / 10.0 + _FRAME
