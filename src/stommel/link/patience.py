"""How long a request is kept up: while its peer is not heard it waits, and in the end it ends."""

QUIET = 15.0
"""Silence after which a peer counts as not heard [s]."""
UNANSWERED = 180.0
"""How long a peer that is heard may leave a request unanswered [s]."""
WITHIN = 6 * 3600.0
"""Time within which a request ends, if nobody says another [s]."""


class Patience:
    """Of one request.

    A vehicle under water answers nothing and has refused nothing: only time in which it is heard counts as unanswered.

    Parameters
    ----------
    t
        When the request began [s].
    within
        How long it may take at all [s].
    unanswered
        How long the peer may be heard without an answer that helps [s].
    """

    def __init__(self, t: float, within: float = WITHIN, unanswered: float = UNANSWERED) -> None:
        self._within, self._unanswered = within, unanswered
        self._deadline, self._left = t + within, unanswered
        self._heard = self._looked = t

    def heard(self, t: float) -> bool:
        """Note that the peer is heard; whether it was silent for long before."""
        is_back = self.is_quiet(t)
        self._heard = t
        return is_back

    def is_quiet(self, t: float) -> bool:
        """Whether the peer is not heard at a time [s]."""
        return t - self._heard > QUIET

    def helped(self) -> None:
        """Note an answer that helped."""
        self._left = self._unanswered

    def given_up(self, t: float) -> str:
        """Why the request has ended, in words; empty while it goes on."""
        if not self.is_quiet(t):
            self._left -= min(max(t - self._looked, 0.0), QUIET)
        self._looked = t
        if t >= self._deadline:
            return f"not finished within {self._within:g} s"
        if self._left <= 0.0:
            return f"no answer for {self._unanswered:g} s, though the vehicle is heard"
        return ""
