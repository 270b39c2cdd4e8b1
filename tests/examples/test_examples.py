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
    """The last line of the launch is the trimmed flight (in the vehicle's full physics, close to the paper's)."""
    last = printed("fly_the_equations.py").splitlines()[-1]
    pitch, speed = (float(value) for value in re.findall(r"pitch\s+(\S+) deg\s+speed (\S+)", last)[0])
    assert pitch == pytest.approx(-35.0, abs=1.5)
    assert speed == pytest.approx(0.4, abs=0.01)


def test_python_of_the_readme(tmp_path: Path) -> None:
    (block,) = blocks(README, "python")
    run_python("-c", block + "\nassert plant.nstates == 4", folder=tmp_path)


def test_commands_of_the_readme(stommel: Command) -> None:
    calls = commands(README)
    assert len(calls) >= 9
    for arguments in calls:
        done = stommel(*arguments)
        assert done.status == 0, (arguments, done.err)
