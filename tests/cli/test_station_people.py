"""`stommel station user` and `token`: people from the station's own machine."""

import json
import sys
from io import StringIO
from pathlib import Path
from typing import Any

import pytest

from stommel.archive import Archive
from stommel.station.people.people import People
from stommel.station.people.roles import Role
from tests.support.command import Command
from tests.support.station_served import PASSWORD

SEA = ("--database", "sea.sqlite")


@pytest.fixture
def typed(monkeypatch: pytest.MonkeyPatch) -> Any:
    """What a person pipes in."""

    def pipe(text: str) -> None:
        monkeypatch.setattr(sys, "stdin", StringIO(text))

    return pipe


def test_a_person_is_added_listed_changed_and_removed(stommel: Command, typed: Any, tmp_path: Path) -> None:
    for name, role in (("ada", "admin"), ("anna", "pilot")):
        typed(f"{PASSWORD}\n")
        assert stommel("station", "user", "add", name, "--role", role, *SEA).out == f"{name} is {role} now\n"
    listed = stommel("station", "user", "list", *SEA, "--json").json
    assert [(row["name"], row["role"], row["disabled"]) for row in listed] == [
        ("ada", "admin", False), ("anna", "pilot", False),
    ]  # fmt: skip
    stommel("station", "user", "change", "anna", "--role", "viewer", "--keep-out", *SEA)
    typed("another way to the sea\n")
    stommel("station", "user", "password", "anna", *SEA)
    stommel("station", "user", "change", "anna", "--let-in", *SEA)
    archive = Archive.open(f"sqlite:///{tmp_path / 'sea.sqlite'}")
    people = People(archive)
    assert people.log_in("anna", "another way to the sea", "10.0.0.1")[0].role is Role.VIEWER
    actions = [(entry.action, entry.address) for entry in people.audit.entries() if entry.user is None]
    assert actions[-2:] == [("add user", "command line")] * 2
    archive.close()
    assert stommel("station", "user", "remove", "anna", *SEA).out == "anna is removed\n"
    assert "anna" not in stommel("station", "user", "list", *SEA).out


def test_a_token_is_told_once(stommel: Command, typed: Any, tmp_path: Path) -> None:
    typed(f"{PASSWORD}\n")
    stommel("station", "user", "add", "anna", "--role", "pilot", *SEA)
    secret = stommel("station", "token", "add", "anna", "plots", "--role", "viewer", "--days", "7", *SEA).out.strip()
    archive = Archive.open(f"sqlite:///{tmp_path / 'sea.sqlite'}")
    user = People(archive).tokens.user_of(secret)
    archive.close()
    assert user is not None
    assert (user.name, user.role) == ("anna", Role.VIEWER)
    listed = stommel("station", "token", "list", *SEA, "--json").out
    assert secret not in listed
    (row,) = json.loads(listed)
    assert row["expires_s"] - row["made_s"] == pytest.approx(7 * 86_400.0)
    assert stommel("station", "token", "remove", str(row["token"]), *SEA).out == f"token {row['token']} is removed\n"
    assert stommel("station", "token", "list", *SEA, "--json").json == []


@pytest.mark.parametrize(
    ("words", "typed_in", "said"),
    [
        (("user", "add", "a b", "--role", "pilot"), PASSWORD, "this is no name for a person"),
        (("user", "add", "anna", "--role", "pilot"), "short", "a password has 10 to 200 characters"),
        (("user", "add", "anna", "--role", "pilot"), "", "a password has 10 to 200 characters"),
        (("user", "add", "anna", "--role", "captain"), PASSWORD, "--role"),
        (("user", "remove", "bob"), "", "nobody is named bob"),
        (("user", "password", "bob"), PASSWORD, "nobody is named bob"),
        (("user", "change", "bob"), "", "give --role, --keep-out or --let-in"),
        (("token", "add", "bob", "x", "--role", "viewer"), "", "nobody is named bob"),
        (("token", "add", "bob", "x", "--role", "viewer", "--days", "0"), "", "--days"),
        (("token", "remove", "7"), "", "there is no token 7"),
    ],
)
def test_what_cannot_be_is_one_line(
    stommel: Command, typed: Any, words: tuple[str, ...], typed_in: str, said: str
) -> None:
    typed(f"{typed_in}\n")
    answer = stommel("station", *words, *SEA)
    assert answer.status == 2
    assert said in answer.err
    assert answer.err.count("\n") == 1
    if typed_in:
        assert typed_in not in answer.err


def test_the_archive_is_found_by_folder_and_by_settings(stommel: Command, typed: Any, tmp_path: Path) -> None:
    """Paths of station.toml are from where it lies; without --database the archive is in the folder."""
    (tmp_path / "pier").mkdir()
    (tmp_path / "pier" / "station.toml").write_text('folder = "kept"\n', encoding="utf-8")
    typed(f"{PASSWORD}\n")
    stommel("station", "user", "add", "ada", "--role", "admin", "--settings", "pier/station.toml")
    for words in (("--folder", "pier/kept"), ("--settings", "pier/station.toml")):
        assert [row["name"] for row in stommel("station", "user", "list", *words, "--json").json] == ["ada"]
    assert (tmp_path / "pier" / "kept" / "archive.sqlite").is_file()
