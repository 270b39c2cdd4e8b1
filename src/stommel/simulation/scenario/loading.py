"""From a mission file to a mission: the file, its vehicle and its ocean, checked against each other."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from stommel.errors import FileError, Problem
from stommel.files.opening import beside
from stommel.files.sentences import validated
from stommel.files.toml_reader import read_toml
from stommel.mission.plan import Plan
from stommel.ocean.answers import is_profile
from stommel.ocean.ocean import Ocean
from stommel.planning.ballasting import ballasted
from stommel.simulation.scenario.checks import refuse_impossible
from stommel.simulation.scenario.mission import Mission
from stommel.simulation.scenario.scenario_file import ScenarioFile
from stommel.vehicle import Vehicle, load_vehicle

_FAULTS, _RADIO = "faults", "radio"
"""Tables of a scenario that only the software in the loop has: what breaks, and what its radio is like."""


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
    if _FAULTS in document:
        told = f"{_FAULTS}: only the software in the loop can break; fly this file with `stommel sitl`, or take it out"
        raise FileError([Problem(origin, _FAULTS, told)])
    if not isinstance(document.get(_RADIO, {}), dict):
        raise FileError([Problem(origin, _RADIO, f"{_RADIO}: must be a table")])
    # without the software in the loop nobody calls: what the radio is like changes nothing
    document = with_its_plan({key: value for key, value in document.items() if key != _RADIO}, origin, folder)
    scenario = validated(document, ScenarioFile, origin)
    if vehicle is None:
        vehicle = load_vehicle(beside(folder, scenario.vehicle))
    for key, value in scenario.changes.items():
        vehicle = vehicle.with_value(key, value)
    vehicle.require_lateral("a mission")
    if ocean is None:
        ocean = _ocean(scenario, folder)
    mission = Mission(scenario, vehicle, ocean, origin, document)
    refuse_impossible(mission)
    return replace(mission, vehicle=ballasted(mission.deployment))


def with_its_plan(document: Mapping[str, Any], origin: str, folder: Path) -> Mapping[str, Any]:
    """Return the values of a scenario's file with those of the plan that it names, if it names one.

    Raises
    ------
    FileError
        The plan cannot be read or used, or the scenario says again what its plan says.
    """
    if "plan" not in document:
        return document
    named = document["plan"]
    if not isinstance(named, str) or not named:
        raise FileError([Problem(origin, "plan", f"plan = {named!r}: must be text, the name of a plan's file")])
    path = beside(folder, named)
    plan = read_toml(path)
    validated(plan, Plan, str(path))
    again = [key for key in document if key in Plan.model_fields and key not in ("format", "name")]
    if again:
        told = f"stands here and in the plan {named}; a scenario that names a plan adds the world to it, nothing else"
        raise FileError([Problem(origin, key, f"{key}: {told}") for key in again])
    return plan | {key: value for key, value in document.items() if key != "plan"}


def _ocean(scenario: ScenarioFile, folder: Path) -> Ocean:
    choice = scenario.ocean
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
        units=choice.units,
        bounds=choice.bounds_deg,
        between=_between(scenario),
        at_rest=choice.at_rest,
        parameters=choice.parameters,
        **beyond,
    )


def _between(scenario: ScenarioFile) -> tuple[float, float] | None:
    """Times of the file that the mission needs [s since 1970-01-01 UTC]; None where it needs all of them.

    A profile has no times, and the mean of a file, where it is the climatology, is over all of them.
    """
    choice = scenario.ocean
    of_its_own = "climatology" in (choice.outside, choice.outside_time) and choice.climatology is None
    if is_profile(choice.file) or of_its_own:
        return None
    return scenario.start_seconds, scenario.end_seconds
