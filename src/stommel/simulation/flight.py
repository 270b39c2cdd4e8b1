"""Flying a mission, and what comes out of it as plain arrays."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from stommel.simulation.mission_loop import OUTCOMES, RUNNING, fly
from stommel.simulation.open_loop import Controller, pieces_under
from stommel.simulation.plant.parameters import Plant
from stommel.simulation.scenario.mission import Mission
from stommel.simulation.setup import Setup, prepare, written

Progress = Callable[[float], None]
"""Called with the share of the mission that is flown."""

_PIECE_DAYS = 0.5
"""A mission is flown in pieces of so many days, with progress and interruption between them."""


@dataclass(frozen=True)
class Flown:
    """What came out of a mission, as plain arrays; `stommel.simulation.results` makes a Dataset of it."""

    mission: Mission
    record: NDArray[np.void]
    """Rows over time, `stommel.simulation.log.ROW`."""
    samples: NDArray[np.void]
    """Of the CTD, `SAMPLE`."""
    surfacings: NDArray[np.void]
    """`SURFACING`."""
    events: NDArray[np.void]
    """`EVENT`."""
    outcome: str
    """How it ended."""
    plant: Plant
    distance_through_water: float
    """Along the path [m]."""
    waypoints_reached: int
    """By the software's own account."""


def fly_mission(mission: Mission, *, controller: Controller | None = None, progress: Progress | None = None) -> Flown:
    """Fly a mission from its start until it is complete, its time is over, or it cannot go on.

    The same mission, seed and version give the same bytes.

    Parameters
    ----------
    mission
        From `stommel.load_mission`.
    controller
        Decides in place of the vehicle's own software, with the signature of `stommel.control.decision.decide`: memory,
        orders, readings and time in, commands out. A function that Numba compiled is fast; any other Python callable
        will do. `stommel.control.own_laws.with_laws` replaces one law of the vehicle's own.
    progress
        Called now and then with the share that is flown.

    Raises
    ------
    StommelError
        The vehicle cannot fly the dives that the plan asks for.
    """
    setup = prepare(mission)
    piece = max(1, round(_PIECE_DAYS * 86400.0 / setup.loop.control_step))
    piece_of = _own_software if controller is None else pieces_under(controller)
    outcome, done = RUNNING, 0
    while done < setup.ticks and outcome == RUNNING:
        until = min(setup.ticks, done + piece)
        outcome = piece_of(setup, done, until)
        done = until
        if progress is not None:
            progress(done / setup.ticks)
    return flown_of(mission, setup, outcome)


def _own_software(setup: Setup, first: int, last: int) -> int:
    return fly(*setup.arguments, first, last)


def flown_of(mission: Mission, setup: Setup, outcome: int) -> Flown:
    """Return what a setup has flown so far."""
    log = written(setup.log)
    speeds = np.linalg.norm(np.stack([log.record[name] for name in ("u", "v", "w")], axis=-1), axis=1)
    return Flown(
        mission=mission,
        record=log.record,
        samples=log.samples,
        surfacings=log.surfacings,
        events=log.events,
        outcome=OUTCOMES[outcome],
        plant=setup.equipment.plant,
        distance_through_water=float(speeds.sum() * mission.scenario.output_every_s),
        waypoints_reached=int(setup.memory.waypoint),
    )
