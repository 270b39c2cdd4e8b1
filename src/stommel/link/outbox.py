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


_SHARE = 1 / 8
"""Of the bytes, that each queue gets which waits behind others."""
_FRAME, _OVERHEAD = 280.0, 25.0
"""Bytes of the longest frame, and of what is about a payload."""


class Outgoing(NamedTuple):
    """A message that waits, packed."""

    name: str
    payload: bytes
    component: int | None = None
    """Who says it; None: the end's own."""


class Outbox:
    """Queues of messages.

    The most urgent goes first, but not for ever: of what goes, an eighth is set aside for each queue that waits behind,
    so that a flood of one kind ends none below it. Nothing goes before an abort.

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
        self._set_aside = dict.fromkeys(Priority, 0.0)
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
        waiting = [priority for priority, queue in self._queues.items() if queue]
        if not waiting:
            return None
        chosen = waiting[0]
        if chosen is not Priority.ABORT:
            chosen = next((behind for behind in waiting[1:] if self._is_due(behind)), chosen)
        outgoing = self._queues[chosen].popleft()
        size = len(outgoing.payload)
        self._bytes[chosen] -= size
        self._set_aside[chosen] = max(0.0, self._set_aside[chosen] - size - _OVERHEAD)
        for behind in waiting:
            if behind > chosen:
                self._set_aside[behind] = min(_FRAME, self._set_aside[behind] + _SHARE * (size + _OVERHEAD))
        return outgoing

    def _is_due(self, priority: Priority) -> bool:
        """Whether enough was set aside for the message that waits longest."""
        return self._set_aside[priority] >= len(self._queues[priority][0].payload) + _OVERHEAD

    @property
    def waiting(self) -> int:
        """Bytes of payload that wait."""
        return sum(self._bytes.values())
