"""The replays of a station; there is an end to how many."""

import secrets
from threading import Lock
from typing import Any

from stommel.archive import Archive
from stommel.errors import StommelError
from stommel.station.live.hub import Hub
from stommel.station.replay.course import Course
from stommel.station.replay.replay import Replay

MOST_REPLAYS = 10


class ReplayError(StommelError):
    """A replay that cannot be."""


class Replays:
    """All that go on; may be called from any thread."""

    def __init__(self, archive: Archive, hub: Hub) -> None:
        self._archive, self._hub = archive, hub
        self._lock = Lock()
        self._replays: dict[str, Replay] = {}

    def begin(self, user: str, vehicle: int, begin: float, end: float, speed: float) -> Replay:
        """Begin to tell what a vehicle told from a time to another [s since 1970].

        Raises
        ------
        ReplayError
            There are too many.
        ArchiveError
            The archive cannot be read.
        """
        identity = secrets.token_hex(8)
        with self._lock:
            if len(self._replays) >= MOST_REPLAYS:
                raise ReplayError(f"{MOST_REPLAYS} replays go on already; end one of them first")
            course = Course(begin, end, speed, begin)
            replay = Replay(identity, user, vehicle, course, self._archive, self._hub, self._forget)
            self._replays[identity] = replay
        replay.start()
        return replay

    def named(self, identity: str) -> Replay | None:
        """Return the replay of a name."""
        return self._replays.get(identity)

    def states(self) -> list[dict[str, Any]]:
        """How far each has come."""
        with self._lock:
            replays = list(self._replays.values())
        return [replay.state() for replay in replays]

    def stop(self) -> None:
        """End all."""
        with self._lock:
            replays = list(self._replays.values())
        for replay in replays:
            replay.stop()

    def _forget(self, replay: Replay) -> None:
        with self._lock:
            self._replays.pop(replay.identity, None)
