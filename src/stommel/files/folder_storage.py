"""A folder of the disk as storage: where the bytes of logbook and stores meet the operating system."""

import errno
import os
import stat
from contextlib import suppress
from pathlib import Path

from stommel.files.whole import sync_names


class FolderFile:
    """A file that is being written."""

    def __init__(self, path: Path) -> None:
        self._descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o644)

    def write(self, data: bytes) -> None:
        """Add bytes at the end."""
        left = memoryview(data)
        while left:
            left = left[os.write(self._descriptor, left) :]

    def sync(self) -> None:
        """Return when all that was written is on the disk."""
        os.fsync(self._descriptor)

    def close(self) -> None:
        """Write no more."""
        os.close(self._descriptor)


class FolderStorage:
    """The regular files of one folder, which is made if it is not there."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        folder.mkdir(parents=True, exist_ok=True)

    def sizes(self) -> dict[str, int]:
        """Every file by name, with its size in bytes."""
        with os.scandir(self._folder) as entries:
            return {entry.name: entry.stat().st_size for entry in entries if entry.is_file(follow_symlinks=False)}

    def read(self, name: str) -> bytes:
        """Content of a file."""
        path = self._folder / name
        if not stat.S_ISREG(path.stat().st_mode):
            raise OSError(errno.EINVAL, "is no regular file", name)  # a pipe would be waited for
        return path.read_bytes()

    def create(self, name: str) -> FolderFile:
        """Begin a new file; one that is there already is an OSError."""
        file = FolderFile(self._folder / name)
        try:
            self._sync_names()
        except OSError:
            file.close()
            with suppress(OSError):
                (self._folder / name).unlink()
            raise
        return file

    def rename(self, old: str, new: str) -> None:
        """Give a file another name, in place of a file of that name."""
        (self._folder / old).replace(self._folder / new)
        self._sync_names()

    def remove(self, name: str) -> None:
        """Remove a file."""
        (self._folder / name).unlink()
        self._sync_names()

    def _sync_names(self) -> None:
        """Bring the folder's names to the disk."""
        sync_names(self._folder)
