"""What waits to be sent: by priority, and by how much of each there may be."""

from collections import deque
from collections.abc import Mapping
from enum import IntEnum
from typing import NamedTuple

from stommel.messages.mavlink import FieldValue, message_named


class Priority(IntEnum):
    """What goes first."""

    ABORT = 0
    COMMAND = 1
    """Commands, their outcomes, and what services ask of each other."""
    STATE = 2
    """Position and state."""
    SUMMARY = 3
    """Dive summaries, profiles."""
    DATA = 4
    """Files, and all else that can wait."""


class Outgoing(NamedTuple):
    """A message that waits, packed."""

    name: str
    payload: bytes
    component: int | None = None
    """Who says it; None: the end's own."""


class Outbox:
    """Queues of messages.

    Parameters
    ----------
    most
        Bytes that may wait in each queue. A service that has more to say asks `room` first and comes again; what
        is put in without room drops the oldest of its queue, for state that is old is worth nothing.
    """

    def __init__(self, most: int = 4096) -> None:
        self._most = most
        self._queues: dict[Priority, deque[Outgoing]] = {priority: deque() for priority in Priority}
        self._bytes = dict.fromkeys(Priority, 0)
        self.dropped = 0
        """Messages that were dropped for want of room."""

    def put(
        self, priority: Priority, name: str, values: Mapping[str, FieldValue], component: int | None = None
    ) -> None:
        """Queue a message.

        Raises
        ------
        MessageError
            It cannot be said.
        """
        queue, outgoing = self._queues[priority], Outgoing(name, message_named(name).pack(values), component)
        queue.append(outgoing)
        self._bytes[priority] += len(outgoing.payload)
        while self._bytes[priority] > self._most and len(queue) > 1:
            self._bytes[priority] -= len(queue.popleft().payload)
            self.dropped += 1

    def room(self, priority: Priority) -> int:
        """Bytes of payload that a queue still takes."""
        return max(0, self._most - self._bytes[priority])

    def next(self) -> Outgoing | None:
        """Take the message that goes first; None if none waits."""
        for priority, queue in self._queues.items():
            if queue:
                outgoing = queue.popleft()
                self._bytes[priority] -= len(outgoing.payload)
                return outgoing
        return None

    @property
    def waiting(self) -> int:
        """Bytes of payload that wait."""
        return sum(self._bytes.values())

    def clear(self) -> None:
        """Forget all."""
        for priority, queue in self._queues.items():
            queue.clear()
            self._bytes[priority] = 0
