"""Writing results: whole or not at all."""

import os
import tempfile
from pathlib import Path

from stommel.errors import OutputError


def write_whole(path: Path, content: bytes | str) -> None:
    """Write `content` to `path` so that nothing half-written is ever found there; folders are made as needed.

    Raises
    ------
    OutputError
        The file or its folder cannot be written; what stood there before still does.
    """
    data = content.encode("utf-8") if isinstance(content, str) else content
    temporary: str | None = None
    try:
        if path.is_symlink() or (path.exists() and not (path.is_file() or path.is_dir())):
            path.write_bytes(data)  # a device, a pipe, a link: written into, never replaced
            return
        path.parent.mkdir(parents=True, exist_ok=True)
        if path.is_dir():
            raise OutputError(f"{path}: cannot be written: it is a folder")
        descriptor, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.", suffix=".part")
        with os.fdopen(descriptor, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        umask = os.umask(0)
        os.umask(umask)
        Path(temporary).chmod(0o666 & ~umask)
        Path(temporary).replace(path)
    except OSError as error:
        if temporary is not None:
            Path(temporary).unlink(missing_ok=True)
        raise OutputError(f"{path}: cannot be written: {error.strerror or error}") from error
