"""A folder that one program at a time may have; a program that dies gives it back."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from stommel.errors import StommelError


class FolderInUseError(StommelError):
    """Another program has the folder."""


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Keep other programs out of a folder that is there.

    Windows, and a file system that has no locks, keep nobody out.

    Raises
    ------
    FolderInUseError
        Another program has it.
    OSError
        It cannot be opened.
    """
    if sys.platform == "win32":
        yield
        return
    import fcntl  # noqa: PLC0415 - not on Windows

    descriptor = os.open(folder, os.O_RDONLY)
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise FolderInUseError(f"{folder}: another program has this folder") from None
        except OSError:
            pass  # not every file system has locks
        yield
    finally:
        os.close(descriptor)
