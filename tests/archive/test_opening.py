"""Whoever opens an archive that cannot be used is told what happened and what to do, and it is left as it is."""

import os
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import textwrap
from collections.abc import Callable
from hashlib import sha256
from pathlib import Path

import pytest
from alembic.autogenerate import compare_metadata
from alembic.migration import MigrationContext
from alembic.script import ScriptDirectory
from sqlalchemy import Engine, create_engine, event, inspect, make_url, text

from stommel.archive import (
    Archive,
    ArchiveBrokenError,
    ArchiveBusyError,
    ArchiveError,
    ArchiveFullError,
    ArchiveRequestError,
    Batch,
    FrameRow,
    migrating,
)
from stommel.archive.backup import back_up
from stommel.archive.columns import metadata
from stommel.archive.looking import looking
from stommel.archive.soundness import soundness_of

T = 1_700_000_000.0
SAMPLES = Batch(samples=[("depth_m", T, 1.0)])


def content(file: Path) -> str:
    return sha256(file.read_bytes()).hexdigest()


def test_the_migrations_make_the_tables_of_the_schema(archive: Archive) -> None:
    with archive.reading() as connection:
        assert compare_metadata(MigrationContext.configure(connection), metadata) == []
        assert set(inspect(connection).get_table_names()) == {*metadata.tables, "alembic_version"}


def test_samples_and_cells_lie_in_the_order_of_their_key(sqlite_archive: Archive) -> None:
    """Alembic does not compare this, and long ranges are slow without it."""
    query = text("SELECT name FROM sqlite_master WHERE type = 'table' AND sql LIKE '%WITHOUT ROWID%'")
    with sqlite_archive.reading() as connection:
        assert set(connection.execute(query).scalars()) == {
            "samples",
            "minutes",
            "ten_minutes",
            "ctd",
            "ctd_hours",
            "profiles",
        }


def test_the_version_is_the_last_of_the_migrations() -> None:
    assert ScriptDirectory(str(Path(migrating.__file__).with_name("migrations"))).get_heads() == [migrating.CURRENT]


def test_what_was_stored_is_there_after_opening_again(database: str) -> None:
    with Archive.open(database) as archive:
        archive.store(1, SAMPLES)
    with Archive.open(database) as archive:
        assert archive.latest(1) == {"depth_m": (T, 1.0)}


def test_tables_that_are_made_halfway_are_not_there(database: str) -> None:
    """As after a loss of power in the middle of a migration."""

    def fail(_connection: object, _cursor: object, statement: str, *_: object) -> None:
        if "CREATE TABLE tokens" in statement:
            raise ZeroDivisionError

    event.listen(Engine, "before_cursor_execute", fail)
    try:
        with pytest.raises(ZeroDivisionError):
            Archive.open(database)
    finally:
        event.remove(Engine, "before_cursor_execute", fail)
    engine = create_engine(database)
    with engine.connect() as connection:
        assert inspect(connection).get_table_names() == []
    engine.dispose()
    with Archive.open(database) as archive:
        archive.store(1, SAMPLES)


def test_a_server_that_was_started_again_is_found_again(opened: Callable[..., Archive], postgres_server: str) -> None:
    archive = opened(postgres_server)
    archive.store(1, SAMPLES)
    other = create_engine(postgres_server)
    with other.connect() as connection:
        others = "SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE pid <> pg_backend_pid()"
        connection.execute(text(f"{others} AND datname = current_database()"))
    other.dispose()
    archive.store(1, Batch(samples=[("depth_m", T + 1, 2.0)]))
    assert archive.latest(1) == {"depth_m": (T + 1, 2.0)}


def test_an_archive_of_a_newer_version_is_refused_and_left(database: str) -> None:
    with Archive.open(database) as archive, archive.writing() as connection:
        connection.execute(text("UPDATE alembic_version SET version_num = 'stommel_9999'"))
    for _ in range(2):
        with pytest.raises(ArchiveError, match="a newer version of stommel wrote this archive"):
            Archive.open(database)


def test_a_database_of_another_program_is_refused_and_left(database: str) -> None:
    engine = create_engine(database)
    with engine.begin() as connection:
        connection.execute(text("CREATE TABLE mine (a INTEGER)"))
    with pytest.raises(ArchiveBrokenError, match="belongs to another program"):
        Archive.open(database)
    with engine.connect() as connection:
        assert inspect(connection).get_table_names() == ["mine"]
    engine.dispose()


def test_a_database_with_migrations_of_another_program_is_refused(database: str) -> None:
    engine = create_engine(database)
    with engine.begin() as connection:
        connection.execute(text("CREATE TABLE alembic_version (version_num VARCHAR(32))"))
        connection.execute(text("INSERT INTO alembic_version VALUES ('1a2b3c')"))
    engine.dispose()
    with pytest.raises(ArchiveBrokenError, match="belongs to another program"):
        Archive.open(database)


