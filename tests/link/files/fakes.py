"""A vehicle's files in memory, and a disk that forgets what was not synced, fills up, or is cut off."""

import errno
import hashlib
from collections.abc import Sequence

from stommel.link.files.port import Entry, FileRefusalError, FtpError, Part, Path
from stommel.link.files.received_file import Identity, ReceivedFile


class MemoryDisk:
    """Keeps bytes; may run full."""

    def __init__(self, room: int | None = None) -> None:
        self.files: dict[str, bytearray] = {}
        self.synced: dict[str, bytes] = {}
        self.room = room
        self.syncs = 0
        self.writes = 0
        self.dies_after: int | None = None

    def _count(self) -> None:
        self.writes += 1
        if self.dies_after is not None and self.writes > self.dies_after:
            raise KeyboardInterrupt

    def sizes(self) -> dict[str, int]:
        return {name: len(data) for name, data in self.files.items()}

    def read(self, name: str, offset: int, length: int) -> bytes:
        if name not in self.files:
            raise FileNotFoundError(errno.ENOENT, "No such file", name)
        return bytes(self.files[name][offset : offset + length])

    def write(self, name: str, offset: int, data: bytes) -> None:
        self._count()
        file = self.files.setdefault(name, bytearray())
        grown = max(0, offset + len(data) - len(file))
        if self.room is not None and sum(map(len, self.files.values())) + grown > self.room:
            raise OSError(errno.ENOSPC, "No space left on device")
        file.extend(bytes(grown))
        file[offset : offset + len(data)] = data

    def sync(self, name: str) -> None:
        self._count()
        self.syncs += 1
        self.synced[name] = bytes(self.files[name])

    def rename(self, old: str, new: str) -> None:
        self._count()
        self.files[new] = self.files.pop(old)
        if old in self.synced:
            self.synced[new] = self.synced.pop(old)

    def remove(self, name: str) -> None:
        self._count()
        if name not in self.files:
            raise FileNotFoundError(errno.ENOENT, "No such file", name)
        del self.files[name]
        self.synced.pop(name, None)

    def power_cut(self) -> None:
        """Only what was synced is left."""
        self.files = {name: bytearray(data) for name, data in self.synced.items()}


class MemoryStaged:
    def __init__(self, files: "MemoryFiles", path: Path, content: bytes) -> None:
        self._files, self._path, self._content = files, path, bytearray(content)

    @property
    def size(self) -> int:
        return len(self._content)

    def write(self, offset: int, data: bytes) -> None:
        if offset + len(data) > 1 << 20:
            raise FileRefusalError(FtpError.FAIL, "too long")
        self._content.extend(bytes(max(0, offset + len(data) - len(self._content))))
        self._content[offset : offset + len(data)] = data

    def truncate(self, size: int) -> None:
        self._content = self._content[:size].ljust(size, b"\0")

    def commit(self) -> None:
        self._files.files[self._path] = bytes(self._content)

    def discard(self) -> None:
        self._files.discarded += 1


class MemoryFiles:
    """`logs` are data of the vehicle, all else may be written."""

    def __init__(self, files: dict[str, bytes] | None = None) -> None:
        self.files: dict[Path, bytes] = {tuple(name.split("/")): data for name, data in (files or {}).items()}
        self.folders: set[Path] = {("logs",), ("missions",)}
        self.disk = MemoryDisk()
        self.discarded = 0
        self.reads: list[tuple[int, int]] = []
        self.refuse_received: str | None = None

    def __getitem__(self, name: str) -> bytes:
        return self.files[tuple(name.split("/"))]

    def _protect(self, path: Path) -> None:
        if path[0] == "logs":
            raise FileRefusalError(FtpError.FILE_PROTECTED, "data of the vehicle: released by SHA-256 only")

    def _content(self, path: Path) -> bytes:
        if path not in self.files:
            raise FileRefusalError(FtpError.FILE_NOT_FOUND, f"{'/'.join(path)}: there is no such file")
        return self.files[path]

    def entries(self, folder: Path) -> Sequence[Entry]:
        if folder and folder not in self.folders:
            raise FileRefusalError(FtpError.FILE_NOT_FOUND, f"{folder}: no such folder")
        here = [Entry(path[-1], len(data), False) for path, data in self.files.items() if path[:-1] == folder]
        below = [Entry(path[-1], 0, True) for path in self.folders if path[:-1] == folder]
        return sorted(here + below)

    def size(self, path: Path) -> int:
        return len(self._content(path))

    def read(self, path: Path, offset: int, length: int) -> bytes:
        self.reads.append((offset, length))
        return self._content(path)[offset : offset + length]

    def stage(self, path: Path, *, from_old: bool) -> MemoryStaged:
        self._protect(path)
        return MemoryStaged(self, path, self._content(path) if from_old else b"")

    def receive(self, path: Path, size: int, sha256: bytes) -> Part:
        self._protect(path)
        return MemoryPart(self, path, Identity("/".join(path), size, sha256.hex()))

    def release(self, path: Path) -> None:
        self._content(path)
        del self.files[path]

    def remove(self, path: Path) -> None:
        self._protect(path)
        self._content(path)
        del self.files[path]

    def rename(self, old: Path, new: Path) -> None:
        self._protect(old)
        self._protect(new)
        if new in self.files:
            raise FileRefusalError(FtpError.FILE_EXISTS, f"{new}: is there")
        self.files[new] = self._content(old)
        del self.files[old]

    def make_folder(self, path: Path) -> None:
        if path in self.folders:
            raise FileRefusalError(FtpError.FILE_EXISTS, f"{path}: is there")
        self.folders.add(path)

    def remove_folder(self, path: Path) -> None:
        if path not in self.folders:
            raise FileRefusalError(FtpError.FILE_NOT_FOUND, f"{path}: no such folder")
        if self.entries(path):
            raise FileRefusalError(FtpError.FAIL, f"{path}: is not empty")
        self.folders.discard(path)


class MemoryPart(ReceivedFile):
    """A part on the vehicle's disk in memory."""

    def __init__(self, files: MemoryFiles, path: Path, identity: Identity) -> None:
        self._files, self._path = files, path
        super().__init__(files.disk, path[-1], identity)

    def finish(self) -> str:
        if self._files.refuse_received is not None:
            raise FileRefusalError(FtpError.FAIL, self._files.refuse_received)
        name = super().finish()
        self._files.files[self._path] = bytes(self._files.disk.files[name])
        return name


def noise(size: int, seed: int = 0) -> bytes:
    """Bytes without a pattern, always the same; some of them zero."""
    blocks = (hashlib.sha256(f"{seed} {k}".encode()).digest() for k in range(size // 32 + 1))
    return b"".join(blocks)[:size]
