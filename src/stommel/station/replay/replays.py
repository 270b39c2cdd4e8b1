"""The replays of a station; there is an end to how many."""

import secrets
from collections.abc import Mapping
from threading import Lock
from typing import Any

from stommel.archive import Archive
from stommel.errors import StommelError
from stommel.station.alarms.alert_words import utc
from stommel.station.live.hub import Hub
from stommel.station.replay.course import Course
from stommel.station.replay.reading import channel_keys, last_told, next_after, values_at
from stommel.station.replay.replay import Replay
from stommel.station.vehicles.line import VehicleLine

MOST_REPLAYS = 10


class ReplayError(StommelError):
    """A replay that cannot be."""


class NothingReceivedError(ReplayError):
    """A stretch of time of which there is nothing to tell."""


class Replays:
    """All that go on; may be called from any thread."""

    def __init__(self, archive: Archive, hub: Hub, lines: Mapping[int, VehicleLine]) -> None:
        self._archive, self._hub, self._lines = archive, hub, lines
        self._lock = Lock()
        self._replays: dict[str, Replay] = {}

    def begin(self, user: str, vehicle: int, begin: float, end: float, speed: float) -> Replay:
        """Begin to tell what a vehicle told from a time to another [s since 1970].

        Raises
        ------
        ReplayError
            There are too many, or nothing was received then.
        ArchiveError
            The archive cannot be read.
        """
        self._require_something(vehicle, begin, end)
        identity = secrets.token_hex(8)
        with self._lock:
            if len(self._replays) >= MOST_REPLAYS:
                raise ReplayError(f"{MOST_REPLAYS} replays go on already; end one of them first")
            course = Course(begin, end, speed, begin)
            settings = self._lines[vehicle].settings
            replay = Replay(identity, user, settings, course, self._archive, self._hub, self._forget)
            self._replays[identity] = replay
        replay.start()
        return replay

    def _require_something(self, vehicle: int, begin: float, end: float) -> None:
        """Refuse a stretch of time in which nothing was received."""
        with self._archive.reading() as connection:
            known = channel_keys(connection, vehicle)
            after = next_after(connection, vehicle, known, max(0.0, begin - 1e-6))
            if after is not None and after <= end:
                return
            before = last_told(values_at(connection, vehicle, known, begin))
        around = [
            f"{words} at {utc(t)}" for words, t in (("the last before", before), ("the next", after)) if t is not None
        ]
        told = f": {' and '.join(around)}" if around else " or at any other time"
        raise NothingReceivedError(f"nothing was received of vehicle {vehicle} in this stretch of time{told}")

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
