"""The engine of `zju` on the bench, and a small log that is beyond reproach."""

from collections.abc import Callable
from pathlib import Path

import pytest

from stommel.bench import BenchPlan, bench_engine, generate_log, write_log
from stommel.machinery.engine.steady_state import EngineParameters
from stommel.vehicle import load_vehicle


@pytest.fixture(scope="session")
def engine() -> EngineParameters:
    return bench_engine(load_vehicle("zju"))


SMALL = BenchPlan(pressures=(0.5e6, 2e6), motor_speeds=(550.0, 730.0), period=2.0)


@pytest.fixture
def log_file(tmp_path: Path, engine: EngineParameters) -> Path:
    path = tmp_path / "log.csv"
    write_log(generate_log(engine, 3, SMALL), path, 3, "zju")
    return path


Edit = Callable[[list[list[str]]], None]


def edited(path: Path, edit: Edit) -> Path:
    """The log with its cells changed; the first row holds the column names, comments stay."""
    lines = path.read_text().splitlines()
    comments = [line for line in lines if line.startswith("#")]
    cells = [line.split(",") for line in lines if not line.startswith("#")]
    edit(cells)
    path.write_text("\n".join([*comments, *(",".join(row) for row in cells)]) + "\n")
    return path
