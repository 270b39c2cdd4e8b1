"""Keys of parameters: where they lie in the document of a mission, and whether they can be changed."""

import copy
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from stommel.errors import FileError, StommelError
from stommel.files.nearest import did_you_mean
from stommel.files.sentences import validated
from stommel.ocean.analytic.catalogue import ANALYTIC
from stommel.ocean.analytic.profile import ProfileOcean
from stommel.ocean.answers import is_profile
from stommel.simulation.scenario.scenario_file import ScenarioFile
from stommel.simulation.scenario.world_tables import OceanChoice
from stommel.studies.errors import StudyError
from stommel.studies.kit import RunKit, Target, put
from stommel.studies.sampling import quantiles, sweep_values
from stommel.studies.study_file import Parameter, Value
from stommel.vehicle import stated_numbers

OCEAN_KEYS = tuple(key for key in OceanChoice.model_fields if key != "parameters")
"""Keys of the table [ocean] beside the numbers of an analytic ocean."""


def target_of(key: str) -> Target:
    """Where the parameter `key` of a study lies in the document of a mission."""
    space, rest = key.split(".", 1)
    if space == "vehicle":
        return "changes", rest
    if space == "mission":
        return tuple(rest.split("."))
    if space == "sensors":
        return "sensors", *rest.split(".")
    return ("ocean", rest) if rest in OCEAN_KEYS else ("ocean", "parameters", rest)


def key_problems(parameter: Parameter, kit: RunKit) -> Iterator[str]:
    """What is wrong with one parameter: an unknown key, or values that the mission file would refuse."""
    target, key = target_of(parameter.key), parameter.key
    known = _known(target, kit)
    if known is not None and target[-1 if target[0] in ("changes", "ocean") else slice(None)] not in known:
        space, rest = key.split(".", 1)
        words = [word if isinstance(word, str) else ".".join(word) for word in known]
        words = [word.removeprefix("sensors.") for word in words] if space == "sensors" else words
        hint = did_you_mean(rest, words, f"{space}.").removesuffix(";")
        listed = f" Known: {', '.join(words)}" if len(words) <= 30 else ""
        yield f"parameters: key = {key!r}: {_whose(space, kit)} has no such number{hint}{listed}"
        return
    values = _representatives(parameter)
    if _whole(target, kit) and (parameter.distribution is not None or any(_fraction(value) for value in values)):
        yield f"parameters: {key}: is a whole number; change it in a sweep, such as values = [1, 2]"
        return
    for value in values:
        try:
            _try(kit, target, value)
        except StommelError as error:
            yield f"parameters: {key} = {value!r}: {str(error).splitlines()[0]}"
            return


def _whose(space: str, kit: RunKit) -> str:
    if space == "vehicle":
        return kit.vehicle.origin if kit.vehicle is not None else "the vehicle"
    if space == "ocean":
        return f"ocean {kit.document['ocean']['name'] or kit.document['ocean']['file']!r}"
    return "a mission file" if space == "mission" else "table [sensors] of a mission file"


def _known(target: Target, kit: RunKit) -> list[Any] | None:
    """Keys that are allowed where `target` lies; None if that depends on another parameter."""
    if target[0] == "changes":
        return None if kit.vehicle is None else [key for key, value, _ in stated_numbers(kit.vehicle)]
    if target[:2] == ("ocean", "parameters"):
        if ("ocean", "name") in kit.targets:
            return None
        return [*_numbers_of(kit.document["ocean"]), *OCEAN_KEYS]
    if target[0] == "ocean":
        return list(OCEAN_KEYS)
    return [path for path in _leaves(kit.document) if path[0] != "sensors" or target[0] == "sensors"]


def _numbers_of(ocean: dict[str, Any]) -> list[str]:
    """Names of the numbers of an analytic ocean or of a profile's; gridded files have none."""
    if ocean["name"] is not None:
        return list(ANALYTIC[ocean["name"]].model_fields)
    profile = is_profile(ocean["file"])
    return list(ProfileOcean.model_fields) if profile else []


def _whole(target: Target, kit: RunKit) -> bool:
    """Whether a whole number of the mission file stands there; the seeds and counts among them."""
    if target[0] in ("changes", "ocean"):
        return False
    here: Any = kit.document
    for part in target:
        here = here[int(part)] if isinstance(here, list) else here[part]
    return isinstance(here, int) and not isinstance(here, bool)


def _fraction(value: Value) -> bool:
    return isinstance(value, float) and not value.is_integer()


def _leaves(here: Any, path: Target = ()) -> Iterator[Target]:
    """Paths of everything in a document that is neither table nor list."""
    if path and path[0] in ("changes", "ocean", "name"):
        return
    if isinstance(here, dict):
        for key, value in here.items():
            yield from _leaves(value, (*path, key))
    elif isinstance(here, list):
        for i, value in enumerate(here):
            yield from _leaves(value, (*path, str(i)))
    else:
        yield path


def _representatives(parameter: Parameter) -> Sequence[Value]:
    """Values to try: all of a sweep, the median of a distribution."""
    if parameter.distribution is None:
        return sweep_values(parameter)

    return [float(quantiles(parameter, np.array([0.5]))[0])]


def _try(kit: RunKit, target: Target, value: Value) -> None:
    """Refuse a value that the mission file or the vehicle file does not allow, whatever the others are."""
    if target[0] == "changes":
        if isinstance(value, str | bool):
            raise StudyError("must be a number")
        if kit.vehicle is not None:
            kit.vehicle.with_value(target[1], value)
        return
    if target[:2] == ("ocean", "parameters"):
        return
    document = copy.deepcopy(dict(kit.document))
    put(document, target, value)
    try:
        validated(document, ScenarioFile, kit.origin)
    except FileError as error:
        raise StudyError(error.problems[0].message) from None