@pytest.mark.parametrize("bad", [b"time,depth\n1,2\n" * 100, b"SQLite format 3\x00" + bytes(84), os.urandom(8192)])
def test_a_file_that_is_no_archive_is_named_and_left(tmp_path: Path, bad: bytes) -> None:
    file = tmp_path / "notes.txt"
    file.write_bytes(bad)
    with pytest.raises(ArchiveBrokenError, match=r"notes\.txt: this is no archive, or a damaged one; it has been left"):
        Archive.open(str(file))
    assert file.read_bytes() == bad
    assert [path.name for path in tmp_path.iterdir()] == ["notes.txt"]


def test_a_foreign_file_of_sqlite_is_not_touched(tmp_path: Path) -> None:
    file = tmp_path / "other.sqlite"
    other = sqlite3.connect(file)
    other.execute("CREATE TABLE mine (a)")
    other.commit()
    other.close()
    before = content(file)
    with pytest.raises(ArchiveBrokenError):
        Archive.open(str(file))
    assert content(file) == before
    assert [path.name for path in tmp_path.iterdir()] == ["other.sqlite"]


def test_damage_in_the_middle_of_the_file_is_told_when_it_is_read(tmp_path: Path) -> None:
    file = tmp_path / "archive.sqlite"
    with Archive.open(str(file)) as archive:
        archive.store(1, Batch(samples=[("depth_m", T + k, 1.0 * k) for k in range(20_000)]))
    data = bytearray(file.read_bytes())
    data[len(data) // 4 : len(data) * 3 // 4] = os.urandom(len(data) * 3 // 4 - len(data) // 4)
    file.write_bytes(data)

    def look() -> None:
        with Archive.open(str(file)) as archive:
            archive.series(1, "depth_m", T, T + 20_000, method="raw")
            archive.latest(1)
            archive.store(1, SAMPLES)

    with pytest.raises(ArchiveBrokenError, match="restore a backup"):
        look()


def test_an_empty_file_becomes_an_archive(tmp_path: Path) -> None:
    (tmp_path / "new.sqlite").touch()
    with Archive.open(str(tmp_path / "new.sqlite")) as archive:
        archive.store(1, SAMPLES)


def test_folders_above_a_new_archive_are_made(tmp_path: Path) -> None:
    with Archive.open(f"sqlite:///{tmp_path / 'a' / 'b' / 'c.sqlite'}") as archive:
        archive.store(1, SAMPLES)
    assert (tmp_path / "a" / "b" / "c.sqlite").exists()


def test_a_folder_that_cannot_be_made_is_named(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(ArchiveFullError, match="its folder cannot be made"):
        Archive.open(str(tmp_path / "file" / "sub" / "c.sqlite"))


def test_a_folder_in_place_of_the_file_is_told(tmp_path: Path) -> None:
    with pytest.raises(ArchiveError, match="cannot be opened or made"):
        Archive.open(str(tmp_path))


@pytest.mark.parametrize(
    ("url", "words"),
    [
        ("mysql://keeper:secret@host/db", "no such kind of database"),
        ("sqlite://", "needs a file"),
        (":memory:", "needs a file"),
        ("sqlite:///file:x?mode=memory", "needs a file"),
        ("postgresql+psycopg2://keeper:secret@host/db", "no such driver"),
        ("postgresql://keeper:secret@host:port/db", "cannot be read"),
        ("://", "cannot be read"),
        ("", "needs a file"),
    ],
)
def test_an_address_that_is_none_is_told_without_its_password(url: str, words: str) -> None:
    with pytest.raises(ArchiveRequestError, match=words) as caught:
        Archive.open(url)
    assert "secret" not in str(caught.value)
    assert "sqlite:///FILE" in str(caught.value)


def test_a_server_that_does_not_answer_is_told_without_the_password(tmp_path: Path) -> None:
    with pytest.raises(ArchiveError, match="see that it runs and lets you in") as caught:
        Archive.open(f"postgresql://keeper:secret@/none?host={tmp_path}")
    assert "secret" not in str(caught.value)
    assert "\n" not in str(caught.value)


def test_another_program_that_writes_is_told_and_everything_stored_afterwards(database: str) -> None:
    """A second program, here a second archive, holds the place of the writer."""
    with Archive.open(database) as other, Archive.open(database, busy_timeout_s=0.3) as archive:
        with other.writing():
            with pytest.raises(ArchiveBusyError, match="another program is writing to the archive"):
                archive.store(1, SAMPLES)
            assert archive.latest(1) == {}
        archive.store(1, SAMPLES)
        assert archive.latest(1) == {"depth_m": (T, 1.0)}


def test_a_thread_that_writes_for_long_is_told(database: str) -> None:
    with (
        Archive.open(database, busy_timeout_s=0.2) as archive,
        archive.writing(),
        pytest.raises(ArchiveBusyError, match="busy writing; try again"),
    ):
        archive.store(1, SAMPLES)


def test_a_full_disk_is_told_and_nothing_that_was_stored_is_lost(tmp_path: Path) -> None:
    """`max_page_count` makes SQLite meet a full disk: its error is the same."""
    with Archive.open(str(tmp_path / "archive.sqlite")) as archive:
        archive.store(1, SAMPLES)
        with archive.reading() as connection:
            pages = connection.exec_driver_sql("PRAGMA page_count").scalar_one()
        archive.engine.dispose()
        limit = f"PRAGMA max_page_count={pages + 8}"
        event.listen(archive.engine, "connect", lambda connection, _: connection.execute(limit).close())
        frame = FrameRow(T, "in", 1, 1, 30, 0, True, bytes(200))
        with pytest.raises(ArchiveFullError, match="the disk is full; free some room"):
            archive.store(1, Batch(frames=[frame] * 1000, samples=[("depth_m", T + 1, 2.0)]))
        assert archive.frames(1) == []
        assert archive.latest(1) == {"depth_m": (T, 1.0)}
        archive.store(1, Batch(samples=[("depth_m", T + 2, 3.0)]))
        assert archive.latest(1) == {"depth_m": (T + 2, 3.0)}


SMALL_DISK = """
    import sys
    from stommel.archive import *
    archive = Archive.open(sys.argv[1])
    stored = 0
    frame = FrameRow(1.7e9, "in", 1, 1, 30, 0, True, bytes(250))
    try:
        while True:
            archive.store(1, Batch(frames=[frame] * 100))
            stored += 1
    except ArchiveFullError as error:
        print(stored, error)
"""


def test_a_file_that_may_not_grow_is_told_and_what_was_stored_is_there(tmp_path: Path) -> None:
    """The system itself refuses to write, as on a full disk: RLIMIT_FSIZE, as ulimit -f."""
    file = tmp_path / "archive.sqlite"
    Archive.open(str(file)).close()
    limit = "import resource\nresource.setrlimit(resource.RLIMIT_FSIZE, (2_000_000, 2_000_000))\n"
    limited = limit + textwrap.dedent(SMALL_DISK)
    run = subprocess.run([sys.executable, "-c", limited, str(file)], capture_output=True, text=True, check=True)
    stored, words = run.stdout.split(" ", 1)
    assert "disk" in words
    assert int(stored) > 5
    with Archive.open(str(file)) as archive:
        assert len(archive.frames(1, limit=10_000)) == 100 * int(stored)


AS_NOBODY = """
    import os, sys
    from stommel.archive import *
    Archive.open(sys.argv[1]).close()  # everything is imported while it may be read
    if os.geteuid() == 0:
        os.setgroups([]); os.setgid(65534); os.setuid(65534)
    for path in sys.argv[2:]:
        try:
            Archive.open(path).store(1, Batch(samples=[("depth_m", 1.7e9, 2.0)]))
            print("stored")
        except ArchiveError as error:
            print(type(error).__name__, error)
"""


def test_a_folder_that_must_not_be_written_to_is_told(tmp_path: Path) -> None:
    """Read by a user who is not root, whom nothing keeps from writing."""
    folder = Path(tempfile.mkdtemp(prefix="read_only"))  # in one that everybody may look into
    try:
        Archive.open(str(folder / "there.sqlite")).close()
        before = content(folder / "there.sqlite")
        (folder / "there.sqlite").chmod(0o444)
        folder.chmod(0o555)
        paths = [str(folder / "there.sqlite"), str(folder / "new.sqlite"), str(folder / "sub" / "new.sqlite")]
        code = [sys.executable, "-c", textwrap.dedent(AS_NOBODY), str(tmp_path / "first.sqlite")]
        run = subprocess.run([*code, *paths], capture_output=True, text=True, check=True)
        there, new, below = run.stdout.splitlines()
        assert "must not be written to; allow it" in there
        assert "cannot be opened or made; see that its folder is there and may be written to" in new
        assert "its folder cannot be made" in below
        assert content(folder / "there.sqlite") == before
    finally:
        folder.chmod(0o755)
        shutil.rmtree(folder)


def test_errors_name_the_file(tmp_path: Path, opened: Callable[..., Archive]) -> None:
    archive = opened(str(tmp_path / "sea.sqlite"), busy_timeout_s=0.1)
    other = opened(str(tmp_path / "sea.sqlite"))
    with other.writing(), pytest.raises(ArchiveBusyError, match=r"sea\.sqlite: "):
        archive.store(1, SAMPLES)


def test_looking_leaves_nothing_beside_the_file(tmp_path: Path) -> None:
    file = tmp_path / "sea.sqlite"
    with Archive.open(str(file)) as archive:
        archive.store(1, SAMPLES)
    before = content(file)
    for _ in range(2):
        assert soundness_of(str(file)).problems == ()
    back_up(str(file), tmp_path / "copy.sqlite")
    assert soundness_of(str(tmp_path / "copy.sqlite")).problems == ()
    assert content(file) == before
    assert sorted(path.name for path in tmp_path.iterdir()) == ["copy.sqlite", "sea.sqlite"]


def test_nobody_writes_by_looking(database: str) -> None:
    Archive.open(database).close()
    with pytest.raises(ArchiveFullError, match="must not be written to"), looking(make_url(database)) as connection:
        connection.execute(text("DELETE FROM notes"))
