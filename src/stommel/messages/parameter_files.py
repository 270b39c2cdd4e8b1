"""A parameter store in two files, each written whole or not at all."""

from pathlib import Path

from stommel.files.opening import exists, read_bytes
from stommel.files.whole import write_whole

_MOST_MIB = 1
"""More than 256 parameters take."""


class ParameterFiles:
    """Copies `NAME.0` and `NAME.1` in a folder, which is made when the first is written."""

    def __init__(self, folder: Path, name: str) -> None:
        self._paths = [folder / f"{name}.{copy}" for copy in (0, 1)]

    def read(self, copy: int) -> bytes | None:
        """Return a copy; None if there is no such file.

        Raises
        ------
        FileError
            It cannot be read.
        """
        path = self._paths[copy]
        return read_bytes(path, _MOST_MIB) if exists(path) else None

    def write(self, copy: int, content: bytes) -> None:
        """Replace a copy.

        Raises
        ------
        OutputError
            It cannot be written; what stood there before still does.
        """
        write_whole(self._paths[copy], content)
