"""The vehicle's software as it runs on a small board: plain Python, on ports."""

import os
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

from figures.registry import Measurement, figure
from stommel.onboard.coordination.coordinator import Coordinator
from stommel.onboard.coordination.situation import OperatorRequests
from stommel.simulation.scenario.loading import load_mission
from stommel.simulation.scenario.shipped import mission_path
from stommel.sitl.log_folder import logbook_in
from stommel.sitl.stand_in import Terminals
from stommel.sitl.system import System

PROGRAM = Path(sys.executable).with_name("stommel")
NAME = "kuroshio"
_FIRST, _STEPS = 600, 1000
_RAN = 2
"""Time for which the software is told to run [s]: two decisions."""


@figure(unit="ms", bar=5.0)
def vehicle_decision_ms() -> Measurement:
    """Measure one decision with all frames and bytes of its second, in plain Python with the log; mean of a dive."""
    mission = load_mission(mission_path(NAME))
    with TemporaryDirectory() as folder:
        system = System(mission)
        plain = Coordinator(system.coordinator.settings, 0.0, logbook=logbook_in(Path(folder), mission))
        plain.adopt(system.plant.setup.orders)
        plain.request(OperatorRequests(start=True))
        system.coordinator = plain
        times: list[float] = []
        step = plain.step

        def timed(*arguments: object) -> object:
            began = perf_counter()
            answer = step(*arguments)  # type: ignore[arg-type]
            times.append(perf_counter() - began)
            return answer

        plain.step = timed  # type: ignore[method-assign, assignment]
        for _ in range(_FIRST + _STEPS):
            system.step()
    chosen = times[_FIRST:]
    detail = {"greatest_ms": 1e3 * max(chosen), "decisions": len(chosen)}
    return Measurement(1e3 * sum(chosen) / len(chosen), detail)


@figure(unit="s", bar=2.0)
def vehicle_run_start_s() -> Measurement:
    """Measure `stommel vehicle run` as a process from its start to its end, less the time that it was told to run."""
    with TemporaryDirectory() as name:
        folder = Path(name)
        config = _configured(folder)
        terminals = Terminals(folder / "ports", ("compass", "gnss", "radio"))
        try:
            seconds = [_run(config) for _ in range(4)]
        finally:
            terminals.close()
    return Measurement(min(seconds[1:]) - _RAN, {"runs": len(seconds) - 1, "first_s": seconds[0] - _RAN})


def _configured(folder: Path) -> Path:
    subprocess.run([PROGRAM, "vehicle", "config", "zju", "--output", folder], check=True, stdout=subprocess.DEVNULL)
    path = folder / "CONFIG.toml"
    text = path.read_text(encoding="utf-8").replace('interface = "socketcan"', 'interface = "virtual"')
    for k, port in enumerate(("compass", "gnss", "radio")):
        text = text.replace(f"/dev/ttyUSB{k}", str(folder / "ports" / port))
    path.write_text(text, encoding="utf-8")
    return path


def _run(config: Path) -> float:
    began = perf_counter()
    subprocess.run(
        [PROGRAM, "vehicle", "run", config, "--seconds", str(_RAN), "--json"],
        check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=os.environ,
    )  # fmt: skip
    return perf_counter() - began
