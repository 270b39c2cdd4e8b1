"""Many rows at once, which may replace those of the same key, in SQLite and PostgreSQL.

The statements are written here once for each table and given to the driver with plain tuples: SQLAlchemy's own way
takes a dictionary a row, which at thousands of rows a second is most of the work.
"""

from collections.abc import Sequence
from functools import lru_cache
from typing import Any, Literal

from sqlalchemy import Connection, Dialect, Table

Known = Literal["fail", "replace", "keep"]
"""What becomes of a row whose key is there: an error, the new values, or the old ones."""


def insert_rows(
    connection: Connection,
    table: Table,
    columns: tuple[str, ...],
    rows: Sequence[tuple[Any, ...]],
    known: Known = "fail",
) -> None:
    """Write rows of these columns; with 'replace', no key may be in `rows` twice."""
    if not rows:
        return
    dialect = connection.dialect
    statement = _statement(table, columns, known, dialect)
    if dialect.name == "sqlite":
        connection.exec_driver_sql(statement, list(rows))
    else:  # one statement, whose parameters are a list a column
        connection.exec_driver_sql(statement, tuple(list(column) for column in zip(*rows, strict=True)))


@lru_cache(maxsize=64)  # an engine has a dialect of its own
def _statement(table: Table, columns: tuple[str, ...], known: Known, dialect: Dialect) -> str:
    quote = dialect.identifier_preparer.quote
    names = ", ".join(map(quote, columns))
    if dialect.name == "sqlite":
        values = f"VALUES ({', '.join('?' * len(columns))})"
    else:
        kinds = [table.c[name].type.compile(dialect) for name in columns]
        values = f"SELECT * FROM unnest({', '.join(f'%s::{kind}[]' for kind in kinds)})"
    return f"INSERT INTO {quote(table.name)} ({names}) {values} {_conflict(table, columns, known, dialect)}"


def _conflict(table: Table, columns: tuple[str, ...], known: Known, dialect: Dialect) -> str:
    if known == "fail":
        return ""
    if known == "keep":
        return "ON CONFLICT DO NOTHING"
    quote = dialect.identifier_preparer.quote
    key = [column.name for column in table.primary_key.columns]
    new = ", ".join(f"{quote(name)} = excluded.{quote(name)}" for name in columns if name not in key)
    return f"ON CONFLICT ({', '.join(map(quote, key))}) DO UPDATE SET {new}"
