"""An archive that fails: nothing is acknowledged that is not kept, nothing is lost, and people are told.

Oracle: the vehicle, which keeps count of what the station has said, and the rows of the archive afterwards.
"""

import sqlite3
import threading
import time
from functools import partial
from pathlib import Path

import pytest
from sqlalchemy import func, select

from stommel.archive import Archive, ArchiveBusyError, ArchiveFullError, ArchiveRequestError, Batch
from stommel.archive.schema import frames
from stommel.files.folder_lock import FolderInUseError, locked
from stommel.station.settings import load_settings
from stommel.station.station import Station
from stommel.station.vehicles import ingest
from stommel.station.vehicles.opening import VehicleError, vehicle_folder
from tests.station.client import Client
from tests.station.speaker import Speaker, speaker, until
from tests.station.stations import station
from tests.support.ports import port_of_nobody

ASK = {"tc1": 0, "ts1": 123_456_789}


def came(found: Station) -> int:
    """Frames of the vehicle that the archive has."""
    with found.archive.reading() as connection:
        chosen = select(func.count()).select_from(frames).where(frames.c.direction == "in")
        return int(connection.execute(chosen).scalar_one())


def answers(vehicle: Speaker) -> int:
    """How often the station has answered a TIMESYNC: its link's acknowledgement that it has heard."""
    return sum(
        frame.message.name == "TIMESYNC" and frame.message.unpack(frame.payload)["tc1"] != 0
        for frame in vehicle.listen()
    )


