"""Short missions, and the command that flies many of them."""

import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.support.command import PROGRAM, run_here

MISSION = """
format = 1
name = "an hour of dives"
vehicle = "zju"
start_time = 2026-07-01T00:00:00Z
duration_days = 0.04
seed = 1
[start]
latitude_deg = 18.0
longitude_deg = 115.0
[[waypoints]]
latitude_deg = 19.0
longitude_deg = 115.0
[dives]
depth_m = 40
pitch_deg = 35
ballast_ml = 200
[surface]
session_s = 60
[sensors]
first_fix_s = 20
[ocean]
name = "uniform"
"""

UNIFORM = """
[[parameters]]
key = "mission.dives.pitch_deg"
distribution = "uniform"
from = 20
to = 45
[[parameters]]
key = "ocean.current_east_m_s"
distribution = "normal"
mean = 0.1
standard_deviation = 0.05
"""

Write = Callable[[str], Path]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "hop.toml").write_text(MISSION)
    return tmp_path


@pytest.fixture
def write(folder: Path) -> Write:
    """Writes a study file beside the mission."""

    def study(text: str) -> Path:
        path = folder / "study.toml"
        path.write_text('name = "test"\nmission = "hop.toml"\n' + text)
        return path

    return study


def start(folder: Path, *arguments: object) -> subprocess.Popen[str]:
    """Begin a study in a process of its own, to be interrupted."""
    return subprocess.Popen(
        [PROGRAM, "study", *map(str, arguments)],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def run(folder: Path, *arguments: object) -> Any:
    """JSON of a study that must succeed."""
    done = run_here(folder, "study", *arguments, "--json")
    assert done.status == 0, done.err
    return done.json


def refused(folder: Path, *arguments: object) -> str:
    """The one line of a study that must be refused."""
    done = run_here(folder, "study", *arguments)
    assert done.status == 2, done.err
    lines = done.err.strip().splitlines()
    assert len(lines) == 1, done.err
    return lines[0]
