"""Opening a file of SQLite so that nothing is left beside it and nothing in it changes."""

import sqlite3
from pathlib import Path

_JOURNAL = slice(18, 20)
"""Bytes of the file's head that say how it keeps its journal; https://www.sqlite.org/fileformat2.html, 1.3.3."""
_WRITE_AHEAD = b"\x02\x02"


def quietly_opened(file: Path) -> sqlite3.Connection:
    """A connection that only reads.

    One to a file with a write-ahead log makes files beside it, and only a connection that may write takes these away
    again.

    Raises
    ------
    sqlite3.Error
        It cannot be opened.
    """
    with file.open("rb") as opened:
        mode = "rw" if opened.read(_JOURNAL.stop)[_JOURNAL] == _WRITE_AHEAD else "ro"
    connection = sqlite3.connect(
        f"{file.absolute().as_uri()}?mode={mode}", uri=True, timeout=5.0, isolation_level=None, check_same_thread=False
    )
    connection.execute("PRAGMA query_only = ON").close()
    return connection
