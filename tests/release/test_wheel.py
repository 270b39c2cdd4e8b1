"""The wheel holds every file of the sources, and works without them. Oracles: the checkout, the paper."""

import json
import os
import re
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path
from typing import Any

import pytest

import stommel
from tests.support.pages import ROOT


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    pytest.importorskip("build", reason="needs the extra test: pip install 'stommel[test]'")
    pytest.importorskip("hatchling", reason="needs the extra test: pip install 'stommel[test]'")
    folder = tmp_path_factory.mktemp("dist")
    run("build", "--wheel", "--no-isolation", "--outdir", folder, ROOT)
    (built,) = folder.iterdir()
    return built


def run(module: str, *arguments: object) -> None:
    done = subprocess.run(
        [sys.executable, "-m", module, *map(str, arguments)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with the wheel's package; its dependencies are those of the tests."""
    folder = tmp_path_factory.mktemp("installed")
    run("pip", "install", "--quiet", "--no-deps", "--no-index", "--target", folder, wheel)
    return folder


def test_the_wheel_holds_every_file_of_the_sources(wheel: Path) -> None:
    sources = ROOT / "src"
    expected = {
        path.relative_to(sources).as_posix()
        for path in (sources / "stommel").rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    assert {Path(name).suffix for name in expected} >= {".py", ".toml", ".j2", ".css", ".html", ".csv"}
    with zipfile.ZipFile(wheel) as archive:
        assert {name for name in archive.namelist() if ".dist-info/" not in name} == expected


def test_the_wheel_answers_and_flies(installed: Path, tmp_path: Path) -> None:
    environment = {**os.environ, "PYTHONPATH": str(installed)}

    def stommel(*arguments: object) -> Any:
        done = subprocess.run(
            [installed / "bin" / "stommel", *map(str, arguments), "--json"],
            cwd=tmp_path, env=environment, capture_output=True, text=True, check=False,
        )  # fmt: skip
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)

    where = subprocess.run(
        [sys.executable, "-c", "import stommel; print(stommel.__file__)"],
        env=environment, capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert Path(where.stdout.strip()).is_relative_to(installed)
    # Table 1 of the paper
    trim = stommel("trim", "zju", "--speed", 0.4, "--pitch", -35)
    assert trim["moving_mass_position_mm"] == pytest.approx(408.2, abs=0.05)
    trial = stommel("simulate", "pool_trial", "--output", "trial.nc")
    assert trial["dives"] >= 3
    assert 2.0 < trial["deepest_m"] < 3.5  # the bottom of the pool
    assert (tmp_path / "trial.nc").stat().st_size > 1000


def test_one_version_stands_everywhere() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    citation = re.search(r"^version: (\S+)$", (ROOT / "CITATION.cff").read_text(encoding="utf-8"), re.MULTILINE)
    assert citation is not None
    assert project["version"] == citation[1] == stommel.__version__
