"""From a mission file to a mission: the file, its vehicle and its ocean, checked against each other."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from stommel.errors import FileError, Problem
from stommel.files.sentences import sentences
from stommel.files.toml_reader import read_toml
from stommel.ocean.answers import is_profile
from stommel.ocean.ocean import Ocean
from stommel.planning.ballasting import ballasted
from stommel.planning.mission import Mission
from stommel.simulation.scenario.checks import refuse_impossible
from stommel.simulation.scenario.mission_file import MissionFile
from stommel.vehicle import Vehicle, load_vehicle


def load_mission(path: str | Path) -> Mission:
    """Read a mission file, its vehicle and its ocean, and check them against each other.

    Raises
    ------
    FileError
        The file cannot be read, or something in it is impossible; with the key and what is allowed.
    StommelError
        The vehicle or the ocean cannot be used.
    """
    return mission_from(read_toml(path), str(path), Path(path).parent)


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
    beyond: dict[str, Any] = {
        "outside": choice.outside,
        "outside_time": choice.outside_time,
        "climatology": choice.climatology,
        "blend_km": choice.blend_km,
        "blend_hours": choice.blend_hours,
        "folder": folder,
    }
    if choice.name is not None:
        return Ocean.analytic(choice.name, **choice.parameters).with_outside(**beyond)
    assert choice.file is not None
    return Ocean.open(
        choice.file,
        names=choice.names,
        bounds=choice.bounds_deg,
        between=_between(plan),
        at_rest=choice.at_rest,
        parameters=choice.parameters,
        **beyond,
    )


def _between(plan: MissionFile) -> tuple[float, float] | None:
    """Times of the file that the mission needs [s since 1970-01-01 UTC]; None where it needs all of them.

    A profile has no times, and the mean of a file, where it is the climatology, is over all of them.
    """
    choice = plan.ocean
    of_its_own = "climatology" in (choice.outside, choice.outside_time) and choice.climatology is None
    if is_profile(choice.file) or of_its_own:
        return None
    return plan.start_seconds, plan.end_seconds
