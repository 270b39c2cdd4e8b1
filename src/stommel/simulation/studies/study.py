"""A study: its file, checked against its mission and vehicle, and what every run is made of."""

import copy
import difflib
import hashlib
import json
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from importlib import resources
from pathlib import Path
from typing import Any

from pydantic import ValidationError

import stommel
from stommel.errors import FileError, Problem, StommelError
from stommel.simulation.mission import Mission, load_mission
from stommel.simulation.mission_file import MissionFile
from stommel.simulation.studies.errors import StudyError
from stommel.simulation.studies.sampling import run_seed, run_values, sweep_values
from stommel.simulation.studies.study_file import Parameter, StudyFile, Value
from stommel.vehicle import Vehicle, load_vehicle
from stommel.vehicle.messages import sentences

Path_ = tuple[str, ...]
"""Where a parameter lies in the mission's document."""


@dataclass(frozen=True)
class RunKit:
    """What a worker needs to fly any run of the study; it is sent once."""

    document: Mapping[str, Any] = field(repr=False)
    """Every value of the mission file, also those left out there."""
    vehicle: Vehicle | None = field(repr=False)
    """None: each run names its own."""
    folder: Path
    """Where files that the mission names are sought."""
    origin: str
    """Mission file, for messages."""
    targets: tuple[Path_, ...]
    """Where the parameters lie."""
    seed: int
    same_noise: bool
    version: str
    """Of stommel."""

    def document_of(self, run: int, values: Sequence[Value]) -> dict[str, Any]:
        """Return the mission document of one run."""
        document = copy.deepcopy(dict(self.document))
        if ("seed",) not in self.targets:
            document["seed"] = run_seed(self.seed, 0 if self.same_noise else run)
        for target, value in zip(self.targets, values, strict=True):
            put(document, target, value)
        return document


@dataclass(frozen=True)
class Study:
    """A study that has been checked, ready to be run."""

    file: StudyFile
    origin: str
    names: tuple[str, ...]
    """Names of the parameters in the result."""
    kit: RunKit
    values: Sequence[tuple[Value, ...]] = field(repr=False)
    """Of the parameters, for every run."""

    def fingerprint(self) -> dict[str, str]:
        """Digest of everything that the runs depend on, by part; outputs and names only choose from the runs."""
        kit, file = self.kit, self.file
        design = [parameter.model_dump(exclude={"name"}) for parameter in file.parameters]
        vehicle = None if kit.vehicle is None else kit.vehicle.document
        return {
            "parameters": _digest(design),
            "kind": file.kind,
            "runs": str(file.runs),
            "seed": f"{file.seed}{', same noise' if file.same_noise else ''}",
            "mission": _digest(kit.document),
            "vehicle": _digest(vehicle),
            "ocean file": _file_digest(kit),
            "version of stommel": kit.version,
        }


def load_study(path: str | Path) -> Study:
    """Read a study file with its mission and vehicle, and check them against each other.

    Raises
    ------
    FileError
        The file cannot be read, or something in it is impossible; with the key and what is allowed.
    StommelError
        The mission, its vehicle or its ocean cannot be used.
    """
    origin = str(path)
    try:
        document = tomllib.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        text = getattr(error, "strerror", None) or str(error)
        raise FileError([Problem(origin, "", f"cannot be read: {text}")]) from error
    except tomllib.TOMLDecodeError as error:
        raise FileError([Problem(origin, "", f"is not valid TOML: {error}")]) from error
    try:
        file = StudyFile.model_validate(document)
    except ValidationError as error:
        found = sentences(error, StudyFile)
        raise FileError([Problem(origin, key, text.replace("from_", "from")) for key, text in found]) from None
    mission = load_mission(_mission_path(file.mission, Path(path).parent, origin))
    return study_of(file, origin, mission)


def study_of(file: StudyFile, origin: str, mission: Mission) -> Study:
    """Make a study of its file and the mission that the runs start from.

    Raises
    ------
    FileError
        A parameter is unknown, or the mission or vehicle allows none of its values.
    """
    folder = Path(mission.origin).parent.resolve()
    targets = tuple(target_of(parameter.key) for parameter in file.parameters)
    kit = RunKit(
        document=_plain(mission.plan.model_dump(exclude={"format"})),
        vehicle=None if ("vehicle",) in targets else _vehicle(mission.plan.vehicle, folder),
        folder=folder,
        origin=mission.origin,
        targets=targets,
        seed=file.seed,
        same_noise=file.same_noise,
        version=stommel.__version__,
    )
    wrong = [Problem(origin, p.key, text) for p in file.parameters for text in _problems(p, kit)]
    if wrong:
        raise FileError(wrong)
    return Study(file, origin, _names(file, origin), kit, run_values(file))


def shipped_missions() -> tuple[str, ...]:
    """Names of the missions that come with stommel."""
    folder = resources.files("stommel.simulation") / "missions"
    return tuple(sorted(entry.name.removesuffix(".toml") for entry in folder.iterdir() if entry.name.endswith(".toml")))


