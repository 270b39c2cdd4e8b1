"""`stommel simulate` as its users run it: outcome, files, and clear refusals."""

import contextlib
import json
import os
import re
import signal
import subprocess
import time
from pathlib import Path

import pytest

from tests.support.command import PROGRAM, Command

PLAN = """
name = "a few dives"
vehicle = "{vehicle}"
start_time = 2026-07-01T00:00:00Z
duration_days = 0.05
{extra}
[start]
latitude_deg = {latitude}
longitude_deg = 126.6
[[waypoints]]
latitude_deg = 28.4
longitude_deg = {longitude}
[dives]
depth_m = {depth}
pitch_deg = 35
speed_m_s = 0.35
[ocean]
name = "{ocean}"
"""
GOOD = {
    "vehicle": "zju",
    "extra": "",
    "latitude": 28.2,
    "longitude": 127.0,
    "depth": 100,
    "ocean": "east_china_sea",
}


@pytest.fixture
def plan(tmp_path: Path) -> Path:
    path = tmp_path / "plan.toml"
    path.write_text(PLAN.format(**GOOD))
    return path


def test_mission_with_all_outputs(stommel: Command, plan: Path, tmp_path: Path) -> None:
    done = stommel("simulate", plan, "--output", "out/m.nc", "--plots", "pictures", "--json")
    assert done.status == 0, done.err
    assert done.err == ""  # no progress bar without a terminal
    row = done.json
    assert row["outcome"] == "time over"
    assert row["dives"] >= 3
    assert 95.0 < row["deepest_m"] <= 100.0  # no deeper than asked
    assert len(row["written"]) == 1 + 6 * 2 + 1
    assert row["speed_up"] is None
    assert all((tmp_path / name).stat().st_size > 1000 for name in row["written"])
    page = (tmp_path / "pictures" / "mission.html").read_text()
    assert "@@" not in page
    assert "http" not in page  # works at sea


def test_summary_fits_a_terminal(stommel: Command, plan: Path) -> None:
    done = stommel("simulate", plan, "--seed", 7)
    assert done.status == 0, done.err
    assert "outcome" in done.out
    assert max(map(len, done.out.splitlines())) <= 80


def test_speed_up_is_simulated_over_measured_time(stommel: Command, stommel_process: Command, plan: Path) -> None:
    row = stommel_process("simulate", plan, "--speed-up", "--json").json
    assert row["speed_up"] == pytest.approx(row["days"] * 86400.0 / row["flight_s"], rel=1e-12)
    assert row["flight_s"] < 20.0  # compiling alone takes longer
    shown = stommel("simulate", plan, "--speed-up").out
    assert "times real time, flown in" in shown


def test_progress_bar_shows_date_and_speed_in_a_terminal(plan: Path) -> None:
    pty = pytest.importorskip("pty", reason="needs the terminals of a Unix")
    far = plan.read_text().replace("latitude_deg = 28.4", "latitude_deg = 33.0").replace("east_china_sea", "still")
    plan.write_text(far.replace("duration_days = 0.05", "duration_days = 2"))
    reader, terminal = pty.openpty()
    with subprocess.Popen([PROGRAM, "simulate", plan, "--json"], stderr=terminal, stdout=subprocess.PIPE) as running:
        os.close(terminal)
        shown = b""
        with contextlib.suppress(OSError):  # how the end of a terminal reads on Linux
            while piece := os.read(reader, 65536):
                shown += piece
        assert running.stdout is not None
        assert json.loads(running.stdout.read())["days"] == 2.0
    os.close(reader)
    text = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", shown.decode())
    assert "getting ready" in text
    assert re.search(r"2026-07-03 00:00 .* 100 % +[\d,]+ x real time", text)
    assert shown.rstrip().endswith(b"\x1b[2K")  # wiped away: what follows stands alone


def test_shipped_missions_are_listed(stommel: Command) -> None:
    assert {"pool_trial", "kuroshio", "still_20_days"} <= set(stommel("simulate", "--list", "--json").json)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"depth": 250}, ["dives.depth_m = 250", "hull's rating, 200 m"]),
        ({"latitude": 28.9, "depth": 150}, ["dives.depth_m = 150", "below the bottom at the start"]),
        ({"longitude": 110.0}, ["waypoints.0", "outside the ocean"]),
        ({"vehicle": "nautilus"}, ["nautilus"]),
        ({"ocean": "styx"}, ["styx", "unknown analytic ocean"]),
        ({"extra": "dive_depth = 3"}, ["dive_depth"]),
        ({"extra": "duration_days = 4"}, ["not valid TOML"]),
        ({"extra": "[surface]\nsession_s = 5"}, ["surface.session_s = 5", "between 60 and 86400 s"]),
    ],
)
def test_bad_plans_are_refused_in_one_line(
    stommel: Command, tmp_path: Path, changes: dict[str, object], words: list[str]
) -> None:
    path = tmp_path / "bad.toml"
    path.write_text(PLAN.format(**GOOD | changes))
    done = stommel("simulate", path, "--output", "m.nc")
    assert done.status == 2
    lines = done.err.strip().splitlines()
    assert len(lines) == 1, done.err
    assert lines[0].startswith("error: ")
    assert all(word in lines[0] for word in words), lines[0]
    assert not (tmp_path / "m.nc").exists()


def test_unknown_mission_names_those_there_are(stommel: Command) -> None:
    done = stommel("simulate", "atlantis")
    assert done.status == 2
    assert "pool_trial" in done.err


def test_unwritable_output_is_refused(stommel: Command, plan: Path) -> None:
    done = stommel("simulate", plan, "--output", f"{plan}/m.nc")
    assert done.status == 2
    assert "cannot be written" in done.err


def test_interruption_leaves_no_file(stommel: Command, stommel_process: Command, plan: Path, tmp_path: Path) -> None:
    assert stommel("simulate", plan, "--json").status == 0  # compiles first, so that the signal meets a flying mission
    begun = time.monotonic()
    assert stommel_process("simulate", plan, "--json").status == 0
    until_flying = time.monotonic() - begun
    for written in tmp_path.glob("*.nc"):
        written.unlink()
    # a goal that is months away, in an ocean without an edge
    long = plan.read_text().replace("duration_days = 0.05", "duration_days = 700")
    long = long.replace("latitude_deg = 28.4", "latitude_deg = 85.0").replace("east_china_sea", "still")
    plan.write_text(long.replace('name = "a few dives"', 'name = "long"\nchanges = { "battery.capacity_ah" = 5000 }'))
    for share in (1.5, 1.2, 0.9, 0.6):  # a machine that was busy a moment ago may fly it before it is interrupted
        running = subprocess.Popen(
            [PROGRAM, "simulate", plan, "--output", tmp_path / "m.nc"], stderr=subprocess.PIPE, stdout=subprocess.PIPE
        )
        time.sleep(min(share * until_flying + 0.5, 20.0))
        running.send_signal(signal.SIGINT)
        _, err = running.communicate(timeout=120)
        if running.returncode != 0:
            break
        (tmp_path / "m.nc").unlink()
    assert running.returncode == 130, err
    assert err.decode().splitlines() == ["interrupted before the end of the mission; nothing was written"]
    assert [p.name for p in tmp_path.iterdir()] == ["plan.toml"]