def fail(archive: Archive, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise ArchiveFullError("archive.sqlite: the disk is full; free some room there")

    monkeypatch.setattr(archive, "store", full)


def test_what_comes_while_the_disk_is_full_is_answered_only_when_it_is_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with speaker() as vehicle, station(tmp_path, vehicle.address) as found:
        vehicle.connect()
        vehicle.say("HEARTBEAT", type=12)
        until(lambda: came(found) == 1)
        with monkeypatch.context() as broken:
            fail(found.archive, broken)
            for k in range(200):
                vehicle.say("TIMESYNC", tc1=0, ts1=k + 1)
            until(lambda: found.vehicles[1].status().archive)
            until(lambda: found.vehicles[1].status().waiting >= 200)
            time.sleep(0.5)
            assert answers(vehicle) == 0, "nothing is acknowledged that is not kept"
            link = Client(found).get("/vehicles/1/link")
            assert "free some room" in link["archive"]
        until(lambda: came(found) == 201)
        until(lambda: answers(vehicle) >= 1)
        until(lambda: not found.vehicles[1].status().archive)


def test_a_database_that_another_program_locks_is_waited_for(tmp_path: Path) -> None:
    with (
        speaker() as vehicle,
        station(tmp_path, vehicle.address, database=f"sqlite:///{tmp_path / 'a.sqlite'}") as found,
    ):
        vehicle.connect()
        vehicle.say("HEARTBEAT", type=12)
        until(lambda: came(found) == 1)
        other = sqlite3.connect(tmp_path / "a.sqlite", isolation_level=None)
        other.execute("BEGIN IMMEDIATE")
        for k in range(50):
            vehicle.say("GLIDER_STATE", time_boot_ms=k, depth=float(k))
        until(lambda: "another program" in found.vehicles[1].status().archive)
        assert came(found) == 1
        other.execute("ROLLBACK")
        other.close()
        until(lambda: came(found) == 51)
        until(lambda: not found.vehicles[1].status().archive)
        assert found.hub.values(1)["depth_m"][1] == 49.0


def test_what_waits_is_bounded_and_the_line_is_not_read_beyond(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ingest, "MOST_FRAMES", 500)
    with speaker() as vehicle, station(tmp_path, vehicle.address) as found:
        vehicle.connect()
        with monkeypatch.context() as broken:
            fail(found.archive, broken)
            for k in range(300):
                vehicle.say("GLIDER_STATE", time_boot_ms=k, depth=float(k))
            until(lambda: found.vehicles[1].status().waiting >= 300)
            for k in range(10_000):
                vehicle.say("GLIDER_STATE", time_boot_ms=k, depth=float(k))
            until(lambda: found.vehicles[1].status().waiting >= 500)
            time.sleep(0.3)
            assert found.vehicles[1].status().waiting < 500 + 65_536 // 20
        until(lambda: came(found) == 10_300, within=240.0)


def test_a_row_that_no_archive_takes_does_not_stop_the_rest(tmp_path: Path) -> None:
    with speaker() as vehicle, station(tmp_path, vehicle.address) as found:
        vehicle.connect()
        vehicle.say("DIVE_SUMMARY", time_begin_unix_ms=2**63, time_end_unix_ms=2**64 - 1, dive=65_535)
        vehicle.say("CTD_SAMPLE", time_unix_ms=2**64 - 1, pressure=float("nan"), temperature=float("inf"))
        vehicle.say("SYSTEM_TIME", time_unix_usec=2**64 - 1, time_boot_ms=2**32 - 1)
        vehicle.say("GLIDER_STATE", time_boot_ms=2**32 - 1, depth=float("-inf"), altitude=1e38, alarms=2**64 - 1)
        until(lambda: came(found) == 4)
        assert found.summary(1)["vehicle"] == 1
        client = Client(found)
        client.get("/vehicles")
        client.get("/vehicles/1/latest")
        client.get("/vehicles/1/frames")
        assert found.vehicles[1].failures == 0


def test_an_archive_that_was_busy_once_is_tried_again_though_the_vehicle_is_silent(tmp_path: Path) -> None:
    looks = []

    class Unlucky:
        def look(self, *_: object) -> None:
            looks.append(True)
            if len(looks) == 1:
                raise ArchiveBusyError("archive.sqlite: another program is writing to the archive")

    with port_of_nobody() as port, station(tmp_path, f"tcp:127.0.0.1:{port}", start=False) as found:
        found.vehicles[1].followers.append(Unlucky())
        found.start()
        until(lambda: len(looks) > 1)
        until(lambda: not found.vehicles[1].archive_reason)


def test_a_row_of_a_follower_that_no_archive_takes_holds_nothing_up(tmp_path: Path) -> None:
    class Wrong:
        def look(self, *_: object) -> None:
            raise ArchiveRequestError("a time of -1 s since 1970")

    with port_of_nobody() as port, station(tmp_path, f"tcp:127.0.0.1:{port}", start=False) as found:
        found.vehicles[1].followers.append(Wrong())
        found.start()
        until(lambda: "Wrong failed" in found.vehicles[1].failure)
        assert found.vehicles[1].archive_reason == ""


def test_a_follower_that_fails_ends_nothing(tmp_path: Path) -> None:
    """hardbyte/python-can#1667: an exception does not end the receiving thread."""

    class Weak:
        def look(self, *_: object) -> None:
            raise ZeroDivisionError

    with speaker() as vehicle, station(tmp_path, vehicle.address, start=False) as found:
        found.vehicles[1].followers.append(Weak())
        found.start()
        vehicle.connect()
        vehicle.say("GLIDER_STATE", time_boot_ms=1, depth=1.0)
        until(lambda: "ZeroDivisionError" in " ".join(found.vehicles[1].status().notes))
        vehicle.say("GLIDER_STATE", time_boot_ms=2, depth=2.0)
        until(lambda: found.hub.values(1).get("depth_m", (0, 0))[1] == 2.0)
        until(lambda: "HEARTBEAT" in vehicle.names())


def test_people_see_that_the_archive_fails_while_it_does(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whoever watches is told at once by the vehicle's summary, not when the archive is well again."""

    def told() -> set[str]:
        while (message := news.collect()) is not None:
            if message["type"] == "summary":
                heard.append({alarm["key"] for alarm in message["summary"]["alarms"]})
        return heard[-1] if heard else set()

    heard: list[set[str]] = []
    with speaker() as vehicle, station(tmp_path, vehicle.address) as found:
        news = found.hub.watch()
        vehicle.connect()
        vehicle.say("HEARTBEAT", type=12)
        until(lambda: came(found) == 1)
        with monkeypatch.context() as broken:
            fail(found.archive, broken)
            vehicle.say("HEARTBEAT", type=12)
            until(lambda: "archive_failing" in told())


def test_a_line_that_a_slow_disk_holds_keeps_its_folder_and_archive_until_it_has_ended(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Another station that came meanwhile would speak to the same vehicle, and write between its rows."""
    begun, goes_on = threading.Event(), threading.Event()
    with speaker() as vehicle:
        found = Station(load_settings(None, {"folder": tmp_path, "vehicles": [
            {"vehicle": 1, "link": vehicle.address, "unsigned": True}
        ]}))  # fmt: skip
        store = found.archive.store

        def slow(number: int, batch: Batch) -> None:
            begun.set()
            goes_on.wait(60.0)
            store(number, batch)

        monkeypatch.setattr(found.archive, "store", slow)
        found.start()
        vehicle.connect()
        vehicle.say("GLIDER_STATE", time_boot_ms=1, depth=4.5)
        begun.wait(60.0)
        monkeypatch.setattr(found.vehicles[1], "stop", partial(found.vehicles[1].stop, 0.1))
        found.stop()
        with pytest.raises(VehicleError, match="another station uses it"), station(tmp_path, vehicle.address):
            pass
        with pytest.raises(FolderInUseError), locked(vehicle_folder(tmp_path, 1) / "link"):
            pass
        goes_on.set()
        until(lambda: not any(thread.name == "station ends" for thread in threading.enumerate()))
        with station(tmp_path, vehicle.address, start=False) as again:
            assert again.archive.latest(1)["depth_m"][1] == 4.5
