"""What stores and logs need of a disk. Files have plain names; nothing here opens any.

Every method may raise OSError: the disk is full, or broken. What was synced is still there after a loss of power; what
was only written may be there whole, in part, or not at all.
"""

from typing import Protocol


class OpenFile(Protocol):
    """A file that is being written, from its beginning on."""

    def write(self, data: bytes) -> None:
        """Add bytes at the end."""

    def sync(self) -> None:
        """Return when all that was written is on the disk."""

    def close(self) -> None:
        """Write no more; does not sync."""


class Storage(Protocol):
    """A folder of files."""

    def sizes(self) -> dict[str, int]:
        """Every file by name, with its size in bytes."""

    def read(self, name: str) -> bytes:
        """Content of a file."""

    def create(self, name: str) -> OpenFile:
        """Begin a new file; one that is there already is an OSError. Its name is on the disk at once."""

    def rename(self, old: str, new: str) -> None:
        """Give a file another name, in place of a file of that name; all or nothing, and on the disk at once."""

    def remove(self, name: str) -> None:
        """Remove a file."""


def replace_whole(storage: Storage, name: str, content: bytes, part: str = "") -> None:
    """Bring a file into being under its name: whole, on the disk, or not at all; it grows under the name `part`.

    Raises
    ------
    OSError
        The disk does not keep it; what stood under the name still does.
    """
    part = part or f"{name}.part"
    if part in storage.sizes():
        storage.remove(part)
    file = storage.create(part)
    try:
        file.write(content)
        file.sync()
    finally:
        file.close()
    storage.rename(part, name)
