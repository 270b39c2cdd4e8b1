"""A new vehicle file: the tables that a vehicle must have, short and commented, every number an assumption.

Other sections are added one at a time. All numbers are those of another vehicle until their user says otherwise.
"""

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from stommel.errors import StommelError
from stommel.files.docstrings import attribute_docstrings
from stommel.files.table_keys import models_in
from stommel.vehicle.loading import (
    UnknownVehicleError,
    Vehicle,
    builtin_names,
    load_vehicle,
    vehicle_from_text,
)
from stommel.vehicle.schema import VehicleFile

FIRST = (
    "specification", "water", "rigid_body", "moving_mass", "ballast", "added_inertia", "hydrodynamics", "wing",
    "rudder", "actuators",
)  # fmt: skip
"""Tables that every new file has, as far as the vehicle that it begins from has them."""

SECTIONS: Mapping[str, tuple[str, ...]] = {
    "hull": ("hull",),
    "engine": ("engine",),
    "drives": ("drives",),
    "battery": ("battery", "energy", "consumers"),
    "parts": ("bays", "parts"),
    "antenna": ("antenna",),
}
"""Sections that may be added, and their tables."""

_NEEDS = {"parts": "hull"}
"""Sections that another one cannot stand without."""
_WIDTH = 100
"""A comment stands behind its key as far as the line is no longer."""


class SectionError(StommelError):
    """A section that does not exist, that the vehicle to begin from lacks, or that the file has already."""


def sections_of(text: str) -> tuple[str, ...]:
    """Read the names of sections from a list such as `engine,hull`.

    Raises
    ------
    SectionError
        There is no such section.
    """
    names = [name.strip() for name in text.split(",")]
    for name in names:
        if name not in SECTIONS:
            raise SectionError(f"--with {text}: there is no section {name!r}; there are {', '.join(SECTIONS)}")
    return tuple(dict.fromkeys(names))


def lean_text(name: str, like: Vehicle, called: str, sections: Sequence[str] = ()) -> str:
    """Text of a new vehicle file.

    Parameters
    ----------
    name
        Name of the new vehicle.
    like
        The vehicle whose numbers it begins with, `called` so.
    sections
        Names of further sections.

    Raises
    ------
    SectionError
        The vehicle to begin from lacks a section.
    FileError
        The new file would be no possible vehicle.
    """
    lines = [
        f'# {name}, begun from {called}. Numbers are the value alone, or {{ value = 45, source = "where from" }},',
        '# or { value = 45, assumption = "why" }. What says nothing of its own is what the next line says.',
        f"assumption = {json.dumps(_copied(called), ensure_ascii=False)}",
        "format = 1",
        f"name = {json.dumps(name, ensure_ascii=False)}",
        "# Lengths along the hull are forward of the centre of buoyancy: x forward, y right, z down. Coefficients are",
        "# multiplied by speed squared, angles in radians. stommel vehicle new THIS_FILE --with SECTION adds one of",
        f"# {', '.join(SECTIONS)}; stommel vehicle check THIS_FILE holds its numbers against each other.",
    ]
    for table in FIRST:
        lines += _table_lines(table, like.document, None, lean=True)
    for section in _with_needed(sections, ()):
        lines += _section_lines(section, like, called, None)
    text = "\n".join(lines) + "\n"
    vehicle_from_text(text, f"{name}.toml")
    return text


def with_sections(text: str, origin: str, like: Vehicle, called: str, sections: Sequence[str]) -> str:
    """Text of a vehicle file with further sections at its end; what is there stays as it is.

    Raises
    ------
    SectionError
        The file has a section already, or the vehicle to copy it from lacks it.
    FileError
        The file is no vehicle, or would be none with the section.
    """
    vehicle = vehicle_from_text(text, origin)
    there = [name for name, tables in SECTIONS.items() if any(table in vehicle.document for table in tables)]
    for section in sections:
        if section in there:
            tables = [table for table in SECTIONS[section] if table in vehicle.document]
            raise SectionError(f"--with {section}: {origin} has [{tables[0]}] already")
    lines: list[str] = []
    for section in _with_needed(sections, there):
        lines += _section_lines(section, like, called, _copied(called))
    added = text.rstrip("\n") + "\n" + "\n".join(lines) + "\n"
    vehicle_from_text(added, origin)
    return added


