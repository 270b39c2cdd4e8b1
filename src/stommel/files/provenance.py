"""Where each number of a file comes from.

A number may be written plainly, or with its origin, of which there are three kinds:

- `{ value = 45, source = "Fan et al. (2013), section 3.1" }`: it is printed there;
- `{ value = 8.617, derived = "1.1 ml/r at 470 r/min, Fan et al. (2013), 4.3.2" }`: worked out, from what and how;
- `{ value = 0.12, assumption = "steel on bronze", range = [0.08, 0.2] }`: chosen, for want of a source.

What is inferred is no source. `range` says between which values the number may well lie; a number with a source needs
none. An origin that stands as a key of a table speaks for every number of that table which says nothing of its own, and
one at the head of the file for the rest.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import isfinite
from typing import Any, Literal

from stommel.errors import FileError, Problem
from stommel.files.sentences import shown

Kind = Literal["source", "derived", "assumption", "chosen", "not stated"]
"""What a file may say, and what a request chose, or nobody said."""
KINDS: tuple[Kind, ...] = ("source", "derived", "assumption")
RANGE = "range"


@dataclass(frozen=True)
class Provenance:
    """Origin of a number."""

    kind: Kind
    text: str
    range: tuple[float, float] | None = None
    """Between which values it may well lie, in the number's own unit; None if the file does not say."""


NOT_STATED = Provenance("not stated", "")


class _ProvenanceError(ValueError):
    """A provenance that is none; holds the key."""

    def __init__(self, key: str, message: str) -> None:
        self.key = key
        super().__init__(message)


def separate(document: Mapping[str, Any], origin: str) -> tuple[dict[str, Any], dict[str, Provenance]]:
    """Split a parsed file into plain values and the provenance of each dotted key; `origin` names it in messages.

    Raises
    ------
    FileError
        An origin is not text, a number has two of them, or a range is none.
    """
    found: dict[str, Provenance] = {}
    try:
        plain = _separate_table(document, "", NOT_STATED, found)
    except _ProvenanceError as error:
        raise FileError([Problem(origin, error.key, str(error))]) from None
    return plain, found


def _own(table: Mapping[str, Any], key: str) -> Provenance | None:
    stated = [kind for kind in KINDS if kind in table]
    if not stated:
        return None
    if len(stated) > 1:
        raise _ProvenanceError(key, f"{key or 'the file'} has both {' and '.join(stated)}; keep one")
    text = table[stated[0]]
    if not isinstance(text, str) or not text.strip():
        raise _ProvenanceError(key, f"{key or 'the file'}: {stated[0]} = {shown(text)}: must be text")
    return Provenance(stated[0], text)


def _separate_table(
    table: Mapping[str, Any], prefix: str, inherited: Provenance, found: dict[str, Provenance]
) -> dict[str, Any]:
    here = _own(table, prefix.rstrip(".")) or inherited
    plain: dict[str, Any] = {}
    for name, value in table.items():
        if name in KINDS:
            continue
        plain[name] = _separate_value(value, prefix + name, here, found)
    return plain


def _separate_value(value: Any, key: str, inherited: Provenance, found: dict[str, Provenance]) -> Any:
    if isinstance(value, Mapping):
        if "value" in value and set(value) <= {"value", RANGE, *KINDS}:
            found[key] = _of_one_number(value, key, inherited)
            return value["value"]
        return _separate_table(value, key + ".", inherited, found)
    if isinstance(value, list) and any(isinstance(item, Mapping) for item in value):
        return [_separate_value(item, f"{key}.{i}", inherited, found) for i, item in enumerate(value)]
    if inherited is not NOT_STATED:
        found[key] = inherited
    return value


def _of_one_number(table: Mapping[str, Any], key: str, inherited: Provenance) -> Provenance:
    own = _own(table, key) or inherited
    if RANGE not in table:
        return own
    if own.kind not in ("derived", "assumption"):
        raise _ProvenanceError(key, f"{key}: range needs derived or assumption beside it, with the reason")
    ends = table[RANGE]
    if not (isinstance(ends, list) and len(ends) == 2 and all(map(_is_number, ends)) and ends[0] <= ends[1]):
        raise _ProvenanceError(key, f"{key}: range = {shown(ends)}: must be two numbers, the lower first")
    return Provenance(own.kind, own.text, (float(ends[0]), float(ends[1])))


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and isfinite(value)


def check_ranges(document: Mapping[str, Any], found: Mapping[str, Provenance], origin: str) -> None:
    """Refuse a plain document, read and found sound, in which a number does not lie in its own range.

    Raises
    ------
    FileError
        One problem for each such number.
    """
    problems = [
        Problem(
            origin, key, f"{key} = {shown(value)}: must lie in its own range, {low:g} to {high:g}; change that with it"
        )
        for key, value in numbers(document)
        if (known := found.get(key)) and known.range
        for low, high in [known.range]
        if not (_is_number(value) and low <= value <= high)
    ]
    if problems:
        raise FileError(problems)


def numbers(document: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Yield (dotted key, value) of every number, or list of numbers, of a plain document."""
    for name, value in document.items():
        yield from _numbers_below(prefix + name, value)


def _numbers_below(key: str, value: Any) -> Iterator[tuple[str, Any]]:
    if isinstance(value, Mapping):
        yield from numbers(value, key + ".")
    elif isinstance(value, list) and value and isinstance(value[0], Mapping):
        for i, item in enumerate(value):
            yield from _numbers_below(f"{key}.{i}", item)
    elif isinstance(value, bool) or value is None:
        return
    elif isinstance(value, int | float) or (isinstance(value, list) and value and not isinstance(value[0], str)):
        yield key, value
