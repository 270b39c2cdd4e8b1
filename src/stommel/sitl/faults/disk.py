"""The disk of the simulated coordinator: in memory, full on demand, with what a loss of power leaves of it."""

import errno
from dataclasses import dataclass, field

import numpy as np


@dataclass
class Content:
    """Bytes of a file."""

    data: bytearray = field(default_factory=bytearray)
    synced: int = 0
    """How many of them are on the disk whatever happens."""


class MemoryDisk:
    """A folder of files in memory, as logbook and stores want it."""

    def __init__(self) -> None:
        self.files: dict[str, Content] = {}
        self.removed: list[tuple[str, Content]] = []
        """Files that were removed, with their names."""
        self.full = False
        """Whether it takes nothing."""

    def lose_power(self, draw: np.random.Generator) -> None:
        """Cut what was not synced, somewhere."""
        for content in self.files.values():
            kept = int(draw.integers(content.synced, len(content.data), endpoint=True))
            del content.data[kept:]

    def sizes(self) -> dict[str, int]:
        """Every file by name, with its size in bytes."""
        return {name: len(content.data) for name, content in self.files.items()}

    def read(self, name: str) -> bytes:
        """Content of a file."""
        if name not in self.files:
            raise FileNotFoundError(errno.ENOENT, "No such file or directory", name)
        return bytes(self.files[name].data)

    def create(self, name: str) -> "MemoryFile":
        """Begin a new file."""
        if name in self.files:
            raise FileExistsError(errno.EEXIST, "File exists", name)
        self.refuse_if_full()
        content = self.files[name] = Content()
        return MemoryFile(self, content)

    def rename(self, old: str, new: str) -> None:
        """Give a file another name."""
        self.files[new] = self.files.pop(old)

    def remove(self, name: str) -> None:
        """Remove a file."""
        self.removed.append((name, self.files.pop(name)))

    def refuse_if_full(self) -> None:
        """Raise what a full disk says."""
        if self.full:
            raise OSError(errno.ENOSPC, "No space left on device")


class MemoryFile:
    """A file that is being written."""

    def __init__(self, disk: MemoryDisk, content: Content) -> None:
        self._disk, self._content = disk, content

    def write(self, data: bytes) -> None:
        """Add bytes at the end."""
        self._disk.refuse_if_full()
        self._content.data += data

    def sync(self) -> None:
        """Bring all to the disk."""
        self._disk.refuse_if_full()
        self._content.synced = len(self._content.data)

    def close(self) -> None:
        """Write no more."""
