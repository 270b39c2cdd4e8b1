"""The simulated vehicle's disk: a folder of ours, which is not forced to the real disk at each sync."""

from pathlib import Path

from stommel.files.folder_storage import FolderFile, FolderStorage
from stommel.messages.database import database_hash
from stommel.onboard.coordination.logbook.framing import LogIdentity
from stommel.onboard.coordination.logbook.logbook import Logbook, LogSettings
from stommel.simulation.scenario.mission import Mission
from stommel.version import __version__


class SimulatedFile(FolderFile):
    """A file that is on the simulated disk as soon as it is written."""

    def sync(self) -> None:
        """Return at once: at a thousand times real time the real disk would be asked hundreds of times a second."""


class SimulatedDisk(FolderStorage):
    """A folder that outlives the program, but not a loss of our power."""

    def create(self, name: str) -> SimulatedFile:
        """Begin a new file; one that is there already is an OSError."""
        return SimulatedFile(self._folder / name)

    def _sync_names(self) -> None:
        """Names need no sync either."""


def logbook_in(folder: Path, mission: Mission) -> Logbook:
    """Begin the log of a vehicle's software in a folder; logs that are there already stay.

    Nothing in it tells of the machine or of the hour: the same mission and seed give the same bytes.
    """
    start = mission.scenario.start_time.timestamp()
    identity = LogIdentity(__version__, database_hash(), mission.vehicle.name, start)
    return Logbook(SimulatedDisk(folder), LogSettings(), identity, 0.0, lambda t: start + t)
