"""A mission that is corrected, taken back, or not heard in time. Oracle: which orders the vehicle held."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from stommel.archive import ArchiveBusyError
from stommel.station.station import Station
from stommel.station.vehicles.mission_rows import MissionRows
from tests.station.client import Client
from tests.station.served import Served, served
from tests.station.speaker import until
from tests.station.stations import station
from tests.station.vehicles.test_missions import OTHER, holds, states, upload
from tests.support.orders import ORDERS

CORRECTED = ORDERS.replace("There and back", "Corrected")
HAS_NOT = "the vehicle has not switched to it"


@contextmanager
def under_water(folder: Path) -> Iterator[tuple[Served, Station, Client]]:
    """A vehicle that is out of reach until a test lets it come up."""
    with served() as vehicle:
        holds(vehicle, ORDERS)
        vehicle.under_water = True
        with station(folder, vehicle.address) as found:
            yield vehicle, found, Client(found)


def flown(vehicle: Served) -> list[bytes]:
    """Orders that the vehicle has held, the first first."""
    return list(vehicle.missions.files)


def mission(client: Client, id: int) -> Any:
    return client.get(f"/vehicles/1/missions/{id}")


def test_a_corrected_mission_comes_in_place_of_the_one_that_waits(tmp_path: Path) -> None:
    """The wrong one is never flown, and its history says what came in its place, and by whom."""
    with under_water(tmp_path) as (vehicle, found, client):
        wrong = upload(client, OTHER)
        right = upload(client, CORRECTED)
        until(lambda: states(found)[:2] == [("Corrected", "waiting"), ("Another way", "superseded")])
        step = mission(client, wrong["id"])["history"][-1]
        assert step["user"] == "local"
        assert step["words"].startswith("“Corrected” of local came in its place; ")
        assert HAS_NOT in step["words"]
        assert client.get("/vehicles/1/mission")["upload"]["id"] == right["id"]
        vehicle.under_water = False
        until(lambda: ("Corrected", "aboard") in states(found))
        assert flown(vehicle) == [ORDERS.encode(), CORRECTED.encode()]


def test_a_mission_that_waits_is_taken_back_and_never_sent(tmp_path: Path) -> None:
    with under_water(tmp_path) as (vehicle, found, client):
        row = upload(client, OTHER)
        assert row["expires"] == pytest.approx(row["t"] + 86_400.0, abs=5.0)
        answer = client.request("DELETE", f"/vehicles/1/missions/{row['id']}")
        assert (answer.status_code, answer.json()["state"], answer.json()["expires"]) == (200, "cancelled", None)
        assert "taken back by local" in answer.json()["words"]
        assert HAS_NOT in answer.json()["words"]
        assert client.get("/vehicles/1/mission")["upload"] is None
        again = client.refused("DELETE", f"/vehicles/1/missions/{row['id']}", 409)
        assert "cannot be taken back any more; it is cancelled" in again["reason"]
        client.refused("DELETE", "/vehicles/1/missions/777", 404)
        vehicle.under_water = False
        until(lambda: ("in memory", "aboard") in states(found))
        assert flown(vehicle) == [ORDERS.encode()]
        assert ("Another way", "cancelled") in states(found)


def test_one_that_is_aboard_cannot_be_taken_back(tmp_path: Path) -> None:
    with served() as vehicle, station(tmp_path, vehicle.address) as found:
        client = Client(found)
        row = upload(client, OTHER)
        until(lambda: ("Another way", "aboard") in states(found))
        assert "it is aboard" in client.refused("DELETE", f"/vehicles/1/missions/{row['id']}", 409)["reason"]
        assert flown(vehicle)[-1] == OTHER.encode()


def test_what_nobody_can_know_is_asked_of_the_vehicle(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It was told to switch, and its answer is lost: the words say so, and what it holds in the end is told."""
    with served() as vehicle, station(tmp_path, vehicle.address) as found:
        client = Client(found)
        check, speak, told = vehicle.missions.check, vehicle.session.poll, list[bool]()

        def checked() -> None:
            check()
            monkeypatch.setattr(vehicle.session, "poll", lambda *_: b"")
            told.append(True)

        vehicle.missions.check = checked  # type: ignore[method-assign]
        row = upload(client, OTHER)
        until(lambda: told)
        answer = client.request("DELETE", f"/vehicles/1/missions/{row['id']}").json()
        assert answer["state"] == "cancelled"
        assert "may have switched to it already, and is asked" in answer["words"]
        monkeypatch.setattr(vehicle.session, "poll", speak)
        until(lambda: ("Another way", "aboard") in states(found))
        steps = [step["state"] for step in mission(client, row["id"])["history"]]
        assert steps == ["waiting", "sending", "cancelled", "aboard"]


def test_what_is_not_heard_in_time_is_over_and_never_sent(tmp_path: Path) -> None:
    """Half a second instead of the minute that the public door allows at least."""
    with under_water(tmp_path) as (vehicle, found, client):
        row = found.missions.upload(1, "ada", OTHER, valid_for_s=0.5)
        until(lambda: states(found) == [("Another way", "expired")])
        words = mission(client, row.id)["words"]
        assert "its time was over" in words
        assert HAS_NOT in words
        vehicle.under_water = False
        until(lambda: ("in memory", "aboard") in states(found))
        assert flown(vehicle) == [ORDERS.encode()]


def test_the_return_to_the_mission_before_is_seen_and_taken_back(tmp_path: Path) -> None:
    with served() as vehicle:
        holds(vehicle, ORDERS)
        with station(tmp_path, vehicle.address) as found:
            client = Client(found)
            upload(client, OTHER)
            until(lambda: client.get("/vehicles/1/mission")["previous_sha256"])
            until(lambda: client.get("/vehicles/1/mission")["waiting"] == 0)
            vehicle.under_water = True
            told = client.post("/vehicles/1/mission/roll-back")["roll_back"]
            assert told["user"] == "local"
            assert told["expires"] == pytest.approx(found.now(1) + 86_400.0, abs=60.0)
            left = client.request("DELETE", "/vehicles/1/mission/roll-back").json()
            assert left["roll_back"] is None
            assert "not rolled back: taken back by local" in left["missing"]
            client.refused("DELETE", "/vehicles/1/mission/roll-back", 409)
            vehicle.under_water = False
            until(lambda: found.vehicles[1].status().heard)
            assert flown(vehicle)[-1] == OTHER.encode()


def test_an_archive_that_is_busy_takes_nothing_back(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What could not be written down was not done: the mission still waits."""
    with under_water(tmp_path) as (_, found, client):
        row = upload(client, OTHER)

        def busy(*_: Any) -> None:
            raise ArchiveBusyError("archive.sqlite: another program is writing to the archive")

        with monkeypatch.context() as patched:
            patched.setattr(MissionRows, "change", busy)
            client.refused("DELETE", f"/vehicles/1/missions/{row['id']}", 503)
        assert states(found) == [("Another way", "waiting")]
        assert client.get("/vehicles/1/mission")["upload"]["id"] == row["id"]
