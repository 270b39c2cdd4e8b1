"""How long to wait before asking again: follows the round trip as RFC 6298 says."""

LEAST, MOST = 0.2, 60.0
"""Of a time-out [s]."""
FIRST = 3.0
"""Before anything was measured [s]."""
_ALPHA, _BETA, _K = 1 / 8, 1 / 4, 4.0


class RetransmissionTimer:
    """Smoothed round trip and the time-out that follows from it (RFC 6298, section 2).

    Answers to what was asked twice are not measured (Karn): nobody knows which of the two they answer.
    """

    def __init__(self, first: float = FIRST) -> None:
        self.round_trip: float | None = None
        """Smoothed [s]; None before it was measured."""
        self._variation = 0.0
        self._time_out = first

    @property
    def time_out(self) -> float:
        """How long to wait [s]."""
        return min(max(self._time_out, LEAST), MOST)

    def measure(self, round_trip: float) -> None:
        """Take the time between a question and its answer [s]; what is not positive is no measurement."""
        if not 0.0 <= round_trip < float("inf"):
            return
        if self.round_trip is None:
            self.round_trip, self._variation = round_trip, round_trip / 2.0
        else:
            self._variation += _BETA * (abs(self.round_trip - round_trip) - self._variation)
            self.round_trip += _ALPHA * (round_trip - self.round_trip)
        self._time_out = self.round_trip + max(_K * self._variation, 0.1)

    def back_off(self) -> None:
        """Wait twice as long: nothing came."""
        self._time_out = min(2.0 * self.time_out, MOST)
