"""The guide's commands run, its mission file is flown, and its Python prints what it should."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from stommel.simulation.loading import load_mission
from stommel.simulation.mission import Mission
from tests.cli.conftest import Command, stommel

__all__ = ["stommel"]

GUIDE = (Path(__file__).parents[2] / "docs" / "guide" / "missions.md").read_text(encoding="utf-8")


def block(language: str) -> str:
    (found,) = re.findall(rf"```{language}\n(.*?)```", GUIDE, re.S)
    return str(found)


def test_command_writes_what_it_says(stommel: Command, tmp_path: Path) -> None:
    for line in block("console").splitlines():
        done = stommel(*line.removeprefix("$ stommel ").split())
        assert done.status == 0, done.err
    assert (tmp_path / "pool.nc").stat().st_size > 0
    assert {path.stem for path in (tmp_path / "pool").glob("*.png")} == {
        "trial", "sawtooth", "map", "energy", "actuators",
    }  # fmt: skip


@pytest.fixture
def mission(tmp_path: Path) -> Mission:
    path = tmp_path / "mine.toml"
    path.write_text(block("toml"))
    return load_mission(path)


def test_mission_file_is_accepted(mission: Mission) -> None:
    assert mission.plan.duration_days == 3.0
    assert mission.ocean.name == "east_china_sea"


def test_python_prints_the_depth() -> None:
    done = subprocess.run([sys.executable, "-c", block("python")], capture_output=True, text=True, check=True)
    assert 2.4 < float(done.stdout) < 3.2


def test_every_table_of_the_guide_is_a_field() -> None:
    from stommel.simulation.mission_file import MissionFile

    section = GUIDE.split("Everything else has a default:")[1].split("What cannot be flown")[0]
    named = {name for row in re.findall(r"^\| (`.*?`) \|", section, re.M) for name in re.findall(r"`(\w+)`", row)}
    assert named <= set(MissionFile.model_fields)
    assert len(named) > 8
