"""A backup is one file, whole, of one moment; the check finds what is wrong."""

import sqlite3
import threading
from pathlib import Path

import pytest
from sqlalchemy import text

from stommel.archive import Archive, ArchiveBrokenError, ArchiveRequestError, Batch, FrameRow
from stommel.archive.backup import back_up
from stommel.archive.soundness import soundness_of
from stommel.errors import OutputError

T = 1_700_000_000.0


def batch(k: int) -> Batch:
    frames = [FrameRow(T + k, "in", 1, 1, k, i, True, bytes(30)) for i in range(20)]
    return Batch(frames, [("depth_m", T + k + i / 20, float(k)) for i in range(20)])


def test_a_copy_taken_while_somebody_writes_is_of_one_moment(tmp_path: Path) -> None:
    url = str(tmp_path / "archive.sqlite")
    end = threading.Event()
    with Archive.open(url) as archive:
        archive.store(1, batch(0))

        def write() -> None:
            number = 1
            while not end.wait(0.001):
                archive.store(1, batch(number))
                number += 1

        writer = threading.Thread(target=write)
        writer.start()
        try:
            for k in range(5):
                assert back_up(url, tmp_path / f"copy{k}.sqlite") > 0
        finally:
            end.set()
            writer.join()
    for k in range(5):
        copy = tmp_path / f"copy{k}.sqlite"
        found = soundness_of(str(copy))
        assert found.problems == ()
        assert found.rows["frames"] == found.rows["samples"]
        assert found.rows["frames"] % 20 == 0
        with Archive.open(str(copy)) as restored:
            assert restored.frames(1, limit=1)[0].row.message_id == found.rows["frames"] // 20 - 1
    assert sorted(path.name for path in tmp_path.iterdir() if path.suffix == ".part") == []


def test_a_copy_replaces_an_older_one_whole(tmp_path: Path) -> None:
    copy = tmp_path / "copy.sqlite"
    copy.write_bytes(b"older")
    with Archive.open(str(tmp_path / "archive.sqlite")) as archive:
        archive.store(1, batch(0))
        back_up(str(tmp_path / "archive.sqlite"), copy)
    assert soundness_of(str(copy)).rows["frames"] == 20


def test_a_copy_that_fails_leaves_the_older_one(tmp_path: Path) -> None:
    copy = tmp_path / "copy.sqlite"
    copy.write_bytes(b"older")
    file = tmp_path / "archive.sqlite"
    with Archive.open(str(file)) as archive:
        archive.store(1, Batch(samples=[("depth_m", T + k, 1.0 * k) for k in range(20_000)]))
    data = bytearray(file.read_bytes())
    data[len(data) // 2 : len(data) // 2 + 20_000] = bytes(20_000)
    file.write_bytes(data)
    with pytest.raises(ArchiveBrokenError, match="the copy is not sound, and was not kept"):
        back_up(str(file), copy)
    assert copy.read_bytes() == b"older"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["archive.sqlite", "copy.sqlite"]


@pytest.mark.parametrize("name", ["archive.sqlite", "archive.sqlite-wal", "link"])
def test_a_copy_never_replaces_the_archive(tmp_path: Path, name: str) -> None:
    with Archive.open(str(tmp_path / "archive.sqlite")) as archive:
        archive.store(1, batch(0))
        (tmp_path / "link").symlink_to(tmp_path / "archive.sqlite")
        with pytest.raises(ArchiveRequestError, match="for the copy"):
            back_up(str(tmp_path / "archive.sqlite"), tmp_path / name)
        archive.store(1, batch(1))
        assert len(archive.frames(1)) == 40


def test_a_copy_of_nothing_is_refused_and_nothing_made(tmp_path: Path) -> None:
    with pytest.raises(ArchiveRequestError, match="there is no archive"):
        back_up(str(tmp_path / "none.sqlite"), tmp_path / "copy.sqlite")
    with pytest.raises(ArchiveRequestError, match="there is no archive"):
        soundness_of(str(tmp_path / "none.sqlite"))
    assert list(tmp_path.iterdir()) == []


def test_a_place_that_takes_no_copy_is_named(tmp_path: Path) -> None:
    Archive.open(str(tmp_path / "archive.sqlite")).close()
    with pytest.raises(OutputError, match="it is a folder"):
        back_up(str(tmp_path / "archive.sqlite"), tmp_path)


def test_postgresql_is_backed_up_by_its_own_program() -> None:
    with pytest.raises(ArchiveRequestError, match=r"pg_dump --format=custom --file=copy\.dump") as caught:
        back_up("postgresql://keeper:secret@host/sea", Path("copy.dump"))
    assert "secret" not in str(caught.value)


def test_a_sound_archive_is_found_sound_while_it_is_open(archive: Archive) -> None:
    for k in range(200):
        archive.store(1, batch(k))
    found = soundness_of(archive.url.render_as_string(hide_password=False))
    assert (found.problems, found.current) == ((), True)
    assert (found.rows["frames"], found.rows["samples"], found.rows["minutes"]) == (4000, 4000, 4)


@pytest.mark.parametrize(
    "harm",
    [
        "UPDATE samples SET value = 1e9 WHERE t_us = (SELECT min(t_us) FROM samples)",
        "DELETE FROM samples WHERE t_us = (SELECT max(t_us) FROM samples)",
        "DELETE FROM minutes",
        "UPDATE minutes SET low = low - 1",
        "DROP TABLE notes",
    ],
)
def test_harm_is_found(archive: Archive, harm: str) -> None:
    archive.store(1, batch(3))
    with archive.writing() as connection:
        connection.execute(text(harm))
    found = soundness_of(archive.url.render_as_string(hide_password=False))
    assert any("do not fit the samples" in words or "notes is missing" in words for words in found.problems)


def test_a_reference_to_nothing_is_found(sqlite_archive: Archive) -> None:
    sqlite_archive.store(1, batch(0))
    file = str(sqlite_archive.url.database)
    other = sqlite3.connect(file)  # which does not look at references
    other.execute("DELETE FROM vehicles")
    other.commit()
    other.close()
    found = soundness_of(file)
    assert "a row of frames names one of vehicles that is not there" in found.problems
