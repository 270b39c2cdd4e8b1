"""A disk that refuses for a while: at one of the steps of a write, with one of the reasons that disks have."""

import errno
import os

from tests.onboard.coordination.disk import Disk, DiskFile

PLACES = ("create", "write", "sync", "rename")
REASONS = (errno.ENOSPC, errno.EIO, errno.EROFS)
CASES = [(place, reason) for place in PLACES for reason in REASONS]
NAMES = [f"{place} {errno.errorcode[reason]}" for place, reason in CASES]


class FailingDisk(Disk):
    """Fails where `fault` says, and is well where it is None."""

    fault: tuple[str, int] | None = None
    refused = 0

    def meet(self, place: str) -> None:
        if self.fault is not None and self.fault[0] == place:
            self.refused += 1
            raise OSError(self.fault[1], os.strerror(self.fault[1]))

    def create(self, name: str) -> DiskFile:
        self.meet("create")
        super().create(name)
        return _File(self, self.files[name])

    def rename(self, old: str, new: str) -> None:
        self.meet("rename")
        super().rename(old, new)

    def found(self) -> Disk:
        """The disk as it is after a loss of power."""
        return Disk({name: bytes(content.data[: content.synced]) for name, content in self.files.items()})


class _File(DiskFile):
    def write(self, data: bytes) -> None:
        assert isinstance(self._disk, FailingDisk)
        if self._disk.fault is not None and self._disk.fault[0] == "write":
            self._content.data += data[: len(data) // 2]
        self._disk.meet("write")
        super().write(data)

    def sync(self) -> None:
        assert isinstance(self._disk, FailingDisk)
        self._disk.meet("sync")
        super().sync()
