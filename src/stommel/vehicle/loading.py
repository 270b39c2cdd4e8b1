"""Reading vehicle files, the built-in ones and the user's."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from importlib import resources
from pathlib import Path
from typing import Any

from stommel.errors import FileError, Problem, StommelError
from stommel.files.opening import TOML_MIB, names_file, read_text
from stommel.files.provenance import NOT_STATED, Provenance, check_ranges, numbers, separate
from stommel.files.sentences import validated
from stommel.files.toml_reader import parse_toml
from stommel.vehicle.checks import problems
from stommel.vehicle.dotted_keys import no_such_number, number_at, with_default, with_number
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
    trimmed_for_kg_m3: float | None = None
    """Density in which the vehicle was trimmed neutral before a mission; None: that of its file's water."""

    @property
    def name(self) -> str:
        """Name of the vehicle."""
        return self.description.name

    @property
    def neutral_density_kg_m3(self) -> float:
        """Density of the water in which the vehicle, not compressed, is neutral with no ballast volume."""
        file = self.description.water.density_kg_m3
        return file if self.trimmed_for_kg_m3 is None else self.trimmed_for_kg_m3

    def trimmed_for(self, density_kg_m3: float) -> "Vehicle":
        """Return this vehicle with weights or foam added until it is neutral in water of a density; its file stays."""
        return replace(self, trimmed_for_kg_m3=density_kg_m3)

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
        self.value(key)  # refuses an unknown key
        document = with_number(self._filled(key), key, value)
        kept = {known: origin for known, origin in self.provenance.items() if known != key}  # not its source's any more
        return replace(
            self, description=_described(document, self.origin), document=document, provenance=kept, builtin=None
        )

    def value(self, key: str) -> float:
        """Number at the dotted `key`, in the file's unit.

        Raises
        ------
        FileError
            The key is unknown or not a number.
        """
        found = number_at(self._filled(key), key)
        if found is None:
            text = no_such_number(self.document, key, self.name)
            raise FileError([Problem(self.origin, key, text)])
        return found

    def _filled(self, key: str) -> Mapping[str, Any]:
        """The file's values, with the default of the field at `key` where the file leaves it out."""
        return with_default(self.document, self.description.model_dump(exclude_none=True), key)

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
        No built-in vehicle has this name, and it is not that of a file.
    FileError
        The file cannot be read, or is not a possible vehicle; the error lists every problem with its key and what is
        allowed.
    """
    name = str(name_or_path)
    text = vehicle_text(name)
    if name in builtin_names():
        return replace(vehicle_from_text(text, f"{name}.toml"), builtin=name)
    return vehicle_from_text(text, name)


def vehicle_text(name_or_path: str | Path) -> str:
    """Text of the file of a vehicle that `load_vehicle` would load.

    Raises
    ------
    UnknownVehicleError
        No built-in vehicle has this name, and it is not that of a file.
    FileError
        The file cannot be read.
    """
    name = str(name_or_path)
    if name in builtin_names():
        return builtin_text(name)
    if not names_file(name):
        raise UnknownVehicleError(
            f"vehicle {name!r} is neither a built-in vehicle nor a file; built-in: {', '.join(builtin_names())}"
        )
    return read_text(name, TOML_MIB)


def vehicle_from_text(text: str, origin: str) -> Vehicle:
    """Parse and validate the text of a vehicle file; `origin` names it in messages.

    Raises
    ------
    FileError
        As `load_vehicle`.
    """
    document, provenance = separate(parse_toml(text, origin), origin)
    description = _described(document, origin)
    check_ranges(document, provenance, origin)
    return Vehicle(description, origin, document, provenance)


def stated_numbers(vehicle: Vehicle) -> list[tuple[str, Any, Provenance]]:
    """Every number of the file with its dotted key and origin, in the order of the file."""
    return [(key, value, vehicle.provenance_of(key)) for key, value in numbers(vehicle.document) if key != "format"]


def _described(document: Mapping[str, Any], origin: str) -> VehicleFile:
    description = validated(document, VehicleFile, origin)
    wrong = [Problem(origin, key, sentence) for key, sentence in problems(description)]
    if wrong:
        raise FileError(wrong)
    return description