def _mission_path(name: str, folder: Path, origin: str) -> Path:
    if (folder / name).is_file():
        return folder / name
    if name in shipped_missions():
        return Path(str(resources.files("stommel.simulation") / "missions" / f"{name}.toml"))
    text = f"mission = {name!r}: is neither a file beside the study nor a shipped mission: "
    raise FileError([Problem(origin, "mission", text + ", ".join(shipped_missions()))])


def _vehicle(name: str, folder: Path) -> Vehicle:
    beside = folder / name
    return load_vehicle(beside if beside.is_file() else name)


def target_of(key: str) -> Path_:
    """Where the parameter `key` of a study lies in the document of a mission."""
    space, rest = key.split(".", 1)
    if space == "vehicle":
        return "changes", rest
    if space == "mission":
        return tuple(rest.split("."))
    if space == "sensors":
        return "sensors", *rest.split(".")
    return ("ocean", rest) if rest in ("name", "file", "outside") else ("ocean", "parameters", rest)


def put(document: dict[str, Any], target: Path_, value: Value) -> None:
    """Set one value of a mission document."""
    here: Any = document
    for part in target[:-1]:
        here = here[int(part)] if isinstance(here, list) else here[part]
    last: Any = int(target[-1]) if isinstance(here, list) else target[-1]
    before = here.get(last) if isinstance(here, dict) else here[last]
    whole = isinstance(before, int) and not isinstance(before, bool | float)
    here[last] = int(value) if whole and isinstance(value, float) and value.is_integer() else value


def _problems(parameter: Parameter, kit: RunKit) -> Iterator[str]:
    """What is wrong with one parameter: an unknown key, or values that the mission file would refuse."""
    target, key = target_of(parameter.key), parameter.key
    known = _known(target, kit)
    if known is not None and target[-1 if target[0] in ("changes", "ocean") else slice(None)] not in known:
        space, rest = key.split(".", 1)
        words = [word if isinstance(word, str) else ".".join(word) for word in known]
        words = [word.removeprefix("sensors.") for word in words] if space == "sensors" else words
        near = difflib.get_close_matches(rest, words, 1, 0.5)
        hint = f"; did you mean {space}.{near[0]}?" if near else ""
        listed = f" Known: {', '.join(words)}" if len(words) <= 30 else ""
        yield f"parameters: key = {key!r}: {_whose(space, kit)} has no such number{hint}{listed}"
        return
    for value in _representatives(parameter):
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


def _known(target: Path_, kit: RunKit) -> list[Any] | None:
    """Keys that are allowed where `target` lies; None if that depends on another parameter."""
    if target[0] == "changes":
        from stommel.vehicle import stated_numbers  # noqa: PLC0415

        return None if kit.vehicle is None else [key for key, value, _ in stated_numbers(kit.vehicle)]
    if target[:2] == ("ocean", "parameters"):
        from stommel.ocean.analytic import ANALYTIC  # noqa: PLC0415

        if ("ocean", "name") in kit.targets:
            return None
        name = kit.document["ocean"]["name"]
        return list(ANALYTIC[name].model_fields) if name is not None else []
    if target[0] == "ocean":
        return ["name", "file", "outside"]
    return [path for path in _leaves(kit.document) if path[0] != "sensors" or target[0] == "sensors"]


def _leaves(here: Any, path: Path_ = ()) -> Iterator[Path_]:
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
    import numpy as np  # noqa: PLC0415

    from stommel.simulation.studies.sampling import quantiles  # noqa: PLC0415

    return [float(quantiles(parameter, np.array([0.5]))[0])]


def _try(kit: RunKit, target: Path_, value: Value) -> None:
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
        MissionFile.model_validate(document)
    except ValidationError as error:
        raise StudyError(sentences(error, MissionFile)[0][1]) from None


def _names(file: StudyFile, origin: str) -> tuple[str, ...]:
    """Name every parameter: as asked, or by the last part of its key, or by all of it where that is not unique."""
    short = [_identifier(parameter.key.rsplit(".", 1)[-1]) for parameter in file.parameters]
    names = [
        parameter.name or (own if short.count(own) == 1 and not own[0].isdigit() else _identifier(parameter.key))
        for parameter, own in zip(file.parameters, short, strict=True)
    ]
    for name in names:
        if names.count(name) > 1 or name in ("run", "repeat", "output", "parameter"):
            text = f"parameters: name = {name!r}: is taken; give the parameter another name"
            raise FileError([Problem(origin, "parameters", text)])
    return tuple(names)


def _identifier(key: str) -> str:
    return "".join(letter if letter.isalnum() else "_" for letter in key)


def _plain(value: Any) -> Any:
    """Tables and lists only, as TOML gives them."""
    if isinstance(value, Mapping):
        return {key: _plain(inner) for key, inner in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(inner) for inner in value]
    return value


def _digest(value: Any) -> str:
    return hashlib.sha256(json.dumps(value, sort_keys=True, default=str).encode()).hexdigest()


def _file_digest(kit: RunKit) -> str:
    name = kit.document["ocean"]["file"]
    if name is None:
        return ""
    beside = kit.folder / name
    try:
        with (beside if beside.is_file() else Path(name)).open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError as error:
        raise StudyError(f"{name}: cannot be read: {error.strerror}") from error
