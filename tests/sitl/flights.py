"""Short flights in the loop, and what they leave behind."""

import hashlib
from pathlib import Path

from stommel.simulation.flight import Flown
from stommel.simulation.scenario.mission import Mission
from stommel.sitl.flight import fly
from stommel.sitl.log_folder import logbook_in
from stommel.sitl.separate_nodes import SeparateNodes
from stommel.sitl.system import System


def flown_with_log(mission: Mission, folder: Path, *, separate: bool = False) -> Flown:
    """Fly with a log in a folder."""
    logbook = logbook_in(folder, mission)
    system = System(mission, logbook)
    if not separate:
        return fly(system, logbook=logbook)
    with SeparateNodes(system):
        return fly(system, logbook=logbook)


def digest(folder: Path) -> str:
    """Of all names and bytes in a folder."""
    told = hashlib.sha256()
    for path in sorted(folder.iterdir()):
        told.update(path.name.encode() + path.read_bytes())
    return told.hexdigest()
