"""Writing results: whole or not at all."""

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from stommel.errors import OutputError


def write_whole(path: Path, content: bytes | str) -> None:
    """Write `content` to `path` so that nothing half-written is ever found there; folders are made as needed.

    Raises
    ------
    OutputError
        The file or its folder cannot be written; what stood there before still does.
    """
    with whole_file(path) as temporary:
        temporary.write_bytes(content.encode("utf-8") if isinstance(content, str) else content)


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
            raise OutputError(f"{path}: cannot be written: it is a folder")
        folder = Path(tempfile.gettempdir()) if special else path.parent
        folder.mkdir(parents=True, exist_ok=True)
        descriptor, name = tempfile.mkstemp(dir=folder, prefix=f".{path.name}.", suffix=".part")
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
        raise OutputError(f"{path}: cannot be written: {error.strerror or error}") from error
    finally:
        if temporary is not None:
            temporary.unlink(missing_ok=True)


def _take_place(temporary: Path, path: Path) -> None:
    """Make sure that the content is on the disk, then put it under its name."""
    with temporary.open("rb+") as file:
        os.fsync(file.fileno())
    umask = os.umask(0)
    os.umask(umask)
    temporary.chmod(0o666 & ~umask)
    temporary.replace(path)
