"""`stommel sitl`: what it writes and says, how it is interrupted, and what it refuses in one line."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
import xarray as xr

from stommel.cli.status import INTERRUPTED
from stommel.messages.log.reader import read_log
from stommel.simulation.scenario.shipped import mission_path
from tests.support.command import Command

MISSION = mission_path("pool_trial")


@pytest.fixture
def short(tmp_path: Path) -> Path:
    """The pool trial, 150 s of it."""
    path = tmp_path / "short.toml"
    text = Path(MISSION).read_text(encoding="utf-8")
    path.write_text(text.replace("duration_days = 0.0125", f"duration_days = {150 / 86400:.8f}"), encoding="utf-8")
    return path


def test_it_writes_log_and_netcdf_like_simulate(stommel: Command, short: Path, tmp_path: Path) -> None:
    log, nc = tmp_path / "log", tmp_path / "a.nc"
    files = ("--output", nc, "--track", tmp_path / "t.kml", "--plots", tmp_path / "p")
    found = stommel("sitl", short, "--log", log, *files, "--json")
    assert found.status == 0
    assert found.json["written"][:2] == [str(nc), str(tmp_path / "t.kml")]
    assert any(path.startswith(str(tmp_path / "p")) for path in found.json["written"][2:])
    assert all(Path(path).stat().st_size for path in found.json["written"])
    assert found.json["state"] == "mission: descent"
    assert (found.json["alarms"], found.json["frames_lost"], found.json["frames_rejected"]) == ([], 0, 0)
    assert 0.0 < found.json["bus_load_share"] < 0.02
    simulated = stommel("simulate", short, "--output", tmp_path / "b.nc", "--json")
    assert set(simulated.json) <= set(found.json)
    with xr.open_dataset(nc) as ours, xr.open_dataset(tmp_path / "b.nc") as theirs:
        assert set(ours.variables) == set(theirs.variables)
    names = sorted(path.name for path in log.iterdir())
    contents = [read_log(path.read_bytes(), path.name) for path in sorted(log.iterdir())]
    assert len(names) == 2
    assert {one.status for one in contents} == {"whole"}
    told = stommel("sitl", "fly", short)
    assert told.status == 0
    assert "mission: descent" in told.out
    assert max(len(line) for line in told.out.splitlines()) <= 80


def test_another_seed_is_another_flight(stommel: Command, short: Path) -> None:
    rows = [stommel("sitl", short, "--seed", seed, "--json").json for seed in (7, 7, 8)]
    assert rows[0] == rows[1] != rows[2]
    assert [row["seed"] for row in rows] == [7, 7, 8]


def test_the_nodes_may_run_apart(stommel: Command, short: Path, tmp_path: Path) -> None:
    alone = stommel("sitl", short, "--log", tmp_path / "a", "--json").json
    apart = stommel("sitl", short, "--log", tmp_path / "b", "--separate-nodes", "--json").json
    assert (alone["nodes"], apart["nodes"]) == ("in one process", "in separate processes, in lockstep")
    for path in (tmp_path / "a").iterdir():
        assert (tmp_path / "b" / path.name).read_bytes() == path.read_bytes()


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--speed", "fast"), "neither max nor a number"),
        (("--speed", "0"), "neither max nor a number"),
        (("--speed", "nan"), "neither max nor a number"),
        (("--output", "x.txt"), "--output"),
        (("--log", "same", "--plots", "same"), "--log"),
    ],
)
def test_bad_options_are_one_line(stommel: Command, short: Path, options: tuple[str, ...], words: str) -> None:
    found = stommel("sitl", short, *options)
    assert found.status == 2
    assert words in found.err
    assert len(found.err.strip().splitlines()) == 1


@pytest.mark.skipif(sys.platform == "win32", reason="has no such signal")
def test_ctrl_c_leaves_a_whole_log_and_says_so(tmp_path: Path) -> None:
    command = [sys.executable, "-c", "from stommel.cli import main; main()", "sitl", "still_20_days", "--log", "log"]
    running = subprocess.Popen(
        [*command, "--output", "x.nc"],
        cwd=tmp_path,
        env=os.environ,
        stderr=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    until = time.monotonic() + 300.0
    while time.monotonic() < until and not any((tmp_path / "log").glob("*detail*")):
        time.sleep(0.2)
    running.send_signal(signal.SIGINT)
    _, err = running.communicate(timeout=120)
    assert running.returncode == INTERRUPTED
    assert "interrupted at 00:" in err
    assert "the log in log is whole" in err
    assert "Traceback" not in err
    assert [path.name for path in tmp_path.iterdir()] == ["log"]
    for path in (tmp_path / "log").iterdir():
        assert read_log(path.read_bytes(), path.name).status == "whole"


def test_real_time_takes_its_time(stommel: Command, tmp_path: Path) -> None:
    path = tmp_path / "shorter.toml"
    text = Path(MISSION).read_text(encoding="utf-8")
    path.write_text(text.replace("duration_days = 0.0125", f"duration_days = {60 / 86400:.8f}"), encoding="utf-8")
    began = time.monotonic()
    found = stommel("sitl", path, "--speed", "20", "--no-live", "--json")
    assert found.status == 0
    assert time.monotonic() - began >= 59 / 20
    assert found.json["fell_behind_s"] >= 0.0


def test_the_live_view_goes_to_the_error_stream(stommel: Command, short: Path) -> None:
    found = stommel("sitl", short, "--live", "--json")
    assert found.status == 0
    assert json.loads(found.out)["state"] == "mission: descent"
