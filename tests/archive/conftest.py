"""The same archive in both databases."""

from collections.abc import Callable, Iterator
from itertools import count
from pathlib import Path

import pytest
from sqlalchemy import create_engine, make_url, text

from stommel.archive import Archive
from tests.archive import servers


@pytest.fixture(scope="session")
def postgres_server() -> Iterator[str]:
    if servers.programs() is None:
        pytest.skip("PostgreSQL (initdb, postgres) is not installed")
    with servers.postgres() as address:
        yield address


_numbers = count(1)


@pytest.fixture(params=["sqlite", "postgresql"])
def database(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    """The address of an empty database of each kind."""
    if request.param == "sqlite":
        return f"sqlite:///{tmp_path / 'archive.sqlite'}"
    server = make_url(request.getfixturevalue("postgres_server"))
    name = f"archive_{next(_numbers)}"
    engine = create_engine(server, isolation_level="AUTOCOMMIT")
    with engine.connect() as connection:
        connection.execute(text(f"CREATE DATABASE {name}"))
    engine.dispose()
    return server.set(database=name).render_as_string(hide_password=False)


@pytest.fixture
def archive(database: str) -> Iterator[Archive]:
    with Archive.open(database) as opened:
        yield opened


@pytest.fixture
def sqlite_archive(tmp_path: Path) -> Iterator[Archive]:
    with Archive.open(str(tmp_path / "archive.sqlite")) as opened:
        yield opened


@pytest.fixture
def opened(tmp_path: Path) -> Iterator[Callable[..., Archive]]:
    """Opens archives that are closed at the end."""
    archives: list[Archive] = []

    def open_one(url: str, **options: float) -> Archive:
        archives.append(Archive.open(url, **options))
        return archives[-1]

    yield open_one
    for archive in archives:
        archive.close()
