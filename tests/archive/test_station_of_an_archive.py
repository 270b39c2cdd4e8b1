"""A station writes to either database, and never beside another station, whatever becomes of the server.

Oracle: rows of the archive, and PostgreSQL's own list of who holds the lock.
"""

import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
from sqlalchemy import Connection, create_engine, func, select, text

from stommel.archive import Archive, FrameRow
from stommel.archive.rows import Batch
from stommel.archive.schema import frames
from stommel.station.sole import STATION_LOCK, ArchiveInUseError
from tests.station.client import Client
from tests.station.speaker import Speaker, speaker, until
from tests.station.stations import station

T = 1_700_000_000.0
ROW = FrameRow(T, "in", 1, 1, 0, 0, False, b"\xfd")


def came(archive: Archive) -> int:
    with archive.reading() as connection:
        return connection.execute(
            select(func.count()).select_from(frames).where(frames.c.direction == "in")
        ).scalar_one()


@pytest.fixture
def other(database: str) -> Iterator[Connection]:
    """Another program at the server."""
    if database.startswith("sqlite"):
        pytest.skip("a file has no server")
    engine = create_engine(database, isolation_level="AUTOCOMMIT")
    with engine.connect() as connection:
        yield connection
    engine.dispose()


def holders(other: Connection) -> list[int]:
    """Processes of the server that hold the station's lock."""
    number = "(classid::bigint << 32) + objid::bigint"
    query = text(f"SELECT pid FROM pg_locks WHERE locktype = 'advisory' AND granted AND {number} = :number")
    return list(other.execute(query, {"number": STATION_LOCK}).scalars())


def cut_all(other: Connection) -> None:
    """End all connections but this one, as a restart of the server does."""
    other.execute(
        text(
            "SELECT pg_terminate_backend(pid, 5000) FROM pg_stat_activity"
            " WHERE datname = current_database() AND pid <> pg_backend_pid()"
        )
    )


def heard(vehicle: Speaker, archive: Archive) -> None:
    """Say something, and wait until the archive has it."""
    before = came(archive)
    vehicle.say("HEARTBEAT", type=12)
    until(lambda: came(archive) > before)


def test_a_station_keeps_what_comes_in_either_database(tmp_path: Path, database: str) -> None:
    with speaker() as vehicle, station(tmp_path, vehicle.address, database=database) as found:
        vehicle.connect()
        vehicle.say("GLIDER_STATE", time_boot_ms=1, depth=1.5)
        until(lambda: found.archive.latest(1).get("depth_m", (0, 0))[1] == 1.5)
        assert Client(found).get("/vehicles")[0]["vehicle"] == 1


def test_a_second_station_is_refused_in_either_database(tmp_path: Path, database: str) -> None:
    with (
        station(tmp_path / "one", database=database),
        pytest.raises(ArchiveInUseError, match="another station uses it"),
    ):
        station(tmp_path / "two", database=database).__enter__()
    with station(tmp_path / "two", database=database) as again:
        again.archive.store(1, Batch([ROW]))


def test_a_station_takes_its_place_again_when_the_server_was_restarted(
    tmp_path: Path, database: str, other: Connection
) -> None:
    with speaker() as vehicle, station(tmp_path, vehicle.address, database=database) as found:
        vehicle.connect()
        heard(vehicle, found.archive)
        (before,) = holders(other)
        cut_all(other)
        until(lambda: holders(other) not in ([], [before]))
        heard(vehicle, found.archive)
        with pytest.raises(ArchiveInUseError):
            station(tmp_path / "two", database=database).__enter__()
    until(lambda: holders(other) == [])  # the server learns of it a moment later


def test_a_station_whose_place_another_has_taken_writes_no_more_and_says_so(
    tmp_path: Path, database: str, other: Connection
) -> None:
    rival = create_engine(database, isolation_level="AUTOCOMMIT")
    with speaker() as vehicle, station(tmp_path, vehicle.address, database=database) as found, rival.connect() as waits:
        vehicle.connect()
        heard(vehicle, found.archive)
        (ours,) = holders(other)
        take = threading.Thread(
            target=lambda: waits.execute(text("SELECT pg_advisory_lock(:n)"), {"n": STATION_LOCK}), daemon=True
        )
        take.start()
        until(lambda: other.execute(text("SELECT count(*) FROM pg_locks WHERE NOT granted")).scalar_one() == 1)
        other.execute(text("SELECT pg_terminate_backend(:pid)"), {"pid": ours})
        take.join(10.0)
        before = came(found.archive)
        vehicle.say("HEARTBEAT", type=12)
        until(lambda: "another station uses it" in found.vehicles[1].status().archive)
        until(lambda: "archive_failing" in {alarm.key for alarm in found.alarms.open_of(None)})
        assert came(found.archive) == before
        with pytest.raises(ArchiveInUseError):
            found.archive.know(9, "x", "")
        waits.close()
        rival.dispose()
        until(lambda: came(found.archive) > before)
        until(lambda: not found.vehicles[1].status().archive)
