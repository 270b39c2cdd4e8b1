"""A folder of the computer as the disk of received files: the edge, where bytes meet the operating system."""

import errno
import os
import stat
from contextlib import suppress
from pathlib import Path

from stommel.files.whole import sync_names


class FolderDisk:
    """The regular files of one folder, which is made if it is not there."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._open: dict[str, int] = {}
        folder.mkdir(parents=True, exist_ok=True)

    def sizes(self) -> dict[str, int]:
        """Every file by name, with its size in bytes."""
        with os.scandir(self.folder) as entries:
            return {entry.name: entry.stat().st_size for entry in entries if entry.is_file(follow_symlinks=False)}

    def read(self, name: str, offset: int, length: int) -> bytes:
        """Bytes of a file; fewer at its end."""
        path = self.folder / name
        if not stat.S_ISREG(path.lstat().st_mode):
            raise OSError(errno.EINVAL, "is no regular file", name)  # a pipe would be waited for
        with path.open("rb") as file:
            file.seek(offset)
            return file.read(length)

    def write(self, name: str, offset: int, data: bytes) -> None:
        """Put bytes at a place."""
        descriptor = self._descriptor(name)
        os.lseek(descriptor, offset, os.SEEK_SET)
        left = memoryview(data)
        while left:
            left = left[os.write(descriptor, left) :]

    def sync(self, name: str) -> None:
        """Return when all that was written to a file is on the disk."""
        os.fsync(self._descriptor(name))

    def rename(self, old: str, new: str) -> None:
        """Give a file another name, in place of a file of that name."""
        self._forget(old)
        self._forget(new)
        (self.folder / old).replace(self.folder / new)
        sync_names(self.folder)

    def remove(self, name: str) -> None:
        """Remove a file."""
        self._forget(name)
        (self.folder / name).unlink()
        sync_names(self.folder)

    def close(self) -> None:
        """Hold no file open any more."""
        for name in tuple(self._open):
            self._forget(name)

    def _descriptor(self, name: str) -> int:
        if name not in self._open:
            binary = getattr(os, "O_BINARY", 0)
            no_link = getattr(os, "O_NOFOLLOW", 0)
            flags = os.O_RDWR | os.O_CREAT | binary | no_link
            is_new = not (self.folder / name).exists()
            self._open[name] = os.open(self.folder / name, flags, 0o644)
            if is_new:
                sync_names(self.folder)
        return self._open[name]

    def _forget(self, name: str) -> None:
        descriptor = self._open.pop(name, None)
        if descriptor is not None:
            with suppress(OSError):
                os.close(descriptor)
