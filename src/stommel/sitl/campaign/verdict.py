"""What became of a flight with faults: the rules that every flight must keep, whatever is broken."""

from math import isfinite
from typing import NamedTuple

from stommel.messages.database import COORDINATOR, MOTION
from stommel.messages.log.names import log_name
from stommel.messages.log.reader import read_log
from stommel.onboard.coordination.executive import State
from stommel.onboard.execution.motion_node import BLOWING
from stommel.simulation.mission_loop import LOST, NOT_FINITE
from stommel.sitl.faults.disk import MemoryDisk
from stommel.sitl.system import System

AT_SURFACE = 3.0
"""True depth at which a vehicle counts as surfaced [m]."""
RATING_MARGIN, RATING_PATIENCE = 10.0, 60.0
"""How far below the hull's rating [m], and for how long [s], it may be without the last reaction: sensors err, and
failsafes wait before they believe them."""

PASSED, UNSURVIVABLE, FAILED = "passed", "unsurvivable", "failed"


class Verdict(NamedTuple):
    """What became of a flight."""

    verdict: str
    """`PASSED`, `UNSURVIVABLE` or `FAILED`."""
    why: str
    """What rule it broke, in words; of an unsurvivable one the name of its combination first."""
    ending: str
    """How it ended, in words."""


def is_aborting(system: System) -> bool:
    """Whether coordinator or motion node bring the vehicle up."""
    view, runs = system.coordinator.view, system.inject.runs
    if runs(MOTION) and system.motion_mode in BLOWING:
        return True
    return runs(COORDINATOR) and view is not None and view.executive.state in (State.ABORT, State.ASCEND)


class Watch:
    """Looks at each step of a flight for what must never be; `broken` says what was, the first in words."""

    def __init__(self, system: System) -> None:
        self._system = system
        self._deep_since: float | None = None
        self.broken = ""

    def look(self) -> None:
        """Look at the step that has passed."""
        system = self._system
        plant, outputs, view = system.plant, system.outputs, system.coordinator.view
        if outputs.pump > 0.0 and outputs.valve > 0.0:
            self._say("pump and valve work against each other")
        if view is not None and not isfinite(view.commands.V_b + view.commands.r_px + view.commands.steering):
            self._say(f"commands that are no numbers: {view.commands}")
        runs = system.inject.runs
        powerless = not (runs(COORDINATOR) or runs(MOTION))  # nobody is left who could react
        if plant.depth <= plant.setup.equipment.hull.rating + RATING_MARGIN or is_aborting(system) or powerless:
            self._deep_since = None
        elif self._deep_since is None:
            self._deep_since = plant.time
        elif plant.time - self._deep_since > RATING_PATIENCE:
            self._say(f"at {plant.depth:.0f} m, deeper than the hull's rating, without the last reaction")

    def _say(self, words: str) -> None:
        self.broken = self.broken or f"{words}, at {self._system.plant.time:.0f} s"


def ending_of(system: System) -> str:
    """How it ended, in words."""
    plant, view, mode = system.plant, system.coordinator.view, system.motion_mode
    words = "coordinator never spoke" if view is None else view.executive.words
    if not system.inject.runs(COORDINATOR):
        words = "coordinator without power"
    return (
        f"{plant.ending}, at {plant.depth:.1f} m; {words}; motion node {mode.value if mode else 'elsewhere'}; "
        f"oil {1e6 * plant.oil:.0f} ml, leaked {1e6 * float(plant.setup.world['leaked']):.0f} ml, "
        f"{1e6 * plant.spare(plant.depth):+.0f} ml to spare"
    )


def wrong_end(system: System) -> str:
    """What is wrong with where it ended; empty if nothing is."""
    plant = system.plant
    if plant.outcome in (LOST, NOT_FINITE):
        return plant.ending
    if plant.depth <= AT_SURFACE:
        return ""
    if not is_aborting(system):
        return f"ends at {plant.depth:.0f} m, and is not coming up"
    if plant.spare(plant.depth) <= 0.0:
        return f"ends at {plant.depth:.0f} m in the last reaction, and sinks"
    return ""


def wrong_log(disk: MemoryDisk, committed: int) -> str:
    """What is wrong with the log; empty if each record that was committed reads back. `committed` counts them.

    A full disk makes the logbook remove files that matter less; their records count as they were.
    """
    found = 0
    for name, content in (*disk.files.items(), *disk.removed):
        if log_name(name) is None:
            continue
        read = read_log(bytes(content.data), name)
        if read.offset < content.synced:
            return f"log {name}: {read.verdict}, but {content.synced} bytes were committed"
        if read.missing:
            return f"log {name}: {read.missing} records are missing between others"
        found += read.valid_records
    return f"log: {committed} records were committed, {found} read back" if found < committed else ""
