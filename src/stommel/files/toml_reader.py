"""Reading TOML files that users write."""

import tomllib
from pathlib import Path
from typing import Any

from stommel.errors import FileError, Problem


def read_toml(path: str | Path) -> dict[str, Any]:
    """Return the tables of a TOML file.

    Raises
    ------
    FileError
        The file cannot be read, or is not TOML.
    """
    origin = str(path)
    try:
        return tomllib.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise FileError([Problem(origin, "", f"cannot be read: {reason}")]) from error
    except tomllib.TOMLDecodeError as error:
        raise FileError([Problem(origin, "", f"is not valid TOML: {error}")]) from error
