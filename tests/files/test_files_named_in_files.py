"""A file that another one names is looked for beside that one, and refused by its own name."""

import os
from pathlib import Path

import pytest

from stommel.errors import FileError
from stommel.simulation.scenario.loading import load_mission
from stommel.studies.study import load_study
from stommel.vehicle import UnknownVehicleError, builtin_text
from tests.files.conftest import STUDY, in_time, shipped

POOL = shipped("stommel.simulation.scenario", "missions/pool_trial.toml")


def refusal(folder: Path) -> str:
    with in_time(20), pytest.raises(FileError) as caught:
        load_study(folder / "study.toml")
    return str(caught.value)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A study of a mission of a vehicle, each in a file."""
    folder = tmp_path / "season"
    folder.mkdir()
    (folder / "study.toml").write_text(STUDY.replace("pool_trial", "pool.toml"))
    (folder / "pool.toml").write_text(POOL.replace('vehicle = "zju"', 'vehicle = "mine.toml"'))
    (folder / "mine.toml").write_text(builtin_text("zju"))
    return folder


def test_each_is_found_beside_the_other(folder: Path) -> None:
    found = load_study(folder / "study.toml")
    assert found.kit.vehicle is not None
    assert found.kit.vehicle.origin == str(folder / "mine.toml")


@pytest.mark.parametrize("name", ["pool.toml", "mine.toml"])
def test_each_is_refused_by_its_own_name(folder: Path, name: str) -> None:
    path = folder / name
    path.unlink()
    assert refusal(folder) == f"{path}: cannot be read: No such file or directory"
    os.mkfifo(path)
    assert refusal(folder) == f"{path}: cannot be read: it is a pipe"
    path.unlink()
    path.write_text("a = 1\na = 2\n")
    assert refusal(folder) == f"{path}: is not valid TOML: line 2: a stands twice"


def test_names_of_what_is_built_in_are_no_files(folder: Path) -> None:
    (folder / "study.toml").write_text(STUDY.replace("pool_trial", "pond"))
    assert "study.toml: mission 'pond' is neither a file nor a shipped mission; shipped: " in refusal(folder)
    (folder / "pool.toml").write_text(POOL.replace('vehicle = "zju"', 'vehicle = "zjoo"'))
    with pytest.raises(UnknownVehicleError, match="vehicle 'zjoo' is neither a built-in vehicle nor a file"):
        load_mission(folder / "pool.toml")


def test_a_folder_does_not_stand_in_the_way_of_a_name(folder: Path) -> None:
    (folder / "zju").mkdir()
    (folder / "pool.toml").write_text(POOL)
    assert load_mission(folder / "pool.toml").vehicle.name == "ZJU glider"
