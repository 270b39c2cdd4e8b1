"""Engines by name: that of a vehicle, one of the examples, or a file with an [engine] of its own."""

from collections.abc import Mapping
from dataclasses import dataclass
from importlib import resources
from typing import Any

from stommel.errors import StommelError
from stommel.files.fields import Name, Table
from stommel.files.kinds import Format
from stommel.files.nearest import did_you_mean
from stommel.files.opening import TOML_MIB, names_file, read_text
from stommel.files.provenance import separate
from stommel.files.sentences import validated
from stommel.files.toml_reader import parse_toml
from stommel.vehicle import Vehicle
from stommel.vehicle.missing_table import missing_table
from stommel.vehicle.schema import Engine

_EXAMPLES = "examples"


class EngineFile(Table):
    """A file that describes an engine and no vehicle."""

    format: Format = 1
    name: Name
    summary: str = ""
    notes: tuple[str, ...] = ()
    engine: Engine


class NoEngineError(StommelError):
    """The vehicle has no [engine], or no engine has this name."""


@dataclass(frozen=True)
class NamedEngine:
    """An engine and what it is called."""

    name: str
    engine: Engine


def example_names() -> tuple[str, ...]:
    """Names of the engines that ship with stommel."""
    folder = resources.files(__package__) / _EXAMPLES
    return tuple(sorted(entry.name.removesuffix(".toml") for entry in folder.iterdir() if entry.name.endswith(".toml")))


def engine_of(vehicle: Vehicle) -> NamedEngine:
    """Return the engine of a vehicle.

    Raises
    ------
    NoEngineError
        Its file has no table [engine].
    """
    if vehicle.description.engine is None:
        raise NoEngineError(
            f"{vehicle.name}: its file has no table [engine], the hydraulic circuit of the buoyancy engine; "
            f"try another engine on it with --engine: {', '.join(example_names())}, or a file; "
            f"{missing_table('engine')}"
        )
    return NamedEngine(vehicle.name, vehicle.description.engine)


def load_engine(name_or_path: str) -> NamedEngine:
    """Load an example by name, or a file with a table [engine] by path; it may be a vehicle file.

    Raises
    ------
    NoEngineError
        Neither an example nor a file.
    FileError
        The file cannot be read, or is not a possible engine; every problem is named.
    """
    if name_or_path in example_names():
        text = (resources.files(__package__) / _EXAMPLES / f"{name_or_path}.toml").read_text(encoding="utf-8")
        return engine_from_text(text, f"{name_or_path}.toml")
    if not names_file(name_or_path):
        raise NoEngineError(
            f"engine {name_or_path!r} is neither an example nor a file{did_you_mean(name_or_path, example_names())} "
            f"examples: {', '.join(example_names())}"
        )
    return engine_from_text(read_text(name_or_path, TOML_MIB), name_or_path)


def engine_from_text(text: str, origin: str) -> NamedEngine:
    """Parse and validate a file with a table [engine]; of a vehicle file only that table is read.

    Raises
    ------
    FileError
        As `load_engine`.
    """
    document, _ = separate(parse_toml(text, origin), origin)
    found = validated(_without_vehicle(document), EngineFile, origin)
    return NamedEngine(found.name, found.engine)


def _without_vehicle(document: Mapping[str, Any]) -> Mapping[str, Any]:
    """Leave out the tables of a vehicle file, known by its rigid body."""
    if "rigid_body" not in document:
        return document
    return {key: value for key, value in document.items() if key in EngineFile.model_fields}
