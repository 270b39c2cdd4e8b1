"""Proof that the other end is there now: what an end asks that has lost its stamps, or hears old ones.

Whoever hears the question follows its stamp, so that what it says next is new enough; and who has lost its own stamps
knows by the answer that it is no recording. A question gives nothing away, and makes nothing old acceptable.
"""

from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Received
from stommel.link.signing.guard import Guard

ASKS_EVERY = 5.0
"""While the own stamps are lost [s]."""
SOONEST = 1.0
"""Between two questions, and between two answers, at the least [s]."""


class Challenge:
    """At either end: asks for proof while in doubt, and who is out of step as soon as it is heard; answers who asks."""

    def __init__(self, guard: Guard) -> None:
        self._guard = guard
        self._asked = self._answered = float("-inf")

    def take(self, received: Received, t: float) -> None:
        """The guard has taken it."""

    def poll(self, t: float, outbox: Outbox) -> None:
        """Ask and answer, now and then."""
        guard = self._guard
        every = SOONEST if guard.in_step.is_waited_for else ASKS_EVERY
        if (guard.in_step.is_waited_for or guard.in_doubt) and t >= self._asked + every:
            outbox.put(Priority.COMMAND, "KEY_CHALLENGE", {"nonce": guard.question})
            guard.in_step.is_waited_for, self._asked = False, t
        if guard.asked is not None and t >= self._answered + SOONEST:
            outbox.put(Priority.COMMAND, "KEY_CHALLENGE_ANSWER", {"nonce": guard.asked})
            guard.asked, self._answered = None, t
