"""A disk in memory: full, broken or without power on demand, with what a loss of power leaves of it."""

import errno
import random
from dataclasses import dataclass, field


class PowerCutError(BaseException):
    """The power is gone: nothing that runs goes on, no handler of errors either."""


@dataclass
class Content:
    """Bytes of a file, and how many of them are synced."""

    data: bytearray = field(default_factory=bytearray)
    synced: int = 0


class Disk:
    """Storage in memory, with faults."""

    def __init__(self, files: dict[str, bytes] | None = None) -> None:
        self.files = {name: Content(bytearray(data), len(data)) for name, data in (files or {}).items()}
        self.room: int | None = None
        """Bytes that still fit."""
        self.bytes_left: int | None = None
        """Bytes until the power goes."""
        self.operations_left: int | None = None
        """Operations until the power goes, in the middle of the last."""
        self.broken = False

    def after_power_cut(self, draw: random.Random, keeps_unsynced: bool) -> "Disk":
        """The disk as it is found: synced bytes whole; of the others all, or a beginning and zeros."""
        found = {}
        for name, content in self.files.items():
            kept = (
                len(content.data)
                if keeps_unsynced
                else draw.choice([content.synced, draw.randint(content.synced, len(content.data))])
            )
            zeros = 0 if keeps_unsynced else draw.choice([0, 0, len(content.data) - kept])
            found[name] = bytes(content.data[:kept]) + bytes(zeros)
        return Disk(found)

    def operate(self) -> bool:
        """Count an operation; whether the power goes within it."""
        if self.broken:
            raise OSError(errno.EIO, "Input/output error")
        if self.operations_left is None:
            return False
        self.operations_left -= 1
        if self.operations_left < 0:
            raise PowerCutError
        return self.operations_left == 0

    def sizes(self) -> dict[str, int]:
        self.operate()
        return {name: len(content.data) for name, content in self.files.items()}

    def read(self, name: str) -> bytes:
        self.operate()
        if name not in self.files:
            raise FileNotFoundError(errno.ENOENT, "No such file or directory")
        return bytes(self.files[name].data)

    def create(self, name: str) -> "DiskFile":
        if name in self.files:
            raise FileExistsError(errno.EEXIST, "File exists")
        if self.operate():
            raise PowerCutError
        if self.room == 0:
            raise OSError(errno.ENOSPC, "No space left on device")
        self.files[name] = Content()
        return DiskFile(self, self.files[name])

    def rename(self, old: str, new: str) -> None:
        if self.operate():
            raise PowerCutError
        self.files[new] = self.files.pop(old)

    def remove(self, name: str) -> None:
        if self.operate():
            raise PowerCutError
        content = self.files.pop(name)
        if self.room is not None:
            self.room += len(content.data)


class DiskFile:
    def __init__(self, disk: Disk, content: Content) -> None:
        self._disk = disk
        self._content = content

    def write(self, data: bytes) -> None:
        disk = self._disk
        cut = disk.operate()
        if cut:
            self._content.data += data[: len(data) // 2]
            raise PowerCutError
        if disk.bytes_left is not None:
            if disk.bytes_left < len(data):
                self._content.data += data[: disk.bytes_left]
                disk.bytes_left = 0
                raise PowerCutError
            disk.bytes_left -= len(data)
        if disk.room is not None and disk.room < len(data):
            self._content.data += data[: disk.room]
            disk.room = 0
            raise OSError(errno.ENOSPC, "No space left on device")
        if disk.room is not None:
            disk.room -= len(data)
        self._content.data += data

    def sync(self) -> None:
        if self._disk.operate():
            raise PowerCutError
        self._content.synced = len(self._content.data)

    def close(self) -> None:
        pass
