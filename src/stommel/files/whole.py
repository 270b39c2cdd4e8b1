"""Writing results: whole or not at all, and refused before long work where nothing could be written."""

import errno
import os
import shutil
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from threading import Lock

from stommel.errors import OutputError

_LONGEST_SHOWN = 160
"""Characters of a path in a message."""

_UMASK = Lock()
"""Held while the mask of new files, which can only be read by setting it, is looked at."""


def require_file(path: Path, endings: Sequence[str] = ()) -> None:
    """Refuse a path that no file can be written to; nothing is made there.

    Parameters
    ----------
    path
        A file that may stand there already; folders above it may be missing.
    endings
        What its name may end with, as .png; with anything if left out.

    Raises
    ------
    OutputError
        One line that says what is in the way, or what is allowed.
    """
    if os.path.isdir(path):  # noqa: PTH112 - Path.is_dir raises for a name that is too long
        raise OutputError(f"{shown(path)}: cannot be written: it is a folder")
    if endings and path.suffix.lower() not in endings:
        *others, last = endings
        allowed = f"{', '.join(others)} or {last}" if others else last
        raise OutputError(f"{shown(path)}: the name must end with {allowed}")
    if not os.path.exists(path) or os.path.isfile(path):  # noqa: PTH110, PTH113 - likewise
        _require_room(path, path.parent)


def require_folder(path: Path) -> None:
    """Refuse a path where no folder of results is or can be made; nothing is made there.

    Raises
    ------
    OutputError
        One line that says what is in the way.
    """
    if path.anchor and path == Path(path.anchor):
        raise OutputError(f"{shown(path)}: cannot be written: it is the root of all files; name a folder")
    _require_room(path, path)


def _require_room(path: Path, folder: Path) -> None:
    """Refuse `path` unless a file can be made in `folder`, or in the nearest folder above it that is there."""
    there = next(above for above in (folder, *folder.parents) if os.path.lexists(above))
    try:
        if not there.is_dir():
            raise NotADirectoryError(errno.ENOTDIR, os.strerror(errno.ENOTDIR))
        for name in (path, *(there / part for part in path.relative_to(there).parts)):
            with suppress(FileNotFoundError):
                name.lstat()  # a name that is too long
        with tempfile.TemporaryFile(dir=there):
            pass
    except OSError as error:
        raise OutputError(f"{shown(path)}: cannot be written: {error.strerror or error}") from error


def shown(path: Path) -> str:
    """A path as a message names it: on one line, of a sensible length."""
    text = str(path) if str(path).isprintable() else repr(str(path))
    half = _LONGEST_SHOWN // 2 - 2
    return text if len(text) <= _LONGEST_SHOWN else f"{text[:half]}...{text[-half:]}"


def write_whole(path: Path, content: bytes | str) -> None:
    """Write `content` to `path` so that nothing half-written is ever found there; folders are made as needed.

    Raises
    ------
    OutputError
        The file or its folder cannot be written; what stood there before still does.
    """
    with whole_file(path) as temporary:
        temporary.write_bytes(content.encode("utf-8") if isinstance(content, str) else content)


def write_private(path: Path, content: str) -> None:
    """Write `content` to `path` as a file that only its owner may read; it is on the disk under its name at the end.

    Raises
    ------
    OutputError
        The file or its folder cannot be written, or no regular file stands there; what stood there still does.
    """
    temporary: Path | None = None
    try:
        if os.path.lexists(path) and not path.is_file():
            raise OutputError(f"{shown(path)}: cannot be written: it is no regular file")
        path.parent.mkdir(parents=True, exist_ok=True)
        descriptor, name = tempfile.mkstemp(dir=path.parent, prefix=".", suffix=".part")  # of mode 0600
        temporary = Path(name)
        with os.fdopen(descriptor, "wb") as file:
            file.write(content.encode("utf-8"))
            file.flush()
            os.fsync(descriptor)
        temporary.replace(path)
        sync_names(path.parent)
    except OSError as error:
        raise OutputError(f"{shown(path)}: cannot be written: {error.strerror or error}") from error
    finally:
        if temporary is not None:
            temporary.unlink(missing_ok=True)


def sync_names(folder: Path) -> None:
    """Bring a folder's names to the disk; Windows keeps them by itself, and opens no folder."""
    if sys.platform == "win32":
        return
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """Give a temporary file to write, which takes the place of `path` at the end if nothing went wrong.

    Raises
    ------
    OutputError
        The file or its folder cannot be written; what stood there before still does.
    """
    temporary: Path | None = None
    try:
        # a device, a pipe, a link: written into, never replaced
        special = path.is_symlink() or (path.exists() and not (path.is_file() or path.is_dir()))
        if path.is_dir():
            raise OutputError(f"{shown(path)}: cannot be written: it is a folder")
        folder = Path(tempfile.gettempdir()) if special else path.parent
        folder.mkdir(parents=True, exist_ok=True)
        descriptor, name = tempfile.mkstemp(dir=folder, prefix=".", suffix=".part")
        os.close(descriptor)
        temporary = Path(name)
        yield temporary
        if special:
            with temporary.open("rb") as source, path.open("wb") as target:
                shutil.copyfileobj(source, target)
            temporary.unlink()
        else:
            _take_place(temporary, path)
    except OSError as error:
        raise OutputError(f"{shown(path)}: cannot be written: {error.strerror or error}") from error
    finally:
        if temporary is not None:
            temporary.unlink(missing_ok=True)


def _take_place(temporary: Path, path: Path) -> None:
    """Make sure that the content is on the disk, then put it under its name."""
    with temporary.open("rb+") as file:
        os.fsync(file.fileno())
    with _UMASK:  # of the whole process: another thread must not take our 0 for it
        umask = os.umask(0)
        os.umask(umask)
    temporary.chmod(0o666 & ~umask)
    temporary.replace(path)
