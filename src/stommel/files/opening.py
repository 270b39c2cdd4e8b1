"""Opening what users name: regular files of a bounded size, and one wording for all that cannot be read.

What stands at a path is looked at before it is opened, and its size before memory is asked for: a pipe would wait for
ever, and a device like /dev/zero never ends.
"""

import codecs
import os
import re
import stat
from pathlib import Path

from stommel.errors import FileError, Problem

TOML_MIB = 1
"""The most that a TOML file may have: a thousand times what people write, and read in two seconds."""
TABLE_MIB = 64
"""The most that a table of numbers may have, a profile or the log of a test: about a million rows."""

_ADDRESS = re.compile(r"([A-Za-z][A-Za-z0-9+.-]+):/")
"""How an address begins; Path leaves one of its slashes."""
_MIB = 1 << 20
_LONGEST_NAME = 255
"""Bytes of a name on common file systems."""
_KINDS = {
    stat.S_IFDIR: "a folder",
    stat.S_IFIFO: "a pipe",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
    stat.S_IFSOCK: "a socket",
}


def exists(path: str | Path) -> bool:
    """Whether anything stands there; the method of Path raises for a name that is impossible."""
    return os.path.exists(path)  # noqa: PTH110


def names_file(name: str) -> bool:
    """Whether a name is meant as a path, and not as that of something built in: by its look, or because it exists."""
    return not name or len(name) > _LONGEST_NAME or os.sep in name or Path(name).suffix != "" or exists(name)


def beside(folder: Path, name: str) -> str | Path:
    """What a file in `folder` means by a name: the file beside it, or else what the name alone means."""
    path = folder / name
    missing = names_file(name) and not exists(name)
    stands = exists(path) and not os.path.isdir(path)  # noqa: PTH112 - as above
    return path if stands or missing else name


def refuse_address(path: str | Path) -> None:
    """Refuse an address on the network, which would else be taken for the path of a file that is not there.

    Raises
    ------
    FileError
        It is one; the message says what to do.
    """
    found = _ADDRESS.match(str(path))
    if found is None:
        return
    name = str(path) if "://" in str(path) else str(path).replace(":/", "://", 1)
    if found[1].lower() == "file":
        raise unreadable(name, "it is an address; give the path alone")
    raise unreadable(name, "it is an address on the network, and only files are read; fetch it first and give the file")


def require_regular(path: str | Path) -> int:
    """Return the size of a regular file [bytes] without opening it.

    Raises
    ------
    FileError
        There is none, or something else stands there: a folder, a pipe, a device.
    """
    refuse_address(path)
    if str(path) in ("", "."):
        raise unreadable(".", "it is a folder, the one that you are in")
    try:
        found = os.stat(path)  # noqa: PTH116 - Path.stat of an empty name is that of a folder
    except (OSError, ValueError) as error:
        raise unreadable(path, _reason(error)) from None
    kind = stat.S_IFMT(found.st_mode)
    if kind != stat.S_IFREG:
        raise unreadable(path, f"it is {_KINDS.get(kind, 'no regular file')}")
    return found.st_size


def read_bytes(path: str | Path, most_mib: int) -> bytes:
    """Content of a regular file of at most `most_mib` mebibytes.

    Raises
    ------
    FileError
        The file cannot be read, or is larger.
    """
    most = most_mib * _MIB
    content = b""
    size = require_regular(path)
    if size <= most:
        try:
            with Path(path).open("rb") as file:
                content = file.read(most + 1)
        except OSError as error:
            raise unreadable(path, _reason(error)) from None
    # some files of the system say that they have 0 bytes
    if max(size, len(content)) > most:
        raise unreadable(path, f"it is larger than {most_mib} MiB, the most that is read")
    return content


def read_text(path: str | Path, most_mib: int) -> str:
    r"""Text of a regular file in UTF-8, with or without a mark of its encoding, its lines ended by \n.

    Raises
    ------
    FileError
        The file cannot be read, is larger than `most_mib` mebibytes, or is no text.
    """
    return text_of(read_bytes(path, most_mib), path)


def text_of(content: bytes, path: str | Path) -> str:
    r"""Text of bytes that were read from a file, as `read_text` returns it.

    Raises
    ------
    FileError
        They are no text.
    """
    content = content.removeprefix(codecs.BOM_UTF8)
    try:
        text = content.decode("utf-8")
    except UnicodeDecodeError as error:
        line, byte = content.count(b"\n", 0, error.start) + 1, content[error.start]
        raise unreadable(path, f"it is not UTF-8 text: line {line} has the byte 0x{byte:02x}") from None
    return text.replace("\r\n", "\n").replace("\r", "\n")


def unreadable(path: str | Path, why: str) -> FileError:
    """Return the error of a file that cannot be read."""
    return FileError([Problem(str(path), "", f"cannot be read: {why}")])


def _reason(error: OSError | ValueError) -> str:
    return getattr(error, "strerror", None) or str(error)
