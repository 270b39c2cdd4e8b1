"""Paths as they come over the radio: plain names below the root, and nothing else."""

from stommel.link.files.port import FileRefusalError, FtpError, Path

MOST_BYTES = 200
_MOST_NAMES = 16


def plain_path(text: str) -> Path:
    """Return the names of a path; `/`, `.` and nothing are the root.

    Raises
    ------
    FileRefusalError
        It leads out of the root, or has a name that is none.
    """
    if len(text.encode("utf-8", "replace")) > MOST_BYTES:
        raise FileRefusalError(FtpError.FAIL, f"path of {len(text)} characters: at most {MOST_BYTES} bytes are allowed")
    names = tuple(name for name in text.split("/") if name not in ("", "."))
    if len(names) > _MOST_NAMES:
        raise FileRefusalError(FtpError.FAIL, f"path of {len(names)} names: at most {_MOST_NAMES} are allowed")
    for name in names:
        if name == ".." or not name.isprintable() or set(name) & set('\\:*?"<>|\N{REPLACEMENT CHARACTER}'):
            raise FileRefusalError(FtpError.FAIL, f"path {text!r}: must be of plain names below the root")
    return names


def file_path(text: str) -> Path:
    """Return the names of a path that is not the root.

    Raises
    ------
    FileRefusalError
        It leads out of the root, is the root, or has a name that is none.
    """
    path = plain_path(text)
    if not path:
        raise FileRefusalError(FtpError.FAIL, "the root is no file")
    return path


def shown(path: Path) -> str:
    """A path in words."""
    return "/".join(path) or "/"
