"""A copy of an archive, taken while the station goes on writing to it."""

import sqlite3
from pathlib import Path

from stommel.archive.address import address_of, file_of, shown
from stommel.archive.errors import ArchiveBrokenError, ArchiveRequestError, telling
from stommel.archive.looking import require_there
from stommel.archive.quiet_opening import quietly_opened
from stommel.errors import OutputError
from stommel.files.whole import require_file, whole_file


def back_up(url: str, copy: Path) -> int:
    """Copy an archive in SQLite as it is at one moment into one file, which is found sound; its size in bytes.

    Parameters
    ----------
    url
        Of the archive; a station may be writing to it, and is not held up.
    copy
        Is written beside under another name and takes its name when it is whole; what stood there is replaced.

    Raises
    ------
    ArchiveRequestError
        There is no archive, the copy would replace it, or it is in PostgreSQL, which has programs for that.
    ArchiveError
        It cannot be read, or the copy is not sound.
    OutputError
        The copy cannot be written.
    """
    address = address_of(url)
    file = file_of(address)
    if file is None:
        raise ArchiveRequestError(
            f"{shown(address)}: an archive in PostgreSQL is backed up by its own program: pg_dump --format=custom"
            f" --file={copy} --dbname={_plain(address.render_as_string(hide_password=True))}"
        )
    require_there(address)
    require_file(copy)
    if copy.exists() and copy.samefile(file):
        raise ArchiveRequestError(f"{copy}: this is the archive itself; name another file for the copy")
    if copy.name in {f"{file.name}-wal", f"{file.name}-shm"} and copy.parent.absolute() == file.parent.absolute():
        raise ArchiveRequestError(f"{copy}: the archive itself uses this file; name another one for the copy")
    with whole_file(copy) as made, telling(str(file)):
        _copy(file, made)
    return copy.stat().st_size


def _plain(address: str) -> str:
    """An address as the programs of PostgreSQL take it."""
    return address.replace("postgresql+psycopg://", "postgresql://")


def _copy(file: Path, made: Path) -> None:
    source = quietly_opened(file)
    try:
        target = sqlite3.connect(made)
        try:
            _fill(source, target, made)
        finally:
            target.close()
    finally:
        source.close()


def _fill(source: sqlite3.Connection, target: sqlite3.Connection, made: Path) -> None:
    try:
        source.backup(target)
        target.execute("PRAGMA journal_mode = DELETE")  # one file, nothing beside it
        problems = [row[0] for row in target.execute("PRAGMA integrity_check(3)")]
    except sqlite3.Error as error:
        if error.sqlite_errorname.startswith(("SQLITE_FULL", "SQLITE_IOERR")):
            raise OutputError(
                f"{made.parent}: the copy cannot be written: {error}; free some room there, or name another place"
            ) from error
        raise
    if problems != ["ok"]:
        raise ArchiveBrokenError(f"the copy is not sound, and was not kept: {'; '.join(problems)}; run the check")
