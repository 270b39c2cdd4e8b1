"""Frames out of a stream of bytes that may begin anywhere and hold anything."""

from collections.abc import Callable
from typing import Generic, NamedTuple, TypeVar

F = TypeVar("F")

Look = Callable[[bytes, int], tuple[F | None, int] | None]
"""What stands at a place of the bytes: a frame and where it ends; no frame and where to look next; None where it may
be a frame of which the rest is still to come. It reads each byte a bounded number of times and asks for the rest of a
bounded number of bytes only, so that a stream takes linear time and bounded memory."""


class Heard(NamedTuple, Generic[F]):
    """A frame and when its last byte came."""

    frame: F
    t: float
    """[s]"""


class Framer(Generic[F]):
    """Cuts a stream into frames. After garbage it slides until a frame fits again: no good frame is lost with it.

    Garbage may look like the beginning of a long frame. Frames come in one piece, hence after a silence of more than
    `gap` what was begun before it either is complete now or never was a frame.
    """

    def __init__(self, look: Look[F], gap: float) -> None:
        self._look = look
        self._gap = gap
        self._kept = b""
        self._t = float("-inf")
        self._in_garbage = False
        self.skipped = 0
        """Bytes that belong to no frame."""
        self.runs = 0
        """Times that such bytes began: broken frames, noise."""

    @property
    def waiting(self) -> int:
        """Bytes of a frame that is still to be completed."""
        return len(self._kept)

    def take(self, data: bytes, t: float) -> list[Heard[F]]:
        """Frames that are complete with these bytes; without any, those that a silence has set free."""
        kept, look = self._kept, self._look
        quiet = bool(kept) and t - self._t > self._gap
        if not data and not quiet:
            return []
        buffer, old, before = (kept + data if kept else data), len(kept), self._t
        if data:
            self._t = t
        found: list[Heard[F]] = []
        at, size = 0, len(buffer)
        while at < size:
            seen = look(buffer, at)
            if seen is None:
                if not (quiet and at < old):
                    break
                seen = (None, at + 1)
            frame, end = seen
            if frame is None:
                self.skip(end - at)
            else:
                self._in_garbage = False
                found.append(Heard(frame, before if end <= old else t))
            at = end
        self._kept = buffer[at:]
        return found

    def skip(self, count: int) -> None:
        """Count bytes as garbage, also those of a frame that the caller refuses."""
        self.skipped += count
        self.runs += not self._in_garbage
        self._in_garbage = True
