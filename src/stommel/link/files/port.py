"""What the services of files need of the vehicle: files with paths, and where received ones come into being.

A path is a tuple of plain names, from the root (`stommel.link.files.paths`). Every method may raise FileRefusalError.
"""

from collections.abc import Sequence
from enum import IntEnum
from typing import NamedTuple, Protocol

from stommel.errors import StommelError
from stommel.link.files.ranges import Ranges

Path = tuple[str, ...]


class FileResult(IntEnum):
    """What became of a request about a file; FILE_RESULT of `glider.xml`."""

    OK = 0
    NOT_FOUND = 1
    REFUSED = 2
    CHANGED = 3
    NO_ROOM = 4
    UNKNOWN = 5
    FAILED = 6

    @classmethod
    def _missing_(cls, _value: object) -> "FileResult":
        """A result that a newer dialect may have."""
        return cls.FAILED


class FtpError(IntEnum):
    """Error codes of MAVLink FTP."""

    NONE = 0
    FAIL = 1
    FAIL_ERRNO = 2
    INVALID_DATA_SIZE = 3
    INVALID_SESSION = 4
    NO_SESSIONS_AVAILABLE = 5
    END_OF_FILE = 6
    UNKNOWN_COMMAND = 7
    FILE_EXISTS = 8
    FILE_PROTECTED = 9
    FILE_NOT_FOUND = 10


_RESULTS = {
    FtpError.FILE_NOT_FOUND: FileResult.NOT_FOUND,
    FtpError.END_OF_FILE: FileResult.CHANGED,
    FtpError.NO_SESSIONS_AVAILABLE: FileResult.NO_ROOM,
    FtpError.FAIL_ERRNO: FileResult.FAILED,
}


class FileRefusalError(StommelError):
    """A file is not given, not taken or not changed; nothing has happened."""

    def __init__(self, code: FtpError, reason: str) -> None:
        super().__init__(reason)
        self.code = code
        self.result = _RESULTS.get(code, FileResult.REFUSED)


class Entry(NamedTuple):
    """What stands in a folder."""

    name: str
    size: int
    """In bytes; 0 of a folder."""
    is_folder: bool


class Staged(Protocol):
    """A file that an ordinary ground station is writing; it stands nowhere before it is committed."""

    @property
    def size(self) -> int:
        """Bytes so far."""

    def write(self, offset: int, data: bytes) -> None:
        """Put bytes at a place."""

    def truncate(self, size: int) -> None:
        """Cut, or fill up with zeros."""

    def commit(self) -> None:
        """Let it stand under its name: whole, or not at all."""

    def discard(self) -> None:
        """Forget it."""


class Part(Protocol):
    """A file that is being received; outlives restarts."""

    @property
    def missing(self) -> Ranges:
        """What is not there yet."""

    def write(self, offset: int, data: bytes, t: float) -> None:
        """Keep received bytes."""

    def rest(self, t: float) -> None:
        """Is called often: time to bring to the disk what was kept lately."""

    def finish(self) -> object:
        """Let the file stand under its name, after its SHA-256 was found right.

        Raises
        ------
        FileRefusalError
            It is not the file that was announced, or is not taken; the reason says why.
        """

    def close(self) -> None:
        """Bring everything to the disk, and stop here; a later one goes on."""


class FilePort(Protocol):
    """The files of a vehicle."""

    def entries(self, folder: Path) -> Sequence[Entry]:
        """What stands in a folder, always in the same order."""

    def size(self, path: Path) -> int:
        """Bytes of a file now."""

    def read(self, path: Path, offset: int, length: int) -> bytes:
        """Bytes of a file; fewer at its end."""

    def stage(self, path: Path, *, from_old: bool) -> Staged:
        """Begin to write a file: empty, or from what stands there."""

    def receive(self, path: Path, size: int, sha256: bytes) -> Part:
        """Begin to receive a file, or go on."""

    def release(self, path: Path) -> None:
        """Delete a file that is whole ashore; its SHA-256 was compared before."""

    def remove(self, path: Path) -> None:
        """Delete a file for a ground station that has proved nothing: data of the vehicle are refused."""

    def rename(self, old: Path, new: Path) -> None:
        """Give a file another name."""

    def make_folder(self, path: Path) -> None:
        """Make a folder."""

    def remove_folder(self, path: Path) -> None:
        """Remove an empty folder."""
