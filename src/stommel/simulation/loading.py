"""From a mission file to a mission: the file, its vehicle and its ocean, checked against each other."""

import tomllib
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from stommel.errors import FileError, Problem
from stommel.ocean.ocean import Ocean
from stommel.simulation.ballasting import ballasted
from stommel.simulation.checks import refuse_impossible
from stommel.simulation.mission import Mission
from stommel.simulation.mission_file import MissionFile
from stommel.vehicle import Vehicle, load_vehicle
from stommel.vehicle.messages import sentences


def load_mission(path: str | Path) -> Mission:
    """Read a mission file, its vehicle and its ocean, and check them against each other.

    Raises
    ------
    FileError
        The file cannot be read, or something in it is impossible; with the key and what is allowed.
    StommelError
        The vehicle or the ocean cannot be used.
    """
    name = str(path)
    try:
        text = Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise FileError([Problem(name, "", f"cannot be read: {error}")]) from error
    try:
        document = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise FileError([Problem(name, "", f"is not valid TOML: {error}")]) from error
    return mission_from(document, name, Path(path).parent)


def mission_from(
    document: Mapping[str, Any],
    origin: str,
    folder: Path,
    vehicle: Vehicle | None = None,
    ocean: Ocean | None = None,
) -> Mission:
    """Make a mission of a parsed file; files that it names are sought in `folder`.

    `vehicle` and `ocean`, already loaded, stand in for the file's own.
    """
    try:
        plan = MissionFile.model_validate(document)
    except ValidationError as error:
        raise FileError([Problem(origin, key, text) for key, text in sentences(error, MissionFile)]) from None
    if vehicle is None:
        beside = folder / plan.vehicle
        vehicle = load_vehicle(beside if beside.is_file() else plan.vehicle)
    for key, value in plan.changes.items():
        vehicle = vehicle.with_value(key, value)
    vehicle.require_lateral("a mission")
    if ocean is None:
        ocean = _ocean(plan, folder)
    mission = Mission(plan, vehicle, ocean, origin, document)
    refuse_impossible(mission)
    return replace(mission, vehicle=ballasted(mission))


def _ocean(plan: MissionFile, folder: Path) -> Ocean:
    choice = plan.ocean
    if choice.name is not None:
        return Ocean.analytic(choice.name, **choice.parameters)
    assert choice.file is not None
    beside = folder / choice.file
    return Ocean.open(beside if beside.is_file() else Path(choice.file), outside=choice.outside)
