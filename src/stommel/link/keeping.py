"""What JSON can say, in small files that are replaced as a whole and know when they are damaged."""

import json
from typing import Any

from stommel.files.sealing import sealed, unsealed
from stommel.files.storage import Storage, replace_whole


class DamagedError(ValueError):
    """A file is there, and is not what was kept."""


def keep(storage: Storage, name: str, content: object) -> None:
    """Bring what JSON can say to the disk under a name: whole, or not at all.

    Raises
    ------
    OSError
        The disk does not keep it; what stood under the name still does.
    """
    told = json.dumps(content, separators=(",", ":"), allow_nan=False)
    replace_whole(storage, name, sealed(told))


def kept(storage: Storage, name: str) -> Any:
    """Return what was kept under a name; None if nothing ever was.

    Raises
    ------
    DamagedError
        It cannot be read, or is damaged.
    """
    try:
        told = unsealed(storage.read(name))
    except FileNotFoundError:
        return None
    except OSError as error:
        raise DamagedError(f"{name}: cannot be read: {error.strerror or error}") from error
    if told is None:
        raise DamagedError(f"{name}: is damaged: its SHA-256 is another")
    try:
        return json.loads(told)
    except (ValueError, RecursionError) as error:
        raise DamagedError(f"{name}: is damaged: {error}") from error
