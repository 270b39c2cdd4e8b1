"""The whole vehicle in the loop: plant, both nodes, bus, instruments and coordinator, with its log."""

from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter, process_time

from figures.registry import Measurement, figure
from stommel.simulation.scenario.loading import load_mission
from stommel.simulation.scenario.shipped import mission_path
from stommel.sitl.log_folder import logbook_in
from stommel.sitl.system import System

NAME = "kuroshio"
_FIRST, _STEPS, _PIECES = 600, 1000, 5
"""Steps before the time is taken, and in each of the pieces that follow: dives, turns and a stay at the surface."""


@figure(unit="x", bar=1000.0, at_least=True)
def sitl_speed_up() -> Measurement:
    """Measure simulated time over processor time of the loop at 1 Hz on one core, after compilation."""
    mission = load_mission(mission_path(NAME))
    with TemporaryDirectory() as folder:
        system = System(mission, logbook_in(Path(folder), mission))
        _fly(system, _FIRST)
        times = []
        for _ in range(_PIECES):
            wall, process = perf_counter(), process_time()
            _fly(system, _STEPS)
            times.append((perf_counter() - wall, process_time() - process))
    simulated = _PIECES * _STEPS * system.plant.step
    wall, process = (sum(column) for column in zip(*times, strict=True))
    detail = {
        "by_wall": simulated / wall,
        "fastest_piece": _STEPS * system.plant.step / min(process for _, process in times),
        "steps": _PIECES * _STEPS,
        "mission": NAME,
    }
    return Measurement(simulated / process, detail)


def _fly(system: System, steps: int) -> None:
    for _ in range(steps):
        system.step()
