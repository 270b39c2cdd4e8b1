"""One replay: what a vehicle told in the past, told again as if it were now, at a speed that listeners can follow."""

import logging
import time
from collections.abc import Callable
from contextlib import suppress
from threading import Event, Lock, Thread
from typing import Any

from stommel.archive import Archive, ArchiveError
from stommel.errors import one_line
from stommel.station.live.events import Happening, Samples
from stommel.station.live.hub import Hub
from stommel.station.periods import Periods
from stommel.station.replay.course import Course
from stommel.station.replay.moment import Moment
from stommel.station.replay.reading import channel_keys, is_told, last_told, samples_between, texts_between, values_at
from stommel.station.replay.silence import Silences
from stommel.station.settings import VehicleSettings

TICK = 0.1
"""Between two looks [s]."""
MOST_WAITING = 20_000
"""Samples that may wait for the slowest listener; while there are more, the replay stands still."""
TELL_EVERY = 0.5
"""How far it has come is told as often [s]."""
LEAD = 1.0
"""So long before the next sample a silence is left [s]."""
ALONE = 60.0
"""For so long nobody may listen [s]."""
_log = logging.getLogger(__name__)


class Replay:
    """Tells the past of a vehicle to whoever listens to `replay:ID`, in a thread of its own.

    It reads as much as is due and no more than listeners take: a slow listener, or a slow disk, makes it slower, and
    nothing is lost; before anybody listens it does not begin. It touches nothing of the vehicle as it is now.

    Parameters
    ----------
    identity
        Name of the replay.
    user
        Who began it.
    settings
        Of the vehicle whose past it is.
    course
        What is told, and how fast.
    archive
        Where the past is.
    hub
        Hands it on.
    ended
        Called in the replay's thread when it is over.
    alone
        For so long nobody may listen [s].
    """

    def __init__(
        self, identity: str, user: str, settings: VehicleSettings, course: Course, archive: Archive, hub: Hub,
        ended: Callable[["Replay"], None], alone: float = ALONE,
    ) -> None:  # fmt: skip
        self._settings = settings
        self.identity, self.user, self.vehicle = identity, user, settings.vehicle
        self.name = f"replay:{identity}"
        self._course, self._archive, self._hub, self._ended, self._alone = course, archive, hub, ended, alone
        self._reason, self._has_news = "", False
        self._lock = Lock()
        self._ends, self._woken = Event(), Event()
        with archive.reading() as connection:
            self._channels = channel_keys(connection, self.vehicle)
            known = values_at(connection, self.vehicle, self._channels, course.at)
        self._last = last_told(known) or course.begin
        self._silences = Silences(self.vehicle, self._channels, course.end)
        self._moment = Moment(settings, archive, course.at)
        self._summary = self._moment.summary(course.at, known)
        self._periods = Periods()
        hub.open(self.name, lambda: self._course.at, known, lambda key: self._periods.of_key(key))
        self._thread = Thread(target=self._run, name=self.name, daemon=True)

    def start(self) -> None:
        """Begin to tell."""
        self._thread.start()

    def stop(self) -> None:
        """End."""
        self._ends.set()
        self._woken.set()
        if self._thread.ident is not None:
            self._thread.join(5.0)

    def change(
        self, speed: float | None = None, paused: bool | None = None, at: float | None = None,
        skip_silence: bool | None = None,
    ) -> None:  # fmt: skip
        """Go on at another speed, stand still or go on, from another time, or over silences or through them.

        Raises
        ------
        ArchiveError
            What was known at that time cannot be read; the replay goes on as before.
        """
        with self._lock:
            if at is not None:
                self._jump(at)
            self._course.speed = self._course.speed if speed is None else speed
            self._course.paused = self._course.paused if paused is None else paused
            self._course.skip_silence = self._course.skip_silence if skip_silence is None else skip_silence
        self._woken.set()

    def state(self) -> dict[str, Any]:
        """How far it has come, and how the vehicle was."""
        course, silence = self._course, self._silences.now
        return {
            "replay": self.identity, "vehicle": self.vehicle, "user": self.user, "begin": course.begin,
            "end": course.end, "at": course.at, "speed": course.speed, "paused": course.paused or course.is_at_end,
            "ended": self._ends.is_set(), "reason": self._reason, "skip_silence": course.skip_silence,
            "silence": None if silence is None else silence._asdict(), "summary": self._summary,
        }  # fmt: skip

    def _jump(self, at: float) -> None:
        with self._archive.reading() as connection:
            known = values_at(connection, self.vehicle, self._channels, at)
        moment = Moment(self._settings, self._archive, at)
        self._summary, self._moment = moment.summary(at, known), moment
        self._last, self._periods = last_told(known) or at, Periods()
        self._silences.jump()
        self._course.jump(at)
        self._hub.restart(self.name, known)

    def _run(self) -> None:
        try:
            self._go()
        except Exception as error:  # noqa: BLE001 - a defect; whoever listens must know that nothing comes any more
            _log.exception("replay %s", self.identity)
            self._reason = f"the replay has failed: {type(error).__name__}: {one_line(str(error), 200)}"
        self._ends.set()
        self._hub.forget(self.name)
        self._publish_state()
        self._ended(self)

    def _go(self) -> None:
        last = heard = told = time.monotonic()
        while not self._ends.is_set():
            changed = self._woken.wait(TICK)
            self._woken.clear()
            now = time.monotonic()
            is_heard = self._hub.listeners(self.name) > 0
            is_moved = is_heard and self._tell(now - last)
            last = now
            if changed or self._has_news or (is_moved and now - told >= TELL_EVERY):
                told, self._has_news = now, False
                self._publish_state()
            heard = now if is_heard else heard
            if now - heard > self._alone:
                self._ends.set()

    def _tell(self, elapsed: float) -> bool:
        """Tell what is due after a real time [s], if listeners have taken what came before; whether time went on."""
        with self._lock:
            course, begin = self._course, self._course.at
            due = course.due(elapsed)
            if due <= begin or self._hub.waiting(self.name) > MOST_WAITING:
                return False
            try:
                with self._archive.reading() as connection:
                    found, until = samples_between(connection, self.vehicle, self._channels, begin, due)
                    said = texts_between(connection, self.vehicle, begin, until)
                    told = [t for key, t, _ in found if is_told(key)]
                    if not told:
                        self._has_news |= self._silences.mind(connection, self._last, until)
            except ArchiveError as error:
                self._reason = str(error)
                return False
            self._reason, course.at = "", until
            if told:
                self._last = told[-1]
                self._has_news |= self._silences.hear()
            if found:
                self._moment.take(found)
                self._periods.take_samples(found)
                self._hub.publish(Samples(self.name, until, found))
            self._leap()
            self._has_news |= course.is_at_end
            for t, severity, words in said:
                self._hub.publish(Happening("text", self.name, {"t": t, "severity": severity, "words": words}))
            return True

    def _leap(self) -> None:
        """Leave a silence behind, if that is wanted."""
        silence = self._silences.now
        if silence is None or not self._course.skip_silence:
            return
        end = silence.end if silence.is_last else silence.end - LEAD
        if end > self._course.at:
            self._course.at, self._has_news = end, True

    def _publish_state(self) -> None:
        with suppress(ArchiveError):  # it tells how it was a moment ago
            self._summary = self._moment.summary(self._course.at, self._hub.values(self.name))
        self._hub.publish(Happening("replay", self.vehicle, self.state()))
