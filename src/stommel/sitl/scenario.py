"""A scenario of the loop: a mission file that may also say what breaks."""

from pathlib import Path
from typing import NamedTuple

from stommel.files.toml_reader import read_toml
from stommel.simulation.scenario.loading import mission_from
from stommel.simulation.scenario.mission import Mission
from stommel.sitl.faults.fault import Fault, faults_from, refuse_late


class Scenario(NamedTuple):
    """A mission, and what breaks in it."""

    mission: Mission
    faults: tuple[Fault, ...]


def load_scenario(path: str | Path) -> Scenario:
    """Read a mission file with `[[faults]]`; one without any is a scenario in which nothing breaks.

    Raises
    ------
    FileError
        The file cannot be read, or something in it is impossible; with the key and what is allowed.
    StommelError
        The vehicle or the ocean cannot be used.
    """
    document = read_toml(path)
    faults = faults_from(document.pop("faults", []), str(path))
    mission = mission_from(document, str(path), Path(path).parent)
    refuse_late(faults, 86400.0 * mission.scenario.duration_days, str(path))
    return Scenario(mission, faults)
