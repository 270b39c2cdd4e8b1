"""Where an archive is: a file of SQLite, or a database of PostgreSQL."""

from pathlib import Path

from sqlalchemy import URL, make_url
from sqlalchemy.exc import ArgumentError

from stommel.archive.errors import ArchiveRequestError

_ALLOWED = "allowed are sqlite:///FILE and postgresql+psycopg://USER@HOST/DATABASE"


def address_of(text: str) -> URL:
    """The address that a person wrote; a bare path is a file of SQLite.

    Raises
    ------
    ArchiveRequestError
        It is none of what is allowed.
    """
    try:
        url = make_url(text) if "://" in text else URL.create("sqlite", database=text)
    except (ArgumentError, ValueError):
        raise ArchiveRequestError(f"the address of the archive cannot be read; {_ALLOWED}") from None
    kind = url.get_backend_name()
    if kind == "postgresql":
        if url.drivername not in ("postgresql", "postgresql+psycopg"):
            raise ArchiveRequestError(f"{shown(url)}: no such driver; {_ALLOWED}")
        return url.set(drivername="postgresql+psycopg")
    if kind != "sqlite" or url.drivername not in ("sqlite", "sqlite+pysqlite"):
        raise ArchiveRequestError(f"{shown(url)}: no such kind of database; {_ALLOWED}")
    if not url.database or url.database == ":memory:" or url.database.startswith("file:"):
        raise ArchiveRequestError(f"{shown(url)}: an archive needs a file; {_ALLOWED}")
    return url


def file_of(url: URL) -> Path | None:
    """The file of an archive in SQLite; None in PostgreSQL."""
    return Path(url.database) if url.get_backend_name() == "sqlite" and url.database else None


def shown(url: URL) -> str:
    """An address as a message names it: the file, or the address without its password."""
    return str(file_of(url) or url.render_as_string(hide_password=True))
