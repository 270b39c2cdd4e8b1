"""`stommel link` without a vehicle: what cannot be is one line and status 2, and damage is told.

Oracle: the rules of errors (`stommel.cli`), and what was put into the folders by hand.
"""

from pathlib import Path

import pytest

from stommel.link.signing.key_file import KeyFile, new_keys
from tests.support.command import Outcome, run_here

NOBODY = ("--to", "tcp:127.0.0.1:9", "--within", "0.1")


def refused(folder: Path, *arguments: object) -> str:
    """The one line of an error."""
    found = run_here(folder, "link", *arguments, *NOBODY)
    assert (found.status, found.out) == (2, "")
    (line,) = found.err.splitlines()
    return line


@pytest.mark.parametrize("state", ["there", "there/below"])
@pytest.mark.parametrize("signed", [False, True])
def test_state_folder_that_cannot_be(tmp_path: Path, state: str, *, signed: bool) -> None:
    (tmp_path / "there").write_text("a file")
    KeyFile(tmp_path / "a.key").write(new_keys(1, 1.8e9))
    who = ("--key", "a.key") if signed else ("--unsigned",)
    line = refused(tmp_path, "status", *who, "--state", state)
    assert line == f"error: --state {state}: cannot be written: Not a directory"


def follow(folder: Path, *arguments: object) -> Outcome:
    return run_here(folder, "link", "command", "follow", "--unsigned", "--state", "state", *NOBODY, *arguments)


def test_damaged_queue_of_commands_is_told_and_not_shown_as_empty(tmp_path: Path) -> None:
    (tmp_path / "state").mkdir()
    (tmp_path / "state" / "commands").write_bytes(bytes(range(40)))
    (note,) = follow(tmp_path, "--json").json["notes"]
    assert note.startswith("commands: is damaged")
    assert "note: commands: is damaged" in follow(tmp_path).out


def test_commands_of_before_the_clock_was_set_back_are_told_as_taken_back(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    give = ("link", "command", "send", "hold", "--unsigned", "--state", "state", *NOBODY, "--json")
    monkeypatch.setattr("time.time", lambda: 1.8e9)
    given = run_here(tmp_path, *give)
    assert given.status == 1
    monkeypatch.setattr("time.time", lambda: 1.8e9 - 86_400.0)
    found = follow(tmp_path, "--json").json
    assert all(each["words"].startswith("taken back") for each in found["commands"])
    assert [each["id"] for each in found["commands"]] == [given.json["id"]]
    assert "clock is 86400 s behind" in found["notes"][0]
