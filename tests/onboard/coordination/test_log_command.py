"""`stommel vehicle log`. Oracle: the records that were written down, and the bytes that were cut off."""

import json
import re
from math import inf
from pathlib import Path

import pytest
from typer.testing import CliRunner

from stommel.cli.app import app
from stommel.files.folder_storage import FolderStorage
from stommel.onboard.coordination.logbook.framing import LogIdentity
from stommel.onboard.coordination.logbook.logbook import Logbook, LogSettings
from stommel.onboard.coordination.logbook.records import CTD, DECISION, HULL


@pytest.fixture
def log(tmp_path: Path) -> Path:
    """The essential series of a run, on the real disk."""
    book = Logbook(FolderStorage(tmp_path), LogSettings(), LogIdentity("0.1.0", 0xBEEF, "mine", 0.0), 0.0)
    for second in range(30):
        t = float(second)
        book.append(CTD, (t, 3.5, 10.25, inf if second == 3 else 7.0))
        book.append(DECISION, (t, 1, 0.0, 0.0, 1, 1, 7, 0, 2, 0.5))
        if second % 10 == 5:
            book.event(t, "safety:leak", f"water in the bow, {second}")
        book.step(t)
    book.append(HULL, (30.0, 8e4, 20.0, False, True, True))
    book.sync(30.0)
    (found,) = tmp_path.glob("*.log")
    assert found.name == "00000-000001-essential.log"
    return found


def answer(*arguments: object) -> dict[str, object]:
    done = CliRunner().invoke(app, ["vehicle", "log", *map(str, arguments), "--json"])
    assert done.exit_code == 0, done.output
    found: dict[str, object] = json.loads(done.stdout)
    return found


def test_counts_events_and_header(log: Path) -> None:
    found = answer(log)
    assert (found["status"], found["records"], found["missing"], found["bytes"]) == ("whole", 64, 0, log.stat().st_size)
    assert found["kinds"] == [
        {"kind": "ctd", "records": 30, "first_s": 0.0, "last_s": 29.0},
        {"kind": "decision", "records": 30, "first_s": 0.0, "last_s": 29.0},
        {"kind": "event", "records": 3, "first_s": 5.0, "last_s": 25.0},
        {"kind": "hull", "records": 1, "first_s": 30.0, "last_s": 30.0},
    ]
    assert found["events"] == [
        {"t_s": t, "code": "safety:leak", "reason": f"water in the bow, {t:.0f}"} for t in (5.0, 15.0, 25.0)
    ]
    assert found["header"]["database_hash"] == "00beef"  # type: ignore[index]
    rows = answer(log, "--kind", "ctd")["rows"]
    assert rows[3] == {"t": 3.0, "conductivity": 3.5, "temperature": 10.25, "pressure": None}  # type: ignore[index]
    assert len(rows) == 30  # type: ignore[arg-type]


def test_the_terminal_tells_it_in_words(log: Path) -> None:
    done = CliRunner().invoke(app, ["vehicle", "log", str(log), "--kind", "decision"])
    assert done.exit_code == 0, done.output
    for words in ("whole, 64 records", "mine", "stommel 0.1.0, CAN database 00beef", "1970-01-01 00:00:00 UTC",
                  "after 0 restarts", "25.00 s  safety:leak", "water in the bow, 25", "phase descent",
                  "event target depth reached", "heading_wanted 0.5 rad", "the last 20 of 30 are shown"):  # fmt: skip
        assert words in " ".join(done.output.split()) or words in done.output, words
    assert re.search(r"(?m)^\s*ctd +30 +0\.00 +29\.00", done.output)


def test_a_cut_and_a_damaged_log_say_where(log: Path) -> None:
    data = log.read_bytes()
    log.write_bytes(data[:-3])
    found = answer(log)
    assert (found["status"], found["valid_records"]) == ("truncated", 63)
    assert found["verdict"] == f"truncated after record 63 at byte {found['valid_bytes']}"
    at = data.index(b"water in the bow, 15")
    log.write_bytes(data[:at] + b"W" + data[at + 1 :])
    assert answer(log)["status"] == "corrupt"
    assert (answer(log, "--salvage")["records"], answer(log, "--salvage")["missing"]) == (63, 1)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("nowhere.log",), "nowhere.log: cannot be read: No such file or directory"),
        (("LOG", "--kind", "evnt"), "holds no such records; did you mean event? it has battery, ctd, decision"),
        (("OTHER",), "is no log of a vehicle: it does not begin with 'stommel log 1'"),
    ],
)
def test_what_is_no_log_is_refused(log: Path, arguments: tuple[str, ...], words: str) -> None:
    from stommel.errors import StommelError

    other = log.with_name("other.log")
    other.write_text("t,depth\n")
    places = {"LOG": str(log), "OTHER": str(other)}
    done = CliRunner().invoke(app, ["vehicle", "log", *(places.get(word, word) for word in arguments)])
    assert done.exit_code != 0
    assert isinstance(done.exception, StommelError)
    assert words in str(done.exception)


def test_a_folder_keeps_what_it_is_told(tmp_path: Path) -> None:
    """The edge: what the disk in memory of the other tests stands for."""
    storage = FolderStorage(tmp_path / "new" / "folder")
    file = storage.create("a")
    file.write(b"one")
    file.write(b"two")
    file.sync()
    file.close()
    with pytest.raises(FileExistsError):
        storage.create("a")
    storage.create("b").close()
    assert storage.sizes() == {"a": 6, "b": 0}
    storage.rename("a", "b")
    assert storage.read("b") == b"onetwo"
    storage.remove("b")
    assert storage.sizes() == {}
    with pytest.raises(FileNotFoundError):
        storage.read("b")
