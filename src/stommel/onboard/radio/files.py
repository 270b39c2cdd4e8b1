"""The vehicle's files as the shore sees them: the log, the missions, and an inbox.

Data leave the vehicle only by its own release: a log file whose SHA-256 the shore has told is marked as sent, and is
the first to go when room is needed. The inbox takes what a shore sends; nothing aboard obeys what is in it.
"""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from functools import partial
from typing import NamedTuple, TypeVar

from stommel.link.files.disk import Disk
from stommel.link.files.port import Entry, FileRefusalError, FtpError, Path
from stommel.link.files.received_file import Identity, ReceivedFile, ReceivedFileError
from stommel.messages.log.names import log_name
from stommel.onboard.coordination.logbook.logbook import Logbook

LOG, MISSIONS, INBOX = "log", "missions", "inbox"
MOST_INBOX = 8 << 20
"""Bytes that the inbox holds."""

_PART = ".part"
_PARTS = (_PART, f"{_PART}.ranges", f"{_PART}.ranges.new")
"""Endings of what `ReceivedFile` keeps until the file is whole."""

Pages = Callable[[], Mapping[str, bytes]]
T = TypeVar("T")


class _Read(NamedTuple):
    """A file that is being read, as it was at this size."""

    path: Path
    size: int
    content: bytes


class VehicleFiles:
    """Files that the link may list, read and write.

    Parameters
    ----------
    inbox
        Where received files are kept.
    missions
        The missions' texts by file name.
    logbook
        Of the vehicle; None where none is kept.
    """

    def __init__(self, inbox: Disk, missions: Pages, logbook: Logbook | None = None) -> None:
        self._inbox, self._missions, self._logbook = inbox, missions, logbook
        self._read: _Read | None = None

    # reading

    def entries(self, folder: Path) -> Sequence[Entry]:
        """What stands in a folder."""
        if not folder:
            return [Entry(name, 0, True) for name in (INBOX, LOG, MISSIONS)]
        return [Entry(name, size, False) for name, size in sorted(self._sizes(folder).items())]

    def size(self, path: Path) -> int:
        """Bytes of a file now."""
        sizes = self._sizes(path[:-1]) if len(path) == 2 else {}
        if path[-1:] == () or path[-1] not in sizes:
            raise _not_found(path)
        return sizes[path[-1]]

    def read(self, path: Path, offset: int, length: int) -> bytes:
        """Bytes of a file; fewer at its end."""
        size = self.size(path)
        folder, name = path
        if folder == INBOX:
            return self._of_disk(lambda: self._inbox.read(name, offset, length))
        known = self._read
        if known is None or known.path != path or known.size != size:
            self._read = known = _Read(path, size, self._whole(folder, name))
        return known.content[offset : offset + length]

    def _sizes(self, folder: Path) -> dict[str, int]:
        if folder == (INBOX,):
            return self._of_disk(self._received)
        if folder == (MISSIONS,):
            return {name: len(content) for name, content in self._missions().items()}
        if folder == (LOG,):
            log = self._logbook
            return {} if log is None else {n: s for n, s in self._of_disk(log.storage.sizes).items() if log_name(n)}
        raise FileRefusalError(FtpError.FILE_NOT_FOUND, f"{'/'.join(folder)}: there is no such folder")

    def _received(self) -> dict[str, int]:
        return {name: size for name, size in self._inbox.sizes().items() if not name.endswith(_PARTS)}

    def _parts_of(self, path: Path) -> list[str]:
        """What is kept of a file of the inbox that is not whole."""
        sizes = self._of_disk(self._inbox.sizes) if len(path) == 2 and path[0] == INBOX else {}
        return [part for ending in _PARTS if (part := f"{path[-1]}{ending}") in sizes]

    def _unfinished(self) -> list[str]:
        """Names of files of the inbox of which a part has come."""
        return sorted(name[: -len(_PART)] for name in self._of_disk(self._inbox.sizes) if name.endswith(_PART))

    def _whole(self, folder: str, name: str) -> bytes:
        if folder == MISSIONS:
            return self._missions()[name]
        log = self._logbook
        assert log is not None
        return self._of_disk(lambda: log.storage.read(name))

    # writing, in the inbox alone

    def stage(self, path: Path, *, from_old: bool) -> "StagedFile":
        """Begin to write a file of the inbox."""
        name = self._writable(path)
        old = b""
        if from_old and name in self._of_disk(self._received):
            old = self._of_disk(lambda: self._inbox.read(name, 0, MOST_INBOX))
        return StagedFile(self._inbox, name, old, self._room(name))

    def receive(self, path: Path, size: int, sha256: bytes) -> "InboxPart":
        """Begin to receive a file of the inbox, or go on."""
        name = self._writable(path)
        if size > self._room(name):
            raise self._full(self._room(name), size)
        try:
            return InboxPart(self._inbox, name, Identity("/".join(path), size, sha256.hex()))
        except ReceivedFileError as error:
            raise FileRefusalError(FtpError.FAIL_ERRNO, str(error)) from error

    def release(self, path: Path) -> None:
        """Let a file go that is whole ashore."""
        self.size(path)
        folder, name = path
        if folder == INBOX:
            self._of_disk(lambda: self._inbox.remove(name))
            return
        found = log_name(name) if folder == LOG else None
        if found is None or self._logbook is None:
            raise _protected(path)
        if not found.sent and not self._logbook.mark_sent(found):
            raise FileRefusalError(FtpError.FILE_PROTECTED, f"{'/'.join(path)}: is still being written")

    def remove(self, path: Path) -> None:
        """Remove a file of the inbox, or what has come of one; data are given up only to who has them whole."""
        parts = self._parts_of(path)
        for part in parts:
            self._of_disk(partial(self._inbox.remove, part))
        if parts and path[1] not in self._of_disk(self._received):
            return
        self.size(path)
        name = self._writable(path)
        self._of_disk(lambda: self._inbox.remove(name))

    def rename(self, old: Path, new: Path) -> None:
        """Give a file of the inbox another name."""
        self.size(old)
        before, after = self._writable(old), self._writable(new)
        if after in self._of_disk(self._received):
            raise FileRefusalError(FtpError.FILE_EXISTS, f"{'/'.join(new)}: is there already")
        self._of_disk(lambda: self._inbox.rename(before, after))

    def make_folder(self, path: Path) -> None:
        """Refuse: there are the folders that there are."""
        raise _protected(path)

    def remove_folder(self, path: Path) -> None:
        """Refuse: there are the folders that there are."""
        raise _protected(path)

    def _writable(self, path: Path) -> str:
        if len(path) != 2 or path[0] != INBOX or path[1].endswith((".part", ".ranges", ".new")):
            raise _protected(path)
        return path[1]

    def _room(self, name: str) -> int:
        """Bytes that a file may have: it takes the place of its part, and in the end that of a file of its name."""
        own = (name, *(f"{name}{ending}" for ending in _PARTS))
        sizes = self._of_disk(self._inbox.sizes)
        return max(0, MOST_INBOX - sum(size for other, size in sizes.items() if other not in own))

    def _full(self, room: int, size: int) -> FileRefusalError:
        unfinished = ", ".join(self._unfinished())
        begun = f"; begun there, and not whole: {unfinished}" if unfinished else ""
        return FileRefusalError(FtpError.FAIL_ERRNO, f"{INBOX}: has room for {room} bytes, not {size}{begun}")

    def _of_disk(self, act: Callable[[], T]) -> T:
        try:
            return act()
        except OSError as error:
            raise FileRefusalError(FtpError.FAIL_ERRNO, f"disk: {error.strerror or error}") from error


