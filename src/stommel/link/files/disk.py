"""What a received file needs of a disk. Files have plain names; nothing here opens any.

Every method may raise OSError: the disk is full, or broken. What was synced is there after a loss of power; what was
only written may be there whole, in part, or not at all, and may be there without what was written before it.
"""

from typing import Protocol


class Disk(Protocol):
    """A folder of files."""

    def sizes(self) -> dict[str, int]:
        """Every file by name, with its size in bytes."""

    def read(self, name: str, offset: int, length: int) -> bytes:
        """Bytes of a file; fewer at its end. FileNotFoundError if there is none."""

    def write(self, name: str, offset: int, data: bytes) -> None:
        """Put bytes at a place; a file that is not there is made, a hole is filled with zeros."""

    def sync(self, name: str) -> None:
        """Return when all that was written to a file is on the disk."""

    def rename(self, old: str, new: str) -> None:
        """Give a file another name, in place of a file of that name; all or nothing, and on the disk at once."""

    def remove(self, name: str) -> None:
        """Remove a file."""
