"""A scenario of the loop: a mission file that may also say what breaks, and what the radio is like."""

from pathlib import Path
from typing import NamedTuple

from stommel.files.toml_reader import read_toml
from stommel.link.channel.settings import ChannelSettings
from stommel.simulation.scenario.loading import mission_from
from stommel.simulation.scenario.mission import Mission
from stommel.sitl.faults.fault import Fault, faults_from, refuse_late
from stommel.sitl.radio.radio_table import channel_from


class Scenario(NamedTuple):
    """A mission, what breaks in it, and the air of its radio."""

    mission: Mission
    faults: tuple[Fault, ...]
    radio: ChannelSettings


def load_scenario(path: str | Path) -> Scenario:
    """Read a mission file with `[[faults]]` and `[radio]`; one without them is a calm day on which nothing breaks.

    Raises
    ------
    FileError
        The file cannot be read, or something in it is impossible; with the key and what is allowed.
    StommelError
        The vehicle or the ocean cannot be used.
    """
    document = read_toml(path)
    faults = faults_from(document.pop("faults", []), str(path))
    radio = channel_from(document.pop("radio", {}), str(path))
    mission = mission_from(document, str(path), Path(path).parent)
    refuse_late(faults, 86400.0 * mission.scenario.duration_days, str(path))
    return Scenario(mission, faults, radio)
