"""Where each number of a vehicle file comes from.

A number may be written plainly, or as `{ value = 45, source = "Fan et al. (2013), section 3.1" }`, or as
`{ value = 0.005, assumption = "no figure published; typical of lead screws" }`. A `source` or `assumption` that stands
as a key of a table speaks for every number of that table which says nothing of its own, and one at the head of the file
for the rest.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal

from stommel.errors import FileError, Problem
from stommel.files.sentences import shown

Kind = Literal["source", "assumption", "not stated"]
KINDS: tuple[Kind, ...] = ("source", "assumption")


@dataclass(frozen=True)
class Provenance:
    """Origin of a number."""

    kind: Kind
    text: str


NOT_STATED = Provenance("not stated", "")


class _ProvenanceError(ValueError):
    """A provenance that is not text; holds the key."""

    def __init__(self, key: str, message: str) -> None:
        self.key = key
        super().__init__(message)


def separate(document: Mapping[str, Any], origin: str) -> tuple[dict[str, Any], dict[str, Provenance]]:
    """Split a parsed file into plain values and the provenance of each dotted key; `origin` names it in messages.

    Raises
    ------
    FileError
        A source or assumption is not text, or a number has both.
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
        raise _ProvenanceError(key, f"{key or 'the file'} has both a source and an assumption; keep one")
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
        if "value" in value and set(value) <= {"value", *KINDS}:
            found[key] = _own(value, key) or inherited
            return value["value"]
        return _separate_table(value, key + ".", inherited, found)
    if isinstance(value, list) and any(isinstance(item, Mapping) for item in value):
        return [_separate_value(item, f"{key}.{i}", inherited, found) for i, item in enumerate(value)]
    if inherited is not NOT_STATED:
        found[key] = inherited
    return value


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
