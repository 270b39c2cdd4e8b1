"""Time stamps of signed frames: the own counter, and what was heard of each sender.

The counter begins where the disk says that it may, runs with this end's monotonic time, and follows rightly signed
stamps of the other end upwards. So it is never below one that was sent or accepted, whatever the clocks say. On the
disk stands a number ahead of it, moved on in blocks: after a restart at any point the counter begins there.
"""

from math import isfinite
from typing import Any

from stommel.files.storage import Storage
from stommel.link.keeping import DamagedError, keep, kept
from stommel.link.signing.refusals import Refusal

EPOCH = 1_420_070_400
"""2015-01-01, where stamps begin [s of UTC since 1970]."""
PER_SECOND = 100_000
"""Stamps count 10 us."""
LIMIT = 1 << 48
"""Where they end, in 2104."""
_DAY = 86_400 * PER_SECOND
BLOCK = 30 * PER_SECOND
"""How far the disk is ahead of what was sent or heard."""
LAG = 900 * PER_SECOND
"""How far a frame may be behind the counter: clocks ten minutes apart, and some."""
AHEAD = 366 * _DAY
"""How far a frame may be ahead of it: a vehicle that lay in its box for a year, its clock stopped."""
FOLLOWED = 30 * _DAY
"""How far a start follows the wall clock forward; it never follows it back, and never while it runs."""
MOST_STREAMS = 64
"""Senders that are kept."""
NAME = "link-stamps"
_RETRY = PER_SECOND
"""After which a disk that failed is asked again, in stamps."""

Stream = tuple[int, int, int]
"""System, component and link."""


def stamp_of(clock: float) -> int:
    """Stamp of a UTC time [s since 1970]; the nearest one for a time that has none."""
    return int(min(max((clock - EPOCH) * PER_SECOND, 0.0), LIMIT - 1.0)) if isfinite(clock) else 0


class Stamps:
    """What this end may say and hear next.

    Parameters
    ----------
    storage
        Where they are kept.
    least
        No stamp of this key is older.
    clock
        The wall clock at the start [s of UTC since 1970]; it may be wrong.
    fresh
        The key was never used, so that nothing can be missing where nothing is kept.
    """

    def __init__(self, storage: Storage, least: int, clock: float, *, fresh: bool) -> None:
        self._storage = storage
        self.notes: list[str] = []
        """What was found damaged, in words."""
        self.in_doubt = False
        """What was kept is lost: nothing is accepted before one frame has proved to be new."""
        self.written = True
        """Whether the disk took it."""
        self._heard: dict[Stream, int] = {}
        self._floor = 0
        self._reserved = 0
        self._open(fresh)
        begin = max(self._reserved, least)
        self._last = max(begin, min(stamp_of(clock), begin + FOLLOWED))
        self._kept: dict[Stream, int] = dict(self._heard)
        self._began: float | None = None
        self._base = self._last
        self._retry = 0

    def _open(self, fresh: bool) -> None:
        try:
            found = kept(self._storage, NAME)
            if found is not None:
                self._reserved, self._floor, self._heard = _sound(found)
        except (DamagedError, ValueError, KeyError, TypeError, AttributeError) as error:
            self.notes.append(str(error))
            found = None
        self.in_doubt = found is None and not fresh

    def now(self, t: float) -> int:
        """The counter at a time [s]."""
        if self._began is None:
            self._began = t
        return max(self._last, self._base + int((t - self._began) * PER_SECOND))

    def next(self, t: float) -> int:
        """Return a stamp to sign with: above every other that was sent or accepted."""
        stamp = max(self.now(t), self._last + 1)
        self._last = stamp
        if stamp >= self._reserved:
            self._keep(stamp)
        return stamp

    def check(self, stream: Stream, stamp: int, t: float) -> Refusal | None:
        """Why a rightly signed frame is not accepted; None if it is."""
        if self.in_doubt:
            return Refusal.UNPROVED
        if stamp <= max(self._heard.get(stream, 0), self._floor):
            return Refusal.REPLAYED
        now = self.now(t)
        if stamp < now - LAG:
            return Refusal.STALE
        if stamp > now + AHEAD or stamp >= LIMIT - AHEAD:
            return Refusal.FAR_FUTURE
        if stream not in self._heard and len(self._heard) >= MOST_STREAMS and not self._forget_old(now):
            return Refusal.TOO_MANY
        return None

    def accept(self, stream: Stream, stamp: int, t: float) -> None:
        """Take the stamp of a frame whose signature holds and that `check` has let pass."""
        self._follow(stamp, t)
        self._heard[stream] = stamp
        if stamp >= self._kept.get(stream, 0):
            self._keep(self._last)

    def prove(self, stream: Stream, stamp: int, t: float) -> None:
        """Take the stamp of a frame that is new for sure, and end the doubt.

        What was recorded before is at most as far ahead of it as clocks are apart. So nothing is accepted that is not
        ahead of it by more; the other end follows as soon as it hears us.
        """
        self.follow(stamp + LAG, t)
        self._floor = max(self._floor, self._last)
        self._heard[stream] = stamp
        self.in_doubt = False
        self._keep(self._last)

    def follow(self, stamp: int, t: float) -> None:
        """Raise the counter to a stamp, if it is below and the stamp is not at the end of all."""
        if stamp < LIMIT - AHEAD:
            self._follow(stamp, t)

    def offset(self, stamp: int, t: float) -> float:
        """How far a stamp is ahead of the counter [s]."""
        return (stamp - self.now(t)) / PER_SECOND

    def keep_now(self) -> None:
        """Bring it to the disk."""
        self._keep(self._last)

    def _follow(self, stamp: int, t: float) -> None:
        self._base += max(0, stamp - self.now(t))
        self._last = max(self._last, stamp)

    def _forget_old(self, now: int) -> bool:
        """Forget senders that would have to say something newer than the last heard anyway; whether there is room."""
        self._heard = {stream: stamp for stream, stamp in self._heard.items() if stamp >= now - LAG}
        return len(self._heard) < MOST_STREAMS

    def _keep(self, stamp: int) -> None:
        """Move the block on; a disk that fails is asked again later, and the link goes on."""
        if self.in_doubt or (not self.written and stamp < self._retry):
            return
        self._forget_old(stamp)
        ahead = {stream: heard + BLOCK for stream, heard in self._heard.items()}
        told = {"/".join(map(str, stream)): heard for stream, heard in ahead.items()}
        try:
            keep(self._storage, NAME, {"reserved": stamp + BLOCK, "floor": self._floor, "heard": told})
        except OSError:
            self.written, self._retry = False, stamp + _RETRY
            return
        self._reserved, self._kept, self.written = stamp + BLOCK, ahead, True


def _sound(found: dict[str, Any]) -> tuple[int, int, dict[Stream, int]]:
    """What was kept, within its ranges; a ValueError where it is not."""
    heard: dict[Stream, int] = {}
    for name, stamp in found["heard"].items():
        system, component, link = (_within(int(part), 256, name) for part in name.split("/"))
        heard[system, component, link] = _within(stamp, LIMIT + BLOCK, name)
    if len(heard) > MOST_STREAMS:
        raise ValueError(f"{NAME}: more than {MOST_STREAMS} senders")
    limit = LIMIT + BLOCK
    return _within(found["reserved"], limit, "reserved"), _within(found["floor"], limit, "floor"), heard


def _within(value: object, limit: int, name: str) -> int:
    if not isinstance(value, int) or not 0 <= value < limit:
        raise ValueError(f"{NAME}: {name}: must be a whole number from 0 on, below {limit}")
    return value
