"""The page "From Python" has every name of the front door, and its examples print what they say."""

import doctest
import re
import subprocess
import sys
from pathlib import Path

import stommel

PAGE = (Path(__file__).parents[2] / "docs" / "reference.md").read_text(encoding="utf-8")
EXAMPLES = "\n".join(re.findall(r"```pycon\n(.*?)```", PAGE, re.S))
DESCRIBED = re.findall(r"^\.\. (?:py:data|auto(?:function|class|exception)):: stommel\.(\w+)$", PAGE, re.M)


def test_every_name_of_the_front_door_is_described_once() -> None:
    assert sorted(DESCRIBED) == sorted(stommel.__all__)


def test_every_name_of_the_front_door_has_an_example() -> None:
    source = "".join(example.source for example in doctest.DocTestParser().get_examples(EXAMPLES))
    used = set(re.findall(r"stommel\.(\w+)", source))
    # these come out of others: a mission is loaded, a flight is trimmed
    assert set(stommel.__all__) - used == {"Mission", "Physics", "SteadyFlight", "Vehicle"}


def test_examples_print_what_they_say(tmp_path: Path) -> None:
    """In a process of its own, as whoever copies the page would run it, and with warnings as errors."""
    (tmp_path / "page.txt").write_text(EXAMPLES, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-W", "error", "-m", "doctest", "page.txt"],
        cwd=tmp_path, capture_output=True, text=True, timeout=600, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    assert len(doctest.DocTestParser().get_examples(EXAMPLES)) > 30
