"""Reading vehicle files, the built-in ones and the user's."""

import difflib
import os
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from importlib import resources
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from stommel.errors import FileError, Problem, StommelError
from stommel.files.provenance import NOT_STATED, Provenance, ProvenanceError, numbers, separate
from stommel.files.sentences import sentences
from stommel.vehicle.checks import problems
from stommel.vehicle.schema import VehicleFile

_BUILTIN = "builtin"


class UnknownVehicleError(StommelError):
    """Neither a built-in vehicle nor a file."""


class LateralPlaneUnknownError(StommelError):
    """The vehicle's sources do not give the coefficients of sideways motion."""


@dataclass(frozen=True)
class Vehicle:
    """A glider: its validated description, and where each number comes from."""

    description: VehicleFile
    origin: str
    """File name, for messages."""
    document: Mapping[str, Any] = field(repr=False)
    """The file's plain values by table."""
    provenance: Mapping[str, Provenance] = field(repr=False)
    builtin: str | None = None
    """Name of the built-in vehicle that this is, unchanged."""

    @property
    def name(self) -> str:
        """Name of the vehicle."""
        return self.description.name

    def provenance_of(self, key: str) -> Provenance:
        """Origin of the number at the dotted `key`."""
        return self.provenance.get(key, NOT_STATED)

    def with_value(self, key: str, value: float) -> "Vehicle":
        """Return this vehicle with the number at the dotted `key` changed, validated anew.

        A number inside a list is addressed by its index: `rigid_body.centre_of_mass_m.2`.

        Raises
        ------
        FileError
            The key is unknown or not a number, or the changed vehicle is impossible.
        """
        document = _with_value(self, key, value)
        kept = {known: origin for known, origin in self.provenance.items() if known != key}  # not its source's any more
        return Vehicle(_validated(document, self.origin), self.origin, document, kept)

    def value(self, key: str) -> float:
        """Number at the dotted `key`, in the file's unit.

        Raises
        ------
        FileError
            The key is unknown or not a number.
        """
        found = _container(self, _document_with(self, key), key)[_last(key)]
        if isinstance(found, bool) or not isinstance(found, int | float):
            raise _not_a_number(self, key)
        return float(found)

    def require_lateral(self, use: str) -> None:
        """Raise `LateralPlaneUnknownError` if sideways motion of this vehicle is unknown."""
        missing = list(self.description.unknown_lateral())
        if missing:
            raise LateralPlaneUnknownError(
                f"{self.name}: {use} needs the lateral plane, whose coefficients are not published for this vehicle "
                f"(missing: {', '.join(missing)}); wings-level flight in the vertical plane works"
            )


def builtin_names() -> tuple[str, ...]:
    """Names of the vehicles that ship with stommel."""
    folder = resources.files(__package__) / _BUILTIN
    return tuple(sorted(entry.name.removesuffix(".toml") for entry in folder.iterdir() if entry.name.endswith(".toml")))


def builtin_text(name: str) -> str:
    """Text of the file of a built-in vehicle."""
    return (resources.files(__package__) / _BUILTIN / f"{name}.toml").read_text(encoding="utf-8")


def load_vehicle(name_or_path: str | Path) -> Vehicle:
    """Load a built-in vehicle by name, or a vehicle file by path.

    Raises
    ------
    UnknownVehicleError
        No built-in vehicle has this name, and no such file exists.
    FileError
        The file is not a possible vehicle; the error lists every problem with its key and what is allowed.
    """
    name = str(name_or_path)
    if name in builtin_names():
        return replace(vehicle_from_text(builtin_text(name), f"{name}.toml"), builtin=name)
    # os.path: the methods of Path raise for a name that is too long
    if not os.path.exists(name) or os.path.isdir(name):  # noqa: PTH110, PTH112
        what = "is a folder" if os.path.isdir(name) else "is neither a built-in vehicle nor a file"  # noqa: PTH112
        raise UnknownVehicleError(f"vehicle {name!r} {what}; built-in: {', '.join(builtin_names())}")
    try:
        text = Path(name).read_text(encoding="utf-8-sig")  # some editors begin a file with a mark of its encoding
    except OSError as error:
        raise FileError([Problem(name, "", f"cannot be read: {error.strerror or error}")]) from error
    except UnicodeDecodeError as error:
        what = f"cannot be read as UTF-8: byte {error.start} is 0x{error.object[error.start]:02x}"
        raise FileError([Problem(name, "", what)]) from error
    return vehicle_from_text(text, name)


