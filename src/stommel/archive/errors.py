"""What can go wrong with an archive, told so that a person can mend it."""

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager

from sqlalchemy.exc import DataError, DBAPIError, IntegrityError
from sqlalchemy.exc import TimeoutError as NoConnectionError

from stommel.errors import StommelError, one_line

_LONGEST_REASON = 200


class ArchiveError(StommelError):
    """The archive cannot do what was asked; the message says why and what to do."""


class ArchiveBusyError(ArchiveError):
    """Somebody else is writing to the archive for longer than anybody waits; it may be tried again."""


class ArchiveFullError(ArchiveError):
    """The archive cannot grow: the disk is full, or must not be written to."""


class ArchiveBrokenError(ArchiveError):
    """The file is no archive, or is damaged; it has been left as it is."""


class ArchiveRequestError(ArchiveError):
    """A value that no archive takes."""


@contextmanager
def telling(name: str) -> Iterator[None]:
    """Turn errors of the database named `name` into sentences; a broken rule of a table stays what it is.

    Raises
    ------
    ArchiveError
        Of the kind that fits.
    """
    try:
        yield
    except IntegrityError:
        raise
    except (DataError, OverflowError, UnicodeEncodeError) as error:  # the last two by drivers, before they ask
        raise ArchiveRequestError(f"{name}: a value that the database does not take: {_reason(error)}") from error
    except DBAPIError as error:
        raise _told(name, error.orig) from error
    except sqlite3.Error as error:  # while rows are read
        raise _told(name, error) from error
    except NoConnectionError as error:
        raise ArchiveBusyError(f"{name}: too many queries at once; try again in a moment") from error


def _told(name: str, origin: BaseException | None) -> ArchiveError:
    code = getattr(origin, "sqlite_errorname", None) or getattr(origin, "sqlstate", None) or ""
    for kind, codes, words in _SENTENCES:
        if code.startswith(codes):
            return kind(f"{name}: {words}")
    reason = _reason(origin)
    if isinstance(origin, sqlite3.Error):
        return ArchiveError(f"{name}: the archive cannot be used: {reason}")
    return ArchiveError(f"{name}: the database server does not do it: {reason}; see that it runs and lets you in")


def _reason(error: BaseException | None) -> str:
    origin = error.orig if isinstance(error, DBAPIError) else error
    return one_line(" ".join(str(origin).split()), _LONGEST_REASON)


_FULL = "the disk is full; free some room there, nothing that was stored is lost"
_READ_ONLY = "the archive must not be written to; allow it (file and folder), or name another place"
_BUSY = "another program is writing to the archive; close it, or try again in a moment"

_SENTENCES: tuple[tuple[type[ArchiveError], tuple[str, ...], str], ...] = (
    (ArchiveBusyError, ("SQLITE_BUSY", "SQLITE_LOCKED", "55P03", "40001", "40P01"), _BUSY),
    (ArchiveFullError, ("SQLITE_FULL", "53100"), _FULL),
    (ArchiveFullError, ("SQLITE_READONLY", "25006", "42501"), _READ_ONLY),
    (
        ArchiveFullError,
        ("SQLITE_IOERR", "58030"),
        "the disk does not take what is written; see that it is there, has room, and is sound",
    ),
    (ArchiveRequestError, ("SQLITE_TOOBIG", "54"), "a value that is longer than the database takes"),
    (
        ArchiveError,
        ("SQLITE_CANTOPEN",),
        "the file cannot be opened or made; see that its folder is there and may be written to",
    ),
    (
        ArchiveBrokenError,
        ("SQLITE_NOTADB", "SQLITE_CORRUPT", "XX001", "XX002"),
        "this is no archive, or a damaged one; it has been left as it is: restore a backup, or name another file",
    ),
)
