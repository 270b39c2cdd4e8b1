"""Proof that the other end is there now: what an end asks that has lost its stamps."""

from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Received
from stommel.link.signing.guard import Guard

ASKS_EVERY, ANSWERS_EVERY = 5.0, 1.0
"""At most so often [s]."""


class Challenge:
    """At either end: asks for proof while in doubt, and answers who asks."""

    def __init__(self, guard: Guard) -> None:
        self._guard = guard
        self._ask_at = self._answer_at = float("-inf")

    def take(self, received: Received, t: float) -> None:
        """The guard has taken it."""

    def poll(self, t: float, outbox: Outbox) -> None:
        """Ask and answer, now and then."""
        if self._guard.in_doubt and t >= self._ask_at:
            outbox.put(Priority.COMMAND, "KEY_CHALLENGE", {"nonce": self._guard.question})
            self._ask_at = t + ASKS_EVERY
        if self._guard.asked is not None and t >= self._answer_at:
            outbox.put(Priority.COMMAND, "KEY_CHALLENGE_ANSWER", {"nonce": self._guard.asked})
            self._guard.asked, self._answer_at = None, t + ANSWERS_EVERY