def vehicle_from_text(text: str, origin: str) -> Vehicle:
    """Parse and validate the text of a vehicle file; `origin` names it in messages.

    Raises
    ------
    FileError
        As `load_vehicle`.
    """
    try:
        document, provenance = separate(tomllib.loads(text))
    except ProvenanceError as error:
        raise FileError([Problem(origin, error.key, str(error))]) from error
    except ValueError as error:  # TOMLDecodeError, and an integer of thousands of digits
        raise FileError([Problem(origin, "", f"is not valid TOML: {str(error).split(';')[0]}")]) from error
    except RecursionError as error:
        raise FileError([Problem(origin, "", "is nested too deeply")]) from error
    return Vehicle(_validated(document, origin), origin, document, provenance)


def stated_numbers(vehicle: Vehicle) -> list[tuple[str, Any, Provenance]]:
    """Every number of the file with its dotted key and origin, in the order of the file."""
    return [(key, value, vehicle.provenance_of(key)) for key, value in numbers(vehicle.document) if key != "format"]


def _validated(document: Mapping[str, Any], origin: str) -> VehicleFile:
    try:
        description = VehicleFile.model_validate(document)
    except ValidationError as error:
        found = sentences(error, VehicleFile)
        raise FileError([Problem(origin, key, sentence) for key, sentence in found]) from None
    wrong = [Problem(origin, key, sentence) for key, sentence in problems(description)]
    if wrong:
        raise FileError(wrong)
    return description


def _last(key: str) -> str | int:
    last = key.rsplit(".", 1)[-1]
    return int(last) if last.isdigit() else last


def _not_a_number(vehicle: Vehicle, key: str) -> FileError:
    known = [name for name, _ in numbers(vehicle.document)]
    table = key.split(".", maxsplit=1)[0]
    near = difflib.get_close_matches(key, known, 3, 0.6) or [name for name in known if name.split(".")[0] == table][:8]
    hint = f"; near it are {', '.join(near)}" if near else ""
    text = f"{key}: no number of {vehicle.name} has this key{hint}; `stommel vehicle show` lists all {len(known)}"
    return FileError([Problem(vehicle.origin, key, text)])


def _document_with(vehicle: Vehicle, key: str) -> Mapping[str, Any]:
    """Return the file's values, with the default of the field at `key` filled in where the file leaves it out."""
    document: dict[str, Any] = dict(vehicle.document)
    defaults: Any = vehicle.description.model_dump(exclude_none=True)
    here: Any = document
    for part in key.split("."):
        if not isinstance(here, dict) or not isinstance(defaults, Mapping) or part not in defaults:
            break
        here[part] = _copied(here.get(part, defaults[part]))
        here, defaults = here[part], defaults[part]
    return document


def _copied(value: Any) -> Any:
    """Copy a table or list one level deep, tuples as lists."""
    if isinstance(value, Mapping):
        return dict(value)
    return [_copied(item) for item in value] if isinstance(value, list | tuple) else value


def _container(vehicle: Vehicle, document: Mapping[str, Any], key: str) -> Any:
    """Return the table or list that holds the last part of a dotted key."""
    here: Any = document
    parts = key.split(".")
    for part in parts[:-1]:
        here = _step(here, part)
    last = _last(key)
    if isinstance(here, Mapping) and isinstance(last, str) and last in here:
        return here
    if isinstance(here, list) and isinstance(last, int) and last < len(here):
        return here
    raise _not_a_number(vehicle, key)


def _step(here: Any, part: str) -> Any:
    if isinstance(here, Mapping):
        return here.get(part)
    if isinstance(here, list) and part.isdigit() and int(part) < len(here):
        return here[int(part)]
    return None


def _with_value(vehicle: Vehicle, key: str, value: float) -> Mapping[str, Any]:
    vehicle.value(key)  # refuses an unknown key
    parts = key.split(".")
    twin = _symmetric_twin(parts)

    def changed(here: Any, depth: int) -> Any:
        if depth == len(parts):
            return value
        copy = dict(here) if isinstance(here, Mapping) else list(here)
        name: Any = parts[depth] if isinstance(here, Mapping) else int(parts[depth])
        copy[name] = changed(here[name], depth + 1)
        return copy

    document: Mapping[str, Any] = changed(_document_with(vehicle, key), 0)
    if twin is not None:
        parts = twin
        document = changed(document, 0)
    return document


def _symmetric_twin(parts: list[str]) -> list[str] | None:
    """Return the mirror of an off-diagonal entry of a tensor: both change together."""
    if len(parts) < 3 or not parts[-3].endswith("inertia_kg_m2") or not (parts[-1].isdigit() and parts[-2].isdigit()):
        return None
    return [*parts[:-2], parts[-1], parts[-2]] if parts[-1] != parts[-2] else None
