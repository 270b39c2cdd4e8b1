"""One station for an archive: two would both speak to the same vehicles."""

from contextlib import ExitStack

from sqlalchemy import text

from stommel.archive import Archive
from stommel.archive.address import file_of
from stommel.errors import StommelError
from stommel.files.folder_lock import FolderInUseError, locked

_LOCK = 0x73746F6D6D656C
"""Number of the lock in PostgreSQL, where locks have numbers: "stommel" in ASCII."""


class ArchiveInUseError(StommelError):
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
    try:
        if file is None:
            _hold_server(archive, held)
        else:
            # beside the file: whoever opened and closed the file itself would drop the locks of SQLite
            beside = file.with_name(f"{file.name}-station")
            beside.touch()
            held.enter_context(locked(beside))
    except FolderInUseError:
        raise ArchiveInUseError(
            f"database = {archive.name}: another station uses it; end that one, or give another --database"
        ) from None


def _hold_server(archive: Archive, held: ExitStack) -> None:
    connection = archive.engine.connect()
    held.callback(connection.close)
    if not connection.execute(text("select pg_try_advisory_lock(:number)"), {"number": _LOCK}).scalar_one():
        raise FolderInUseError
    connection.commit()  # the lock is of the connection, not of the transaction
