"""Reading TOML files that users write: the one place where TOML is parsed.

TOML itself bounds neither the digits of a number nor the depth of tables; both are bounded here, so that no file takes
long, and none breaks what reads its values.
"""

import re
import tomllib
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel

from stommel.errors import FileError, Problem
from stommel.files.opening import TOML_MIB, read_text
from stommel.files.sentences import validated

Model = TypeVar("Model", bound=BaseModel)

DEEPEST = 32
"""Tables and lists that may stand within each other."""

_LARGEST = (1 << 63) - 1
"""TOML's integers have 64 bits."""
_PART = r"""(?:[\w-]++|"(?:[^"\\\n]|\\.)*+"|'[^'\n]*+')[ \t]*+"""
_LONG_KEY = re.compile(rf"(?<![\w-]){_PART}(?:\.[ \t]*+{_PART}){{{DEEPEST}}}")
"""A dotted key of too many parts; the time that the parser takes grows with their square."""
_LONG_INTEGER = re.compile(r"[0-9](?:_?[0-9]){4299,}")
"""Digits from which on Python refuses to convert an integer."""
_PLACE = re.compile(r"(.*) \(at (?:line (\d+), column \d+|end of document)\)", re.DOTALL)
_TWICE = ("Cannot overwrite", "Cannot declare", "Cannot mutate", "Duplicate inline")
"""How the parser begins to say that a key or table stands twice."""
_LONGEST_REASON = 120


def read_table(path: str | Path, model: type[Model]) -> Model:
    """Read and validate a TOML file.

    Raises
    ------
    FileError
        The file cannot be read or is not TOML, or one problem for each wrong key, with what is allowed.
    """
    return validated(read_toml(path), model, str(path))


def read_toml(path: str | Path) -> dict[str, Any]:
    """Return the tables of a TOML file.

    Raises
    ------
    FileError
        The file cannot be read, or is not TOML.
    """
    return parse_toml(read_text(path, TOML_MIB), str(path))


def parse_toml(text: str, origin: str) -> dict[str, Any]:
    """Return the tables of a TOML text; `origin` names it in messages.

    Raises
    ------
    FileError
        The text is not TOML, is nested too deeply, or has an integer beyond 64 bits.
    """
    if _LONG_KEY.search(text):
        raise _too_deep(origin)
    try:
        document = _loaded(text)
    except RecursionError:
        raise _too_deep(origin) from None
    except ValueError as error:
        raise FileError([Problem(origin, *_not_toml(str(error), text))]) from None
    _refuse_unbounded(document, "", 0, origin)
    return document


def _loaded(text: str) -> dict[str, Any]:
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        raise
    except ValueError:
        # thousands of digits: read again with twenty, to learn which key has them
        return tomllib.loads(_LONG_INTEGER.sub("9" * 20, text))


def _refuse_unbounded(value: Any, key: str, depth: int, origin: str) -> None:
    if isinstance(value, int) and not -_LARGEST - 1 <= value <= _LARGEST:
        what = f"must be a whole number between {-_LARGEST - 1} and {_LARGEST}, the integers of TOML"
        raise FileError([Problem(origin, key, f"{key}: {what}")])
    inside = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    if depth > DEEPEST:
        raise _too_deep(origin)
    for name, item in inside:
        _refuse_unbounded(item, f"{key}.{name}" if key else str(name), depth + 1, origin)


def _too_deep(origin: str) -> FileError:
    what = f"is nested too deeply: at most {DEEPEST} tables and lists may stand within each other"
    return FileError([Problem(origin, "", what)])


def _not_toml(reason: str, text: str) -> tuple[str, str]:
    """Key, where it is known, and sentence for what the parser says."""
    found = _PLACE.fullmatch(reason)
    if found is not None and found[1].startswith(_TWICE):
        lines = text.rstrip().split("\n")
        number = int(found[2] or len(lines))
        key = _key_in(found[1]) or _key_of(lines[number - 1])
        if key:
            return key, f"is not valid TOML: line {number}: {key} stands twice"
    short = reason if len(reason) <= _LONGEST_REASON else f"{reason[:_LONGEST_REASON]}..."
    return "", f"is not valid TOML: {short}"


def _key_in(reason: str) -> str:
    """Key that the parser's sentence quotes."""
    return ".".join(re.findall(r"'([^']*)'", reason))[:_LONGEST_REASON]


def _key_of(line: str) -> str:
    """Key or name of a table that a line begins with."""
    found = re.match(r"\s*(?:\[+([^\]=]+)\]|([^=\[\]{},#]+)=)", line)
    return (found[1] or found[2]).strip()[:_LONGEST_REASON] if found else ""
