"""Connections to the database of an archive, set up so that what was committed stays."""

from typing import Any

from sqlalchemy import URL, Connection, Engine, create_engine, event, text

from stommel.archive.address import file_of

WRITING = "stommel_writing"
"""Execution option of a connection that is going to write."""

_GREATEST_POOL = 24
_ONE_WRITER = 0x73746F6D6D656C
"""Number of the lock that writers take in PostgreSQL; no other may have it, as that of the only station."""


def engine_of(url: URL, busy_timeout_s: float) -> Engine:
    """The engine of an archive; nothing is opened yet.

    A transaction begins when SQLAlchemy says so, and one that writes takes the only place of a writer at once, so that
    it never finds in its middle that another was faster.
    """
    common: dict[str, Any] = {"pool_size": _GREATEST_POOL, "max_overflow": 0, "pool_timeout": max(busy_timeout_s, 1.0)}
    if file_of(url) is not None:
        engine = create_engine(url, connect_args={"timeout": busy_timeout_s}, **common)
        event.listen(engine, "connect", _prepare_sqlite)
        event.listen(engine, "begin", _begin_sqlite)
        return engine
    options = f"-c lock_timeout={round(busy_timeout_s * 1000)} -c timezone=UTC"
    engine = create_engine(url, pool_pre_ping=True, connect_args={"options": options, "connect_timeout": 10}, **common)
    event.listen(engine, "begin", _begin_postgresql)
    return engine


def _prepare_sqlite(connection: Any, _record: object) -> None:
    connection.isolation_level = None  # Python begins no transactions of its own
    for pragma in ("journal_mode=WAL", "synchronous=FULL", "foreign_keys=ON", "journal_size_limit=67108864"):
        connection.execute(f"PRAGMA {pragma}").close()


def _begin_sqlite(connection: Connection) -> None:
    writing = connection.get_execution_options().get(WRITING, False)
    connection.exec_driver_sql("BEGIN IMMEDIATE" if writing else "BEGIN")


def _begin_postgresql(connection: Connection) -> None:
    if connection.get_execution_options().get(WRITING, False):
        connection.execute(text("SELECT pg_advisory_xact_lock(:number)"), {"number": _ONE_WRITER})
