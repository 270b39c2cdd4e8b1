"""Whose stamps run with ours: what tells a vehicle that has not heard us yet from somebody who says its words again.

An end that has started without its stamps, or long after the other one, says stamps that are too old until it hears
the other end once. Whoever has the key and was never accepted since this end's start, or has just asked for proof since
it has lost its own stamps, is such an end. What it says is refused like any other old frame; it is counted apart, and
it should hear us soon.
"""

from collections import deque

from stommel.link.signing.refusals import Refusal
from stommel.link.signing.stamps import MOST_STREAMS, Stream

_MOST_QUESTIONS = 64
_OF_TIME = (Refusal.STALE, Refusal.REPLAYED)


class InStep:
    """Senders that hold the key, by whether a frame of theirs was new enough."""

    def __init__(self) -> None:
        self.is_waited_for = False
        """Whether somebody was refused who only has to hear us."""
        self._accepted: dict[Stream, None] = {}
        self._questions: deque[bytes] = deque(maxlen=_MOST_QUESTIONS)

    def accepted(self, stream: Stream) -> None:
        """Note that a frame was new enough."""
        self.is_waited_for = False
        if stream not in self._accepted:
            if len(self._accepted) >= MOST_STREAMS:
                del self._accepted[next(iter(self._accepted))]
            self._accepted[stream] = None

    def asked(self, stream: Stream, question: bytes) -> None:
        """Note that a sender has lost its stamps; a question that was heard before may be a recording."""
        if question not in self._questions:
            self._questions.append(question)
            self._accepted.pop(stream, None)

    def refused(self, stream: Stream, refusal: Refusal) -> Refusal:
        """Why a rightly signed frame is refused that is refused for its stamp: by whether its sender is in step."""
        if refusal is Refusal.UNPROVED:
            self.is_waited_for = True
        if refusal not in _OF_TIME or stream in self._accepted:
            return refusal
        self.is_waited_for = True
        return Refusal.OUT_OF_STEP
