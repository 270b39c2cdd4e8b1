"""The bytes that wait in an end's modem, and how they are cut for the air."""

from stommel.link.frames import CHECKSUM, HEAD, MARK, SIGNATURE, SIGNED

_PATIENCE = 0.1
"""How long the rest of a frame is waited for [s]."""


class Modem:
    """A bounded queue of bytes."""

    def __init__(self, room: int, packet: int, *, whole_frames: bool) -> None:
        self._most, self._packet, self._whole_frames = room, packet, whole_frames
        self._bytes = bytearray()
        self._first = self._last = 0.0

    @property
    def waiting(self) -> int:
        """Bytes that wait."""
        return len(self._bytes)

    @property
    def room(self) -> int:
        """Bytes that find room."""
        return self._most - len(self._bytes)

    def put(self, data: bytes, t: float) -> int:
        """Take in what there is room for at a time [s], and return how much that was."""
        taken = data[: self.room]
        if taken and not self._bytes:
            self._first = t
        self._bytes += taken
        self._last = t if taken else self._last
        return len(taken)

    def ready(self) -> float | None:
        """Since or from when a packet can be sent [s]; None if nothing waits."""
        if not self._bytes:
            return None
        whole = not self._whole_frames or self._size() <= len(self._bytes)
        return self._first if whole else self._last + _PATIENCE

    def cut(self) -> bytes:
        """Take out the next packet."""
        packet = bytes(self._bytes[: self._size() if self._whole_frames else self._packet])
        del self._bytes[: len(packet)]
        return packet

    def _size(self) -> int:
        """Size of the frame that comes next, or of the bytes before it."""
        waiting = self._bytes
        if waiting[0] != MARK:
            found = waiting.find(MARK)
            return min(found if found > 0 else len(waiting), self._packet)
        if len(waiting) < HEAD:
            return HEAD + CHECKSUM
        return HEAD + waiting[1] + CHECKSUM + (SIGNATURE if waiting[2] & SIGNED else 0)
