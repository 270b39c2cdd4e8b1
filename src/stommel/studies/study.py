"""A study: its file, checked against its mission and vehicle, and what every run is made of."""

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import stommel
from stommel.errors import FileError, Problem
from stommel.files.opening import beside
from stommel.files.toml_reader import read_table
from stommel.ocean.analytic.catalogue import ANALYTIC
from stommel.ocean.reading.sources import paths_of
from stommel.ocean.reading.stores import files_of
from stommel.simulation.scenario.loading import load_mission
from stommel.simulation.scenario.mission import Mission
from stommel.simulation.scenario.shipped import UnknownMissionError, mission_path
from stommel.studies.errors import StudyError
from stommel.studies.keys import key_problems, target_of
from stommel.studies.kit import RunKit
from stommel.studies.sampling import run_values
from stommel.studies.study_file import StudyFile, Value
from stommel.vehicle import Vehicle, load_vehicle


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
    file = read_table(path, StudyFile)
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
        document=_plain(mission.scenario.model_dump(exclude={"format"})),
        vehicle=None if ("vehicle",) in targets else _vehicle(mission.scenario.vehicle, folder),
        folder=folder,
        origin=mission.origin,
        targets=targets,
        seed=file.seed,
        same_noise=file.same_noise,
        version=stommel.__version__,
    )
    wrong = [Problem(origin, p.key, text) for p in file.parameters for text in key_problems(p, kit)]
    if wrong:
        raise FileError(wrong)
    return Study(file, origin, _names(file, origin), kit, run_values(file))


def _mission_path(name: str, folder: Path, origin: str) -> Path:
    try:
        return mission_path(str(beside(folder, name)))
    except UnknownMissionError as error:
        raise FileError([Problem(origin, "mission", str(error))]) from None


def _vehicle(name: str, folder: Path) -> Vehicle:
    return load_vehicle(beside(folder, name))


_TAKEN = ("run", "repeat", "output", "parameter", "seed", "outcome", "failure")
"""Names that the result has anyway."""


def _names(file: StudyFile, origin: str) -> tuple[str, ...]:
    """Name every parameter: as asked, or by the last part of its key, or by all of it where that is not unique."""
    short = [_identifier(parameter.key.rsplit(".", 1)[-1]) for parameter in file.parameters]
    names = [
        parameter.name
        or (own if short.count(own) == 1 and own not in _TAKEN and not own[0].isdigit() else _identifier(parameter.key))
        for parameter, own in zip(file.parameters, short, strict=True)
    ]
    for name in names:
        if names.count(name) > 1 or name in _TAKEN:
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
    """Content of the ocean's files and of its climatology's; empty where all is analytic."""
    choice, digest = kit.document["ocean"], hashlib.sha256()
    climatology = choice["climatology"] if choice["climatology"] not in ANALYTIC else None
    sources = [source for source in (choice["file"], climatology) if source is not None]
    named = (path for source in sources for path in paths_of(source, kit.folder))
    for path in (part for whole in named for part in files_of(whole)):
        try:
            with path.open("rb") as file:
                digest.update(hashlib.file_digest(file, "sha256").digest())
        except OSError as error:
            raise StudyError(f"{path}: cannot be read: {error.strerror}") from error
    return digest.hexdigest() if sources else ""
