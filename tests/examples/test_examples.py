"""Every documented example runs, without a warning."""

import re
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

from tests.support.command import Command
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


def test_python_of_the_readme(tmp_path: Path) -> None:
    (block,) = blocks(README, "python")
    run_python("-c", block + "\nassert plant.nstates == 4", folder=tmp_path)


def test_commands_of_the_readme(stommel: Command) -> None:
    calls = commands(README)
    assert len(calls) >= 9
    for arguments in calls:
        done = stommel(*arguments)
        assert done.status == 0, (arguments, done.err)
