"""Stretches in which nothing was received, as a replay comes upon them."""

from typing import NamedTuple

from sqlalchemy import Connection

from stommel.station.replay.reading import next_after

NOTED_AFTER = 10.0
"""So long nothing comes before it is looked how long that will last [s]."""
LEAST = 60.0
"""Shorter ones are not worth a word [s]."""


class Silence(NamedTuple):
    """A stretch of the past in which nothing was received [s since 1970]."""

    begin: float
    end: float
    """When something was received again; the end of the replay, if nothing was."""
    is_last: bool
    """Whether nothing more was received before the end of the replay."""


class Silences:
    """Looks ahead where nothing comes, once for each stretch."""

    def __init__(self, vehicle: int, known: dict[int, str], end: float) -> None:
        self._vehicle, self._known, self._end = vehicle, known, end
        self.now: Silence | None = None
        """In which the replay is."""
        self._next = 0.0

    def jump(self) -> None:
        """Forget what was seen: the replay goes on elsewhere."""
        self.now, self._next = None, 0.0

    def hear(self) -> bool:
        """Take note that something came; whether a silence has ended."""
        was, self.now, self._next = self.now, None, 0.0
        return was is not None

    def mind(self, connection: Connection, last: float, at: float) -> bool:
        """Take note that nothing came from `last` to `at`; whether a silence has begun."""
        if self.now is not None or at - last < NOTED_AFTER or at < self._next:
            return False
        found = next_after(connection, self._vehicle, self._known, at)
        self._next = self._end if found is None else found
        end = min(self._next, self._end)
        if end - last < LEAST:
            return False
        self.now = Silence(last, end, self._next >= self._end)
        return True