class StagedFile:
    """A file that an ordinary ground station writes; it comes into being when it is committed."""

    def __init__(self, disk: Disk, name: str, content: bytes, room: int) -> None:
        self._disk, self._name, self._content, self._room = disk, name, bytearray(content), room

    @property
    def size(self) -> int:
        """Bytes so far."""
        return len(self._content)

    def write(self, offset: int, data: bytes) -> None:
        """Put bytes at a place."""
        self._need(offset + len(data))
        if offset > len(self._content):
            self._content.extend(bytes(offset - len(self._content)))
        self._content[offset : offset + len(data)] = data

    def truncate(self, size: int) -> None:
        """Cut, or fill up with zeros."""
        self._need(size)
        del self._content[size:]
        self._content.extend(bytes(size - len(self._content)))

    def _need(self, size: int) -> None:
        if size > self._room:
            raise FileRefusalError(FtpError.FAIL_ERRNO, f"{INBOX}: has room for {self._room} bytes, not {size}")

    def commit(self) -> None:
        """Let it stand under its name."""
        part = f"{self._name}{_PART}"
        try:
            with suppress(FileNotFoundError):
                self._disk.remove(part)
            self._disk.write(part, 0, bytes(self._content))
            self._disk.sync(part)
            self._disk.rename(part, self._name)
        except OSError as error:
            raise FileRefusalError(FtpError.FAIL_ERRNO, f"disk: {error.strerror or error}") from error

    def discard(self) -> None:
        """Forget it."""
        self._content.clear()


class InboxPart(ReceivedFile):
    """A file that is being received; what refuses speaks as the port does."""

    def write(self, offset: int, data: bytes, t: float) -> None:
        """Keep received bytes."""
        try:
            super().write(offset, data, t)
        except ReceivedFileError as error:
            raise FileRefusalError(FtpError.FAIL_ERRNO, str(error)) from error

    def finish(self) -> str:
        """Let the file stand under its name."""
        try:
            return super().finish()
        except ReceivedFileError as error:
            raise FileRefusalError(FtpError.FAIL, str(error)) from error


def _not_found(path: Path) -> FileRefusalError:
    return FileRefusalError(FtpError.FILE_NOT_FOUND, f"{'/'.join(path)}: there is no such file")


def _protected(path: Path) -> FileRefusalError:
    return FileRefusalError(FtpError.FILE_PROTECTED, f"{'/'.join(path)}: only the inbox can be written")
