"""`stommel station import`. Oracle: what the log says that was written."""

from pathlib import Path

import pytest

from stommel.archive import Archive
from tests.archive.logs.written import UTC, logs
from tests.support.command import Command


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """A folder with an archive that knows a vehicle, and its logs beside it."""
    with Archive.open(str(tmp_path / "sea.sqlite")) as archive:
        archive.know(1, "Kelp", "zju")
    for name, data in logs().items():
        (tmp_path / name).write_bytes(data)
    return tmp_path


def names(home: Path) -> list[str]:
    return sorted(path.name for path in home.glob("*.log"))


def test_logs_are_taken_in_and_told(stommel: Command, home: Path) -> None:
    arguments = ("station", "import", "--database", home / "sea.sqlite", "--vehicle", 1, *names(home))
    told = stommel(*arguments)
    assert told.status == 0, told.err
    assert "whole" in told.out
    assert "3 dives" in told.out
    found = stommel(*arguments, "--json").json["logs"]
    assert [row["state"] for row in found] == ["taken", "taken"]
    assert sum(row["dives"] for row in found) == 3
    assert found[0]["begin"] == UTC
    assert (found[0]["texts"], found[0]["left_out"]) == (12, 0)
    assert "12 status texts" in told.out
    assert all(str(row["samples"]) in told.out for row in found)
    with Archive.open(str(home / "sea.sqlite")) as archive:
        assert len(archive.dives(1)) == 3


def test_settings_and_folder_say_where_the_archive_is(stommel: Command, home: Path) -> None:
    (home / "sea.sqlite").rename(home / "station.sqlite")
    settings = home / "station.toml"
    settings.write_text('folder = "."\ndatabase = "station.sqlite"\n')
    for where in (("--settings", settings), ("--database", home / "station.sqlite", "--folder", home)):
        assert stommel("station", "import", *where, "--vehicle", 1, *names(home)).status == 0


@pytest.mark.parametrize(
    ("vehicle", "file", "words"),
    [
        (2, "00000-000001-essential.log", "nothing of vehicle 2 is there; there are: 1 (Kelp)"),
        (1, "no.log", "no.log"),
        (1, "sea.sqlite", "is no log of a vehicle"),
        (1, "undated.log", "undated.log: the log does not tell the vehicle's clock"),
        (251, "00000-000001-essential.log", "--vehicle"),
    ],
)
def test_what_cannot_be_taken_is_one_line(stommel: Command, home: Path, vehicle: int, file: str, words: str) -> None:
    (home / "undated.log").write_bytes(next(iter(logs(seconds=30, utc=None).values())))
    found = stommel("station", "import", "--database", home / "sea.sqlite", "--vehicle", vehicle, file)
    assert found.status != 0
    assert words in " ".join(found.err.split())


def test_an_archive_that_is_not_there_is_not_made(stommel: Command, home: Path) -> None:
    found = stommel("station", "import", "--database", home / "new.sqlite", "--vehicle", 1, *names(home))
    assert found.status != 0
    assert not (home / "new.sqlite").exists()
