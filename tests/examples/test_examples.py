"""Every documented example runs, without a warning."""

import re
import signal
import subprocess
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

from tests.support.command import PROGRAM, Command, run_process
from tests.support.pages import ROOT, blocks, commands
from tests.support.python import run_python

SCRIPTS = sorted((ROOT / "examples").glob("*.py"))
README = (ROOT / "README.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def printed(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], str]:
    """What an example prints; each runs once."""
    return cache(lambda name: run_python(ROOT / "examples" / name, folder=tmp_path_factory.mktemp("example")))


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_example(printed: Callable[[str], str], script: Path) -> None:
    assert printed(script.name).strip()


def test_flight_settles_into_the_trim(printed: Callable[[str], str]) -> None:
    """The last line of the launch is the trimmed flight: trim and launch are of the same physics."""
    last = printed("fly_the_equations.py").splitlines()[-1]
    pitch, speed = (float(value) for value in re.findall(r"pitch\s+(\S+) deg\s+speed (\S+)", last)[0])
    assert pitch == pytest.approx(-35.0, abs=0.02)
    assert speed == pytest.approx(0.4, abs=0.001)


def test_wing_position_trades_damping_for_authority(printed: Callable[[str], str]) -> None:
    """Aft: more damping, less pitch rate and turning (section 3.2); the pitch in the end is a balance of weights."""
    rows = [row.split() for row in printed("design_a_wing_position.py").splitlines()[2:]]
    wing, damping, rate, turn, pitch = ([float(cell) for cell in column] for column in zip(*rows, strict=True))
    assert wing == sorted(set(wing))
    assert damping == sorted(set(damping))
    assert rate == sorted(set(rate), reverse=True)
    assert turn == sorted(set(turn), reverse=True)
    assert len(set(pitch)) == 1


def test_the_log_of_the_software_is_true(printed: Callable[[str], str]) -> None:
    """Four dives to 2.5 m, each with its three phases, and depths as the sensor's noise and step allow."""
    told = printed("fly_the_software.py")
    for phase in ("descent", "inflection", "ascent"):
        assert told.count(f"mission: {phase}: control dives\n") == 4
    assert re.search(r"^whole, whole: \d+ decisions, 4 dives$", told, re.M)
    seen, true, rms = map(float, re.findall(r"depth (\S+) m, in truth (\S+) m; off by (\S+) m", told)[0])
    assert seen == pytest.approx(true, abs=0.2)
    assert true == pytest.approx(2.5, abs=0.3)
    assert 0.0 < rms < 0.1


def test_no_flipped_bit_gets_through(printed: Callable[[str], str]) -> None:
    """CRC-8 finds each of the 64 bits of a frame; the second of four frames was repeated, the third lost."""
    told = printed("decode_can_frames.py")
    assert "again: Sync rejected: its alive counter is that of the frame before" in told
    assert "after a gap: Sync: vehicle_time 3 s (1 lost before) - 1 lost\n" in told
    assert told.endswith("64 of 64 flipped bits are found\n")


def test_python_of_the_readme(tmp_path: Path) -> None:
    (block,) = blocks(README, "python")
    run_python("-c", block + "\nassert plant.nstates == 4", folder=tmp_path)


def _serves(arguments: list[str]) -> bool:
    """Whether a command goes on until somebody ends it."""
    return "-listen:" in " ".join(arguments) or arguments[0] == "station"


def test_commands_of_the_readme(stommel: Command) -> None:
    """Each command that ends by itself; the others are tried in the tests of what they serve."""
    calls = [arguments for arguments in commands(README) if not _serves(arguments) and arguments[0] != "link"]
    assert len(calls) >= 9
    for arguments in calls:
        done = stommel(*arguments)
        assert done.status == 0, (arguments, done.err)


def test_glider_on_the_air_of_the_readme(tmp_path: Path) -> None:
    """The two terminals of the README: one glider, and one look at it."""
    (serving,) = (call for call in commands(README, "sitl") if _serves(call))
    (asking,) = commands(README, "link")
    glider = [word.replace(":5760", ":0") for word in serving]
    with subprocess.Popen([PROGRAM, *glider], cwd=tmp_path, stderr=subprocess.PIPE, text=True) as process:
        try:
            assert process.stderr is not None
            found = re.search(r"127\.0\.0\.1(:\d+)", process.stderr.readline())  # it listens
            assert found
            look = [word.replace(":5760", found[1]) for word in asking]
            seen = run_process(tmp_path, *look, "--state", tmp_path / "state")
            assert seen.status == 0, seen.err
            assert seen.out.startswith("Vehicle 1\n")
        finally:
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=60)
