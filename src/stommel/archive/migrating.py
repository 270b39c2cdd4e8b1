"""Bringing an archive to the tables of this version; one of a newer version, or of another program, is refused."""

import sqlite3
from pathlib import Path

from sqlalchemy import Connection, inspect, text

from stommel.archive.errors import ArchiveBrokenError, ArchiveError
from stommel.archive.quiet_opening import quietly_opened

CURRENT = "stommel_0005"
"""The version of schema.py: the last of migrations/versions."""

_OURS = "stommel_"
_MIGRATIONS = Path(__file__).with_name("migrations")


def require_ours(file: Path) -> None:
    """Refuse a file of SQLite that is not ours to write to, before anything opens it for writing.

    Raises
    ------
    ArchiveBrokenError
        It is no database, is damaged, or belongs to another program.
    """
    if not file.exists() or file.stat().st_size == 0:
        return
    try:
        connection = quietly_opened(file)
        try:
            names = {row[0] for row in connection.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
        finally:
            connection.close()
    except (OSError, sqlite3.Error) as error:
        if getattr(error, "sqlite_errorname", "").startswith(("SQLITE_NOTADB", "SQLITE_CORRUPT")):
            raise ArchiveBrokenError(
                f"{file}: this is no archive, or a damaged one; it has been left as it is: restore a backup, or name"
                " another file"
            ) from error
        return  # locked or so: told when it is opened
    _require_version_table(str(file), names)


def migrate(connection: Connection, name: str) -> None:
    """Bring the tables up to date, inside the transaction of `connection`.

    Raises
    ------
    ArchiveError
        The archive was written by a newer version.
    ArchiveBrokenError
        The database belongs to another program.
    """
    names = set(inspect(connection).get_table_names())
    _require_version_table(name, names)
    version = version_of(connection) if names else None
    if version == CURRENT:
        return
    _upgrade(connection, name, version)


def version_of(connection: Connection) -> str | None:
    """The version that the archive says it has."""
    return connection.execute(text("SELECT version_num FROM alembic_version")).scalar()


def _require_version_table(name: str, tables: set[str]) -> None:
    if tables and "alembic_version" not in tables:
        raise ArchiveBrokenError(
            f"{name}: this database belongs to another program; it has been left as it is: name another one"
        )


def _upgrade(connection: Connection, name: str, version: str | None) -> None:
    from alembic.config import Config  # noqa: PLC0415 - takes time that an up-to-date archive saves
    from alembic.runtime.environment import EnvironmentContext  # noqa: PLC0415
    from alembic.script import ScriptDirectory  # noqa: PLC0415

    config = Config()
    config.set_main_option("script_location", str(_MIGRATIONS).replace("%", "%%"))
    scripts = ScriptDirectory.from_config(config)
    if version is not None and version not in {script.revision for script in scripts.walk_revisions()}:
        if version.startswith(_OURS):
            raise ArchiveError(
                f"{name}: a newer version of stommel wrote this archive ({version}; this one knows up to {CURRENT});"
                " install that version, or name another archive"
            )
        raise ArchiveBrokenError(
            f"{name}: this database belongs to another program; it has been left as it is: name another one"
        )
    with EnvironmentContext(config, scripts, fn=lambda revision, _: scripts._upgrade_revs(CURRENT, revision)) as steps:
        steps.configure(connection=connection, transactional_ddl=True)
        steps.run_migrations()
