"""One station for an archive: two would both speak to the same vehicles."""

from contextlib import ExitStack
from threading import Lock

from sqlalchemy import Connection, text
from sqlalchemy.exc import DBAPIError

from stommel.archive import Archive, ArchiveError
from stommel.archive.address import file_of
from stommel.archive.errors import telling
from stommel.files.folder_lock import FolderInUseError, locked

STATION_LOCK = 0x73746174696F6E
"""Number of the lock in PostgreSQL, where locks have numbers: "station" in ASCII; writers have another one."""


class ArchiveInUseError(ArchiveError):
    """Another station writes to the archive."""


def hold_archive(archive: Archive, held: ExitStack) -> None:
    """Keep other stations off an archive until `held` is closed; commands that only read or add people may come.

    Raises
    ------
    ArchiveInUseError
        Another station has it.
    OSError
        The lock beside a file of SQLite cannot be made.
    """
    file = file_of(archive.url)
    if file is None:
        place = _Place(archive)
        held.callback(place.give_up)
        with telling(archive.name):
            place.keep()
        archive.before_writing = place.keep
        return
    try:
        # beside the file: whoever opened and closed the file itself would drop the locks of SQLite
        beside = file.with_name(f"{file.name}-station")
        beside.touch()
        held.enter_context(locked(beside))
    except FolderInUseError:
        raise _in_use(archive) from None


class _Place:
    """The only station's place at a server of PostgreSQL: a lock of one connection, which a restart of the server ends.

    Whoever writes looks first whether it is still held, and takes it again if nobody else has. So nothing is written
    by a station that another one has followed.
    """

    def __init__(self, archive: Archive) -> None:
        self._archive = archive
        self._one_at_a_time = Lock()
        self._connection: Connection | None = None

    def keep(self) -> None:
        """Hold the place.

        Raises
        ------
        ArchiveInUseError
            Another station has it.
        DBAPIError
            The server does not answer.
        """
        with self._one_at_a_time:
            if self._connection is not None and not _is_alive(self._connection):
                self._connection = None
            if self._connection is None:
                self._connection = self._taken()

    def _taken(self) -> Connection:
        connection = self._archive.engine.connect().execution_options(isolation_level="AUTOCOMMIT")
        connection.detach()  # closed, it must not go back to the pool: the lock is the connection's
        is_ours = False
        try:
            is_ours = connection.execute(
                text("SELECT pg_try_advisory_lock(:number)"), {"number": STATION_LOCK}
            ).scalar_one()
        finally:
            if not is_ours:
                connection.close()
        if not is_ours:
            raise _in_use(self._archive)
        return connection

    def give_up(self) -> None:
        """Let another station come."""
        with self._one_at_a_time:
            if self._connection is not None:
                self._connection.close()
                self._connection = None


def _is_alive(connection: Connection) -> bool:
    """Whether a connection, and with it its lock, is still there; one that is not is closed."""
    try:
        connection.execute(text("SELECT 1"))
    except DBAPIError:
        connection.close()
        return False
    return True


def _in_use(archive: Archive) -> ArchiveInUseError:
    return ArchiveInUseError(
        f"database = {archive.name}: another station uses it; end that one, or give another --database"
    )
