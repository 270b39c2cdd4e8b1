"""Files of the simulated vehicle's inbox, in memory."""

import errno


class MemoryFolder:
    """A disk of received files, as `stommel.link.files.disk` has it."""

    def __init__(self) -> None:
        self.files: dict[str, bytearray] = {}

    def sizes(self) -> dict[str, int]:
        """Every file by name, with its size in bytes."""
        return {name: len(content) for name, content in self.files.items()}

    def read(self, name: str, offset: int, length: int) -> bytes:
        """Bytes of a file; fewer at its end."""
        return bytes(self._content(name)[offset : offset + length])

    def write(self, name: str, offset: int, data: bytes) -> None:
        """Put bytes at a place."""
        content = self.files.setdefault(name, bytearray())
        content.extend(bytes(max(0, offset - len(content))))
        content[offset : offset + len(data)] = data

    def sync(self, name: str) -> None:
        """Memory needs no syncing."""

    def rename(self, old: str, new: str) -> None:
        """Give a file another name, in place of a file of that name."""
        self.files[new] = self._content(old)
        del self.files[old]

    def remove(self, name: str) -> None:
        """Remove a file."""
        self._content(name)
        del self.files[name]

    def _content(self, name: str) -> bytearray:
        if name not in self.files:
            raise FileNotFoundError(errno.ENOENT, "No such file or directory", name)
        return self.files[name]
