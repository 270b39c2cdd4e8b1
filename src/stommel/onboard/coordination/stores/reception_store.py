"""A mission on its way that outlives a restart: what has come is on the disk, and the same announcement goes on there.

Each file has a number that rises. The newest whose announcement is sound tells what is received; older files of the
same announcement add what they hold. After a restart, and after a write that failed, all goes into a new file, and only
when that is on the disk are the older ones removed. A disk that takes nothing leaves the reception in memory.
"""

import re
from contextlib import suppress

from stommel.files.storage import OpenFile, Storage
from stommel.onboard.coordination.stores.piece_file import PIECE_OVERHEAD, announcement, piece, read_pieces
from stommel.onboard.coordination.stores.reception import MOST_BYTES, Reception, ReceptionError

_NAME = re.compile(r"reception-(\d{6,})\.pieces")
_MOST_FILES = 3
"""The newest that are read: one more than a loss of power leaves."""
_LONGEST = MOST_BYTES * (PIECE_OVERHEAD + 2)
"""Of a file [bytes]: a mission that came byte by byte is shorter."""


class ReceptionStore:
    """Pieces of one mission, kept as they come."""

    def __init__(self, storage: Storage) -> None:
        self._storage = storage
        self._file: OpenFile | None = None
        self._number = 0
        self.reception: Reception | None = None
        """What is being received; None before anything was announced."""
        self.written = True
        """Whether the disk took all of it."""
        with suppress(OSError):
            self._open()

    def _open(self) -> None:
        sizes = self._storage.sizes()
        numbers = sorted((int(found[1]) for name in sizes if (found := _NAME.fullmatch(name))), reverse=True)
        self._number = max(numbers, default=0)
        for number in numbers[:_MOST_FILES]:
            if sizes[_name(number)] <= _LONGEST:
                with suppress(OSError, ReceptionError):
                    self._add(self._storage.read(_name(number)))

    def _add(self, content: bytes) -> None:
        """Take what is sound of a file, if it is of the same announcement as those before it."""
        found = read_pieces(content)
        if found is None:
            return
        if self.reception is None:
            self.reception = Reception(found.size, found.sha256)
        if _announced(self.reception) == (found.size, found.sha256):
            for offset, data in found.pieces:
                self.reception.take(offset, data)

    def announce(self, size: int, sha256: str) -> None:
        """Begin to receive so many bytes; the same announcement again goes on where it was.

        Raises
        ------
        ReceptionError
            No mission can have this size or hash; what was received before goes on.
        """
        if self.reception is None or _announced(self.reception) != (size, sha256):
            self.reception = Reception(size, sha256)
            self._begin()

    def take(self, offset: int, data: bytes) -> None:
        """Take a piece; it is on the disk when this returns, if the disk takes it (`written`).

        Raises
        ------
        ReceptionError
            Nothing was announced, or the piece lies outside of it.
        """
        reception = self.expected()
        new = reception.take(offset, data)
        if not new:
            return
        if self._file is None:
            self._begin()
        else:
            self._wrote(b"".join(piece(reception.size, reception.sha256, *run) for run in new))

    def whole(self) -> bytes:
        """All bytes.

        Raises
        ------
        ReceptionError
            Nothing was announced, some are missing, or the hash is another: then all have to come again.
        """
        reception = self.expected()
        were_there = not reception.missing
        try:
            return reception.whole()
        except ReceptionError:
            if were_there:
                self._begin()
            raise

    def expected(self) -> Reception:
        """What is being received.

        Raises
        ------
        ReceptionError
            Nothing was announced.
        """
        if self.reception is None:
            raise ReceptionError("mission: no new one has been sent to the vehicle; send one first")
        return self.reception

    def discard(self) -> None:
        """Receive nothing any more."""
        self.reception = None
        self._leave()
        self._remove_others(keep=None)
        self.written = True

    def _begin(self) -> None:
        """Write a new file with all that is there, then remove the others."""
        reception = self.expected()
        self._leave()
        size, sha256 = _announced(reception)
        content = announcement(size, sha256) + b"".join(piece(size, sha256, *run) for run in reception.held)
        self._number += 1
        name = _name(self._number)
        with suppress(OSError):
            self._file = self._storage.create(name)
            if self._wrote(content):
                self.written = True
                self._remove_others(keep=name)
            else:
                self._storage.remove(name)

    def _wrote(self, content: bytes) -> bool:
        """Add bytes to the file; whether they are on the disk. Behind bytes that are not, nothing would be read."""
        assert self._file is not None
        try:
            self._file.write(content)
            self._file.sync()
        except OSError:
            self._leave()
            return False
        return True

    def _leave(self) -> None:
        """Write no more into the file."""
        if self._file is not None:
            with suppress(OSError):
                self._file.close()
        self._file, self.written = None, False

    def _remove_others(self, keep: str | None) -> None:
        # what is left over is only untidy, or adds what it holds
        with suppress(OSError):
            for name in self._storage.sizes():
                if name != keep and _NAME.fullmatch(name):
                    self._storage.remove(name)


def _announced(reception: Reception) -> tuple[int, str]:
    return reception.size, reception.sha256


def _name(number: int) -> str:
    return f"reception-{number:06d}.pieces"
