"""One-key mutations of a TOML document: every value of it in turn left out, negated, scaled, made absurd or of another
type.

A number that stands with its provenance, `{ value = 45, source = "..." }`, is mutated within that table.
"""

import copy
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import datetime
from typing import Any

from stommel.files.provenance import KINDS

Path = tuple[str | int, ...]


class _Absent:
    """Stands for a key that is left out."""


ABSENT = _Absent()
LONG = "x" * 5000

OF_NUMBERS: dict[str, Callable[[float], Any]] = {
    "absent": lambda _: ABSENT,
    "negative": lambda x: -x,
    "zero": lambda _: 0,
    "x1000": lambda x: x * 1000,
    "/1000": lambda x: x / 1000,
    "1e30": lambda _: 1e30,
    "-1e30": lambda _: -1e30,
    "1e308": lambda _: 1e308,
    "1e-30": lambda _: 1e-30,
    "1e-308": lambda _: 1e-308,
    "nan": lambda _: math.nan,
    "infinite": lambda _: math.inf,
    "greatest integer": lambda _: (1 << 63) - 1,
    "text": lambda _: "7",
    "true": lambda _: True,
    "list": lambda x: [x],
    "table": lambda x: {"a": x},
}
"""What becomes of a number, by name."""

OF_OTHERS: dict[str, Callable[[Any], Any]] = {
    "absent": lambda _: ABSENT,
    "number": lambda _: 42,
    "empty text": lambda _: "",
    "long text": lambda _: LONG,
    "empty list": lambda _: [],
    "table": lambda _: {},
    "nan": lambda _: math.nan,
}
"""What becomes of a text, a truth value, a date or a whole list or table."""


@dataclass(frozen=True)
class Mutation:
    """A document with one value changed."""

    path: Path
    """Where the value stands; `value` at the end is that of a number with its provenance."""
    kind: str
    """Name of what became of it."""
    value: Any
    """What stood there."""
    document: dict[str, Any]

    @property
    def key(self) -> str:
        """Dotted key as messages write it."""
        return ".".join(str(part) for part in self.path if part != "value")


def mutations(document: dict[str, Any]) -> Iterator[Mutation]:
    """Yield every one-key mutation of a document."""
    for path, value in _places(document, ()):
        if path[-1] in KINDS:
            continue
        number = isinstance(value, int | float) and not isinstance(value, bool)
        for kind, change in (OF_NUMBERS if number else OF_OTHERS).items():
            yield Mutation(path, kind, value, _with(document, path, change(value)))


def _places(here: Any, path: Path) -> Iterator[tuple[Path, Any]]:
    """Every value below, tables and lists among them."""
    if path:
        yield path, here
    inside = here.items() if isinstance(here, dict) else enumerate(here) if isinstance(here, list) else ()
    if isinstance(here, dict) and "value" in here and any(kind in here for kind in KINDS):
        inside = [("value", here["value"])]  # what is said of a number's origin is not its value
    for part, value in inside:
        yield from _places(value, (*path, part))


def _with(document: dict[str, Any], path: Path, value: Any) -> dict[str, Any]:
    """A document with another value at a path; what does not lead there is shared."""
    changed = dict(document)
    here: Any = changed
    for part in path[:-1]:
        here[part] = copy.copy(here[part])
        here = here[part]
    if value is ABSENT:
        del here[path[-1]]
    else:
        here[path[-1]] = value
    return changed


def toml_text(document: dict[str, Any]) -> str:
    """A document as TOML, a line for each key at its head."""
    return "".join(f"{_key(key)} = {_value(value)}\n" for key, value in document.items())


def _key(key: str) -> str:
    return key if key.replace("_", "").replace("-", "").isalnum() and key.isascii() else _value(key)


def _value(value: Any) -> str:
    match value:
        case bool():
            return str(value).lower()
        case str():
            escaped = value.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
            return f'"{escaped}"'
        case datetime():
            return value.isoformat()
        case float() if math.isnan(value):
            return "nan"
        case dict():
            return "{" + ", ".join(f"{_key(key)} = {_value(inner)}" for key, inner in value.items()) + "}"
        case list():
            return "[" + ", ".join(_value(inner) for inner in value) + "]"
        case _:
            return repr(value)
