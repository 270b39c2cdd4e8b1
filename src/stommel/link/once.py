"""Requests that are carried out once, however often they arrive."""

from collections import OrderedDict, deque
from enum import Enum

_MOST_SENDERS = 16
_MOST_SESSIONS = 8
SESSIONS = 1 << 32
"""A sender draws its session below this at its start."""


class Arrival(Enum):
    """What a request is that arrives."""

    NEW = "to be carried out"
    AGAIN = "the newest of its sender: answered again"
    OLD = "older than the newest of its sender: late, and passed over"


class Once:
    """Knows of each sender its session and the newest of its requests.

    A sender numbers its requests upwards from 1 and has one in flight; after its restart it draws another session.
    """

    def __init__(self) -> None:
        self._newest: OrderedDict[tuple[int, int], tuple[int, int]] = OrderedDict()
        self._ended: deque[tuple[tuple[int, int], int]] = deque(maxlen=_MOST_SENDERS * _MOST_SESSIONS)

    def judge(self, sender: tuple[int, int], session: int, number: int) -> Arrival:
        """Say what a request of a sender (system, component) is, and count it as carried out if it is new."""
        known = self._newest.get(sender)
        if known is not None and known[0] == session:
            if number <= known[1]:
                return Arrival.AGAIN if number == known[1] else Arrival.OLD
        elif (sender, session) in self._ended:
            return Arrival.OLD
        elif known is not None:
            self._ended.append((sender, known[0]))
        self._newest[sender] = session, number
        self._newest.move_to_end(sender)
        while len(self._newest) > _MOST_SENDERS:
            self._newest.popitem(last=False)
        return Arrival.NEW
