"""Flying a mission in the loop, from its start until it ends."""

from collections.abc import Callable, Sequence

from stommel.onboard.coordination.logbook.logbook import Logbook
from stommel.simulation.flight import Flown
from stommel.sitl.real_time import Pace
from stommel.sitl.system import System

Watcher = Callable[[System], None]
"""Looks on after each step, and changes nothing."""


def fly(
    system: System, *, logbook: Logbook | None = None, watchers: Sequence[Watcher] = (), pace: Pace | None = None
) -> Flown:
    """Fly until the mission is complete, its time is over, or it cannot go on.

    Parameters
    ----------
    system
        Plant and software, before their first step.
    logbook
        The system's; it is whole when this returns or is interrupted.
    watchers
        Are called after each step.
    pace
        Holds the loop back to a multiple of real time; as fast as it goes if left out.
    """
    plant = system.plant
    if pace is not None:
        system.air.wait = pace.wait
    try:
        while system.running:
            if pace is not None:
                pace.wait(plant.time)
            system.step()
            for watch in watchers:
                watch(system)
    finally:
        if logbook is not None:
            logbook.sync(plant.time)
    return plant.flown()
