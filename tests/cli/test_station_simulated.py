"""The main job of `make run`: a simulated glider and the station in one command, until Ctrl-C."""

import re
import signal
import subprocess
import time
from pathlib import Path

import httpx
import pytest

from tests.support.command import PROGRAM, run_here


def test_one_command_launches_a_glider_and_serves_it(tmp_path: Path) -> None:
    """It is heard over its signed link, its archive is there afterwards, and no process of it is left."""
    command = [PROGRAM, "station", "--sitl", "east_china_sea", "--folder", tmp_path, "--port", "0"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout is not None
            told = process.stdout.readline()
            address = re.search(r"page: (http://127\.0\.0\.1:\d+/)", told)
            assert address, told
            with httpx.Client(base_url=address[1], timeout=60.0) as client:
                summary = heard(client)
            assert (summary["simulated"], summary["speed"], summary["model"]) == (True, 20.0, "zju")
        finally:
            process.send_signal(signal.SIGINT)
            assert process.wait(120) == 0
    assert (tmp_path / "archive.sqlite").is_file()
    assert (tmp_path / "glider" / "log").is_dir()
    assert not flying(tmp_path)


def heard(client: httpx.Client) -> dict[str, object]:
    """Summary of the only vehicle once it is heard; the first start compiles the simulated glider."""
    for _ in range(6000):
        (summary,) = client.get("/api/vehicles").raise_for_status().json()
        if summary["heard"]:
            found: dict[str, object] = summary
            return found
        time.sleep(0.1)
    raise AssertionError(summary)


def flying(folder: Path) -> bool:
    """Whether a process still has the folder in its command line."""
    return any(
        str(folder).encode() in line.read_bytes() for line in Path("/proc").glob("[0-9]*/cmdline") if exists(line)
    )


def exists(line: Path) -> bool:
    try:
        return bool(line.read_bytes())
    except OSError:
        return False


@pytest.mark.parametrize(
    ("option", "value", "words"),
    [("--sitl", "atlantis", "neither a file nor a shipped mission"), ("--speed", "0", "must be between 0.1 and 100")],
)
def test_wrong_flights_are_refused_before_anything_starts(tmp_path: Path, option: str, value: str, words: str) -> None:
    told = {"--sitl": "east_china_sea"} | {option: value}
    done = run_here(tmp_path, "station", *(word for pair in told.items() for word in pair), "--folder", "flight")
    assert done.status == 2
    assert words in done.err
    assert not (tmp_path / "flight").exists()
