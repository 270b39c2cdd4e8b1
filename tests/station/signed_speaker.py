"""A vehicle with a key that speaks to a station over TCP: the speaker of other tests, behind a guard of its own."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from math import inf
from pathlib import Path

from stommel.link.signing.key_file import KeyFile
from stommel.link.signing.keys import Keys
from stommel.messages.mavlink import message_named
from tests.link.signing.ends import VEHICLE, End, KeyDisk
from tests.onboard.coordination.disk import Disk
from tests.station.speaker import WITHIN, Speaker

DAY = 86_400.0


class SignedVehicle:
    """Says its state and its clock once a second of its world, and answers as a guard does.

    Parameters
    ----------
    speaker
        Its line.
    keys
        What its key file says.
    clock
        What its clock shows at the start [s of UTC since 1970].
    speed
        Of its world, times real time.
    """

    def __init__(self, speaker: Speaker, keys: Keys, clock: float, speed: float = 1.0) -> None:
        self._speaker, self._clock, self._speed = speaker, clock, speed
        self.end = End(VEHICLE, KeyDisk(keys), Disk(), clock)
        self._began, self._said = time.monotonic(), -inf
        self._heard = 0

    @property
    def now(self) -> float:
        """Time since its start, in its world [s]."""
        return self._speed * (time.monotonic() - self._began)

    def live(self) -> None:
        """Hear what came, and say what is due."""
        frames = self._speaker.listen()
        for frame in frames[self._heard :]:
            self.end.hear(frame.raw, self.now)
        self._heard = len(frames)
        if (time.monotonic() - self._said) * self._speed >= 1.0:
            self._said = time.monotonic()
            boot = int(1e3 * self.now)
            told = {"time_unix_usec": int(1e6 * (self._clock + self.now)), "time_boot_ms": boot}
            said = [*self.end.poll(self.now), self._frame("SYSTEM_TIME", told)]
            self._speaker.send(b"".join(said))

    def _frame(self, name: str, values: dict[str, object]) -> bytes:
        return self.end.say(self.now, name, message_named(name).pack(values))  # type: ignore[arg-type]

    def until(self, done: Callable[[], object], within: float = WITHIN) -> None:
        """Live until something is so."""
        ends = time.monotonic() + within
        while not done():
            assert time.monotonic() < ends, "waited in vain"
            self.live()
            time.sleep(0.01)


@contextmanager
def signed_vehicle(speaker: Speaker, key: Path, clock: float, speed: float = 1.0) -> Iterator[SignedVehicle]:
    """A vehicle that has a copy of a key file, once the station has connected."""
    speaker.connect()
    yield SignedVehicle(speaker, KeyFile(key).read(), clock, speed)
