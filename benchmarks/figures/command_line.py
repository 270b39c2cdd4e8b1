"""The command as its user waits for it: a whole process, import and all."""

import json
import subprocess
import sys
from pathlib import Path

from figures.registry import Measurement, figure
from figures.timing import seconds, summary

STOMMEL = str(Path(sys.executable).with_name("stommel"))
TRIM = ("trim", "zju", "--speed", "0.4", "--pitch", "-35", "--json")
REPEATS = 7


@figure(unit="s", bar=0.5)
def cli_trim_s() -> Measurement:
    """Measure one trim on the command line, from the second run on [s]."""
    json.loads(_answer(TRIM))  # an answer, and whatever is kept between runs
    return _measured(TRIM)


@figure(unit="s", bar=0.2)
def cli_help_s() -> Measurement:
    """Measure the list of verbs on the command line, from the second run on [s]."""
    assert "simulate" in _answer(("--help",))
    return _measured(("--help",))


def _measured(arguments: tuple[str, ...]) -> Measurement:
    detail = summary(seconds(lambda: _answer(arguments), REPEATS), 1.0)
    return Measurement(detail["min"], detail | {"command": " ".join(("stommel", *arguments))})


def _answer(arguments: tuple[str, ...]) -> str:
    return subprocess.run([STOMMEL, *arguments], capture_output=True, text=True, check=True).stdout
