"""How well a study uses two workers, and that neither workers nor an interruption change its result."""

import importlib
import os
import signal
import subprocess
import sys
import tempfile
from pathlib import Path
from time import perf_counter, sleep

from figures.registry import Measurement, figure
from stommel.simulation.scenario.shipped import mission_path
from stommel.studies.flight import fly_run
from stommel.studies.run import journal_of, run_study
from stommel.studies.running import cores
from stommel.studies.study import load_study

RUNS = 1000
ROUNDS = 2
QUIET = 0.02
"""Share of the machine's processor time that others may take from a measurement."""

STUDY = f"""
name = "one-day missions"
mission = "one_day.toml"
kind = "monte_carlo"
runs = {RUNS}
[[parameters]]
key = "mission.dives.pitch_deg"
distribution = "uniform"
from = 30
to = 40
"""


def _study_file(folder: Path) -> Path:
    text = mission_path("still_20_days").read_text(encoding="utf-8")
    assert "duration_days = 20\n" in text
    (folder / "one_day.toml").write_text(text.replace("duration_days = 20\n", "duration_days = 1\n"), encoding="utf-8")
    file = folder / "study.toml"
    file.write_text(STUDY, encoding="utf-8")
    return file


def _machine_busy() -> float:
    """Processor time that all processes of the machine have taken [s]; zero where the system does not tell."""
    try:
        fields = Path("/proc/stat").read_text(encoding="ascii").splitlines()[0].split()[1:9]
    except OSError:
        return 0.0
    user, nice, system, _idle, _wait, interrupts, soft, stolen = map(int, fields)
    return float(user + nice + system + interrupts + soft + stolen) / os.sysconf("SC_CLK_TCK")


def _own_busy() -> float:
    """Processor time of this process and of its children that have ended [s]."""
    return sum(os.times()[:4])


def _flown(file: Path, output: Path, workers: int) -> tuple[float, float]:
    """Wall time of a whole study [s], start of the workers and result included, and the share that others took."""
    study = load_study(file)
    begin, machine, own = perf_counter(), _machine_busy(), _own_busy()
    run_study(study, output, workers=workers, restart=True)
    wall = perf_counter() - begin
    others = max(0.0, _machine_busy() - machine - (_own_busy() - own))
    return wall, others / (wall * (os.cpu_count() or 1))


def _killed_and_continued(file: Path, output: Path) -> int:
    """Fly the study by the command, kill it with half its runs done, fly the rest; how many were kept when it died."""
    command = [
        str(Path(sys.executable).with_name("stommel")),
        "study",
        str(file),
        "--output",
        str(output),
        "--workers",
        "2",
    ]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while (kept := len(list(journal_of(output).glob("[0-9]*/[0-9]*.json")))) < RUNS // 2:
        if process.poll() is not None:
            raise RuntimeError(f"the study ended with status {process.returncode} after {kept} runs")
        sleep(0.2)
    process.send_signal(signal.SIGKILL)
    process.wait()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return kept


@figure(unit="1", bar=0.9, at_least=True)
def study_efficiency_2() -> Measurement:
    """Share of twice the speed of one worker that two reach in a study of 1000 one-day missions.

    Wall time from the call to the result file, the workers' start counted; compiled before. The round that other
    processes disturbed least counts; a quiet one ends the measurement. The result must be the same, byte for byte,
    with one worker, with two, and of a study that is killed in the middle and started again.
    """
    if cores() < 2:
        return Measurement(None, {"skipped": "needs two cores"})
    rounds = []
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        file = _study_file(folder)
        study = load_study(file)
        fly_run(study.kit, 0, study.values[0])  # compiles
        importlib.import_module("xarray.backends.api")  # what writes the result is loaded once for both
        importlib.import_module("netCDF4")
        outputs = [folder / name for name in ("one.nc", "two.nc", "killed.nc")]
        while len(rounds) < ROUNDS and (not rounds or min(rounds)[0] > QUIET):
            (wall_1, others_1), (wall_2, others_2) = (_flown(file, outputs[n - 1], n) for n in (1, 2))
            rounds.append((max(others_1, others_2), wall_1, wall_2))
        kept = _killed_and_continued(file, outputs[2])
        if len({output.read_bytes() for output in outputs}) != 1:
            raise RuntimeError("the results of one worker, of two and of the killed study differ")
    others, wall_1, wall_2 = min(rounds)
    detail = {
        "missions": RUNS,
        "wall_s": [wall_1, wall_2],
        "runs_per_s": [RUNS / wall_1, RUNS / wall_2],
        "taken_by_others": others,
        "rounds": rounds,
        "runs_kept_when_killed": kept,
        "same_result": True,
    }
    return Measurement(wall_1 / (2.0 * wall_2), detail)