def begun_from(name: str) -> tuple[Vehicle, str]:
    """The vehicle that `--from` names, and what to call it: a built-in one, or a file.

    Raises
    ------
    UnknownVehicleError, FileError
        As `load_vehicle`.
    """
    try:
        return load_vehicle(name), name if name in builtin_names() else Path(name).name
    except UnknownVehicleError as error:
        raise UnknownVehicleError(f"--from {name}: {error}") from None


def _copied(called: str) -> str:
    return f"copied from {called}"


def _with_needed(sections: Sequence[str], there: Iterable[str]) -> list[str]:
    """Sections with those that they need before them, but for those that are there."""
    ordered: list[str] = []
    for section in sections:
        needed = _NEEDS.get(section)
        ordered += [needed, section] if needed is not None and needed not in there else [section]
    return list(dict.fromkeys(ordered))


def _section_lines(section: str, like: Vehicle, called: str, stated: str | None) -> Iterator[str]:
    tables = [table for table in SECTIONS[section] if table in like.document]
    if not tables:
        having = [name for name in builtin_names() if SECTIONS[section][0] in load_vehicle(name).document]
        raise SectionError(
            f"--with {section}: {called} has no [{SECTIONS[section][0]}]; built-in vehicles that have it: "
            f"{', '.join(having)} (--from)"
        )
    for table in tables:
        yield from _table_lines(table, like.document, stated, lean=False)


def _table_lines(table: str, document: Mapping[str, Any], stated: str | None, *, lean: bool) -> Iterator[str]:
    """Lines of a table of a file, or of each of a list of tables; `stated` is said of its numbers.

    A `lean` table leaves out what the schema takes anyway.
    """
    if table in document:
        (model,) = models_in(VehicleFile.model_fields[table].annotation)
        values = _without_defaults(document[table], model) if lean else document[table]
        yield from _lines(table, values, model, stated)


def _without_defaults(values: Mapping[str, Any], model: type[BaseModel]) -> dict[str, Any]:
    """A table without those keys of its own whose value is that of the schema."""
    return {key: value for key, value in values.items() if value != model.model_fields[key].default}


def _lines(heading: str, value: Any, model: type[BaseModel], stated: str | None) -> Iterator[str]:
    if isinstance(value, list):
        for k, item in enumerate(value):
            yield from _one_table(f"[[{heading}]]", heading, item, model, stated, commented=k == 0)
    else:
        yield from _one_table(f"[{heading}]", heading, value, model, stated, commented=True)


def _one_table(
    opening: str,
    heading: str,
    values: Mapping[str, Any],
    model: type[BaseModel],
    stated: str | None,
    *,
    commented: bool,
) -> Iterator[str]:
    """Keys of a table, then the tables inside it."""
    meanings = attribute_docstrings(model) if commented else {}
    plain: list[tuple[str, Any]] = []
    inside: list[tuple[str, Any]] = []
    for key, value in values.items():
        (inside if models_in(model.model_fields[key].annotation) else plain).append((key, value))
    if plain or not inside or opening.startswith("[["):
        yield ""
        yield _with_comment(opening, model.__doc__ or "" if commented else "")
        if stated is not None:
            yield f"assumption = {json.dumps(stated, ensure_ascii=False)}"
        for key, value in plain:
            yield _with_comment(f"{key} = {_literal(value)}", meanings.get(key, ""))
        stated = None  # a table speaks for those inside it
    for key, value in inside:
        (table,) = models_in(model.model_fields[key].annotation)
        yield from _lines(f"{heading}.{key}", value, table, stated)


def _with_comment(line: str, text: str) -> str:
    """A line with the first sentence of what there is to say about it, where it has room."""
    first = text.split("\n", maxsplit=1)[0].split(". ", maxsplit=1)[0].rstrip(".")
    return f"{line}  # {first}" if first and len(line) + len(first) + 4 <= _WIDTH else line


def _literal(value: Any) -> str:
    """A value as TOML writes it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, list):
        return f"[{', '.join(map(_literal, value))}]"
    return repr(value)
