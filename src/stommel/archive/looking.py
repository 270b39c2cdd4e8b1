"""Looking at an archive without changing anything: not its version, not its file."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from sqlalchemy import URL, Connection, Engine, NullPool, create_engine

from stommel.archive.address import file_of, shown
from stommel.archive.connecting import engine_of
from stommel.archive.errors import ArchiveRequestError, telling
from stommel.archive.migrating import require_ours
from stommel.archive.quiet_opening import quietly_opened


def require_there(url: URL) -> None:
    """Refuse a file of SQLite that is missing, empty, or no archive.

    Raises
    ------
    ArchiveRequestError
        Nothing is there.
    ArchiveBrokenError
        Something else is.
    """
    file = file_of(url)
    if file is None:
        return
    if not file.is_file() or file.stat().st_size == 0:
        raise ArchiveRequestError(f"{file}: there is no archive; name the file that the station writes to")
    require_ours(file)


@contextmanager
def looking(url: URL) -> Iterator[Connection]:
    """A connection to an archive that is there, of whatever version, which can only read.

    Raises
    ------
    ArchiveError
        There is none, or it cannot be read.
    """
    require_there(url)
    file = file_of(url)
    engine = engine_of(url, 5.0) if file is None else _reader_of(file)
    try:
        with telling(shown(url)), engine.connect() as connection:
            if file is None:
                connection.exec_driver_sql("SET TRANSACTION READ ONLY")
            yield connection
    finally:
        engine.dispose()


def _reader_of(file: Path) -> Engine:
    return create_engine("sqlite://", creator=lambda: quietly_opened(file), poolclass=NullPool)
