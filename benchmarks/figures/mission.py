"""A mission of 20 days: how long it takes, how much faster than the sea, how much memory, how exact."""

import subprocess
import sys
from dataclasses import replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter, process_time
from typing import Any

import numpy as np

from figures.registry import Measurement, figure
from stommel.simulation.flight import Flown, fly_mission
from stommel.simulation.results.summary import summary
from stommel.simulation.scenario.loading import load_mission
from stommel.simulation.scenario.mission import Mission
from stommel.simulation.scenario.shipped import mission_path

NAME = "still_20_days"
REPEATS = 3
FINER = 10
QUIET = {
    "attitude_noise_deg": 0.0, "heading_noise_deg": 0.0, "pressure_noise_m": 0.0, "gps_noise_m": 0.0,
    "altimeter_noise_m": 0.0,
}  # fmt: skip

_MEMORY = """
import sys
from pathlib import Path
from stommel.simulation.flight import fly_mission
from stommel.simulation.scenario.loading import load_mission
from stommel.simulation.results.dataset import dataset_of, write_netcdf
from stommel.simulation.scenario.shipped import mission_path
flown = fly_mission(load_mission(mission_path(sys.argv[1])))
write_netcdf(dataset_of(flown), sys.argv[2])
peak = next(line for line in Path("/proc/self/status").read_text().splitlines() if line.startswith("VmHWM"))
print(int(peak.split()[1]) / 1024)
"""


@cache
def _timed() -> tuple[Mission, Flown, list[tuple[float, float]]]:
    """Fly once to compile and then for the clock: wall and process time of each [s]."""
    mission = load_mission(mission_path(NAME))
    flown = fly_mission(mission)
    times = []
    for _ in range(REPEATS):
        wall, process = perf_counter(), process_time()
        flown = fly_mission(mission)
        times.append((perf_counter() - wall, process_time() - process))
    return mission, flown, times


def _with_steps(mission: Mission, factor: int, *, noise: bool) -> Flown:
    """Fly the mission with `factor` times finer integration steps."""
    cut = mission.scenario.integration
    finer = {"steady_steps": factor * cut.steady_steps, "moving_steps": factor * cut.moving_steps}
    changes: dict[str, Any] = {"integration": cut.model_copy(update=finer)}
    if not noise:
        changes["sensors"] = mission.scenario.sensors.model_copy(update=QUIET)
    return fly_mission(replace(mission, scenario=mission.scenario.model_copy(update=changes)))


@cache
def _error() -> dict[str, Any]:
    """Difference to the same mission with ten times smaller steps.

    Of the integration itself without noise: with noise the two part by ticks of the clock, since a decision that falls
    one tick later shifts every later one; then depths at one time say nothing, but the distance still does.
    """
    mission, flown, _ = _timed()
    coarse, exact = (_with_steps(mission, factor, noise=False) for factor in (1, FINER))
    rows = min(len(exact.record), len(coarse.record))
    apart = np.abs(exact.record["depth"][:rows] - coarse.record["depth"][:rows])
    return {
        "depth_error_m": float(apart.max()),
        "depth_error_rms_m": float(np.sqrt(np.mean(apart**2))),
        "distance_error_percent": _percent_apart(coarse, exact),
        "distance_error_with_noise_percent": _percent_apart(flown, _with_steps(mission, FINER, noise=True)),
        "against": f"{FINER} times smaller integration steps, {len(exact.record)} rows of output, without noise",
    }


def _percent_apart(one: Flown, other: Flown) -> float:
    made_good = [summary(flown)["distance_made_good_km"] for flown in (one, other)]
    return 100.0 * abs(made_good[0] / made_good[1] - 1.0)


@figure(unit="s", bar=2.0)
def mission_20d_s() -> Measurement:
    """Measure 20 days to 200 m with output every 10 s, on one core after compilation [s of processor time]."""
    _, flown, times = _timed()
    wall, process = zip(*times, strict=True)
    detail = {
        "wall_s": min(wall),
        "process_s": min(process),
        "repeats": REPEATS,
        "outcome": flown.outcome,
        "dives": summary(flown)["dives"],
    }
    return Measurement(min(process), detail | _error())


@figure(unit="x", bar=864000.0, at_least=True)
def mission_20d_speed_up() -> Measurement:
    """Measure simulated time over processor time of the same mission; the bar is 20 days in 2 s."""
    mission, _, times = _timed()
    simulated = mission.scenario.duration_days * 86400.0
    return Measurement(
        simulated / min(process for _, process in times), {"by_wall": simulated / min(wall for wall, _ in times)}
    )


@figure(unit="MB", bar=500.0)
def mission_20d_peak_mb() -> Measurement:
    """Measure the greatest memory of a process that flies the same mission and writes it as NetCDF [MB]."""
    _timed()  # machine code of the process below comes from the cache
    with TemporaryDirectory() as folder:
        command = [sys.executable, "-c", _MEMORY, NAME, str(Path(folder) / "mission.nc")]
        found = subprocess.run(command, capture_output=True, text=True, check=True)
    return Measurement(float(found.stdout))
