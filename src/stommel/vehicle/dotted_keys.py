"""Numbers of a vehicle file by their dotted keys; a number inside a list by its index: `centre_of_mass_m.2`."""

import difflib
from collections.abc import Mapping
from typing import Any

from stommel.files.provenance import numbers
from stommel.files.sentences import dotted


def number_at(document: Mapping[str, Any], key: str) -> float | None:
    """Number at a dotted key; None where there is none."""
    here: Any = document
    for part in key.split("."):
        here = _step(here, part)
    return None if isinstance(here, bool) or not isinstance(here, int | float) else float(here)


def with_default(document: Mapping[str, Any], defaults: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    """Return the document with the default at `key` filled in where it leaves that out."""
    filled: dict[str, Any] = dict(document)
    here: Any = filled
    inside: Any = defaults
    for part in key.split("."):
        if not isinstance(here, dict) or not isinstance(inside, Mapping) or part not in inside:
            break
        here[part] = _copied(here.get(part, inside[part]))
        here, inside = here[part], inside[part]
    return filled


def with_number(document: Mapping[str, Any], key: str, value: float) -> Mapping[str, Any]:
    """Return the document with another number at a key that it has; both mirrors of an entry of a tensor change."""
    parts = key.split(".")
    changed: Mapping[str, Any] = _changed(document, parts, value)
    twin = _symmetric_twin(parts)
    return changed if twin is None else _changed(changed, twin, value)


def no_such_number(document: Mapping[str, Any], key: str, name: str) -> str:
    """Say that the vehicle of this name has no number at `key`, and which are near."""
    known = [known for known, _ in numbers(document)]
    table = key.split(".", maxsplit=1)[0]
    around = [other for other in known if other.split(".")[0] == table]
    near = difflib.get_close_matches(key, known, 3, 0.6) or around[:8]
    hint = f"; near it are {', '.join(near)}" if near else ""
    return f"{dotted([key])}: no number of {name} has this key{hint}; `stommel vehicle show` lists all {len(known)}"


def _changed(here: Any, parts: list[str], value: float) -> Any:
    if not parts:
        return value
    copy: Any = dict(here) if isinstance(here, Mapping) else list(here)
    name: Any = parts[0] if isinstance(here, Mapping) else int(parts[0])
    copy[name] = _changed(here[name], parts[1:], value)
    return copy


def _step(here: Any, part: str) -> Any:
    if isinstance(here, Mapping):
        return here.get(part)
    if isinstance(here, list) and _is_index(part) and int(part) < len(here):
        return here[int(part)]
    return None


def _is_index(part: str) -> bool:
    return part.isascii() and part.isdigit() and len(part) < 10


def _copied(value: Any) -> Any:
    """Copy a table or list one level deep, tuples as lists."""
    if isinstance(value, Mapping):
        return dict(value)
    return [_copied(item) for item in value] if isinstance(value, list | tuple) else value


def _symmetric_twin(parts: list[str]) -> list[str] | None:
    """Return the mirror of an off-diagonal entry of a tensor."""
    if len(parts) < 3 or not parts[-3].endswith("inertia_kg_m2") or not (_is_index(parts[-1]) and _is_index(parts[-2])):
        return None
    return [*parts[:-2], parts[-1], parts[-2]] if parts[-1] != parts[-2] else None
