"""Missions at the station. Oracle: what the vehicle's side of the link holds, byte for byte."""

import hashlib
from pathlib import Path
from typing import Any

import pytest

from stommel.archive import ArchiveBusyError
from stommel.errors import StommelError
from stommel.station.station import Station
from stommel.station.vehicles import asking
from stommel.station.vehicles.mission_rows import MissionRows
from stommel.station.vehicles.missions import MissionError
from stommel.station.vehicles.opening import VehicleError
from tests.plans.plans import place, plan_with
from tests.station.client import Client
from tests.station.served import Served, served
from tests.station.speaker import until
from tests.station.stations import station
from tests.support.orders import ORDERS

OTHER = ORDERS.replace("There and back", "Another way")


def states(found: Station) -> list[tuple[str, str]]:
    return [(row.name, row.state) for row in found.missions.list(1, 10)]


def holds(vehicle: Served, orders: str) -> None:
    """Let the vehicle hold these orders from the beginning."""
    vehicle.missions.files = [orders.encode()]
    vehicle.files.files["missions", "active.orders"] = orders.encode()


def upload(client: Client, orders: str) -> Any:
    return client.post("/vehicles/1/mission", {"orders": orders})


def test_the_mission_that_the_vehicle_holds_is_found_and_fetched(tmp_path: Path) -> None:
    with served() as vehicle:
        holds(vehicle, ORDERS)
        with station(tmp_path, vehicle.address) as found:
            client = Client(found)
            until(lambda: client.get("/vehicles/1/mission")["mission"])
            told = client.get("/vehicles/1/mission")
            assert told["sha256"] == hashlib.sha256(ORDERS.encode()).hexdigest()
            assert (told["mission"]["user"], told["depth_m"]) == (None, 100.0)
            assert told["waypoints"][0]["latitude"] == pytest.approx(29.793, abs=1e-2)
            assert states(found) == [("in memory", "aboard")]
            assert client.get(f"/vehicles/1/missions/{told['mission']['id']}")["orders"] == ORDERS


def test_a_mission_is_kept_with_who_and_hash_and_arrives_whole(tmp_path: Path) -> None:
    with served() as vehicle:
        holds(vehicle, ORDERS)
        with station(tmp_path, vehicle.address) as found:
            client = Client(found)
            row = upload(client, OTHER)
            assert (row["user"], row["state"]) == ("local", "waiting")
            assert row["sha256"] == hashlib.sha256(OTHER.encode()).hexdigest()
            until(lambda: ("Another way", "aboard") in states(found))
            assert vehicle.missions.files[-1] == OTHER.encode()
            until(lambda: client.get("/vehicles/1/mission")["sha256"] == row["sha256"])
            steps = [each["state"] for each in client.get(f"/vehicles/1/missions/{row['id']}")["history"]]
            assert steps == ["waiting", "sending", "aboard"]


def test_the_geofence_of_its_plan_is_told_with_the_mission_aboard(tmp_path: Path) -> None:
    """Orders have no geofence: it is of the plan out of which they were made, and a map draws it."""
    corners = [place(28.0, 126.0), place(29.0, 126.0), place(29.0, 127.0)]
    with served() as vehicle, station(tmp_path, vehicle.address) as found:
        client = Client(found)
        until(lambda: found.vehicles[1].status().heard)
        found.missions.upload(1, "ada", OTHER, plan=plan_with(geofence=corners), valid_for_s=600.0)
        until(lambda: client.get("/vehicles/1/mission")["mission"])
        told = client.get("/vehicles/1/mission")["geofence"]
        assert told == [{"latitude": each["latitude_deg"], "longitude": each["longitude_deg"]} for each in corners]
        older = found.missions.upload(1, "ada", ORDERS, plan={"of": "another age"}, valid_for_s=600.0)
        until(lambda: client.get("/vehicles/1/mission")["sha256"] == older.sha256)
        assert client.get("/vehicles/1/mission")["geofence"] == []


def test_roll_back_brings_the_mission_before_back(tmp_path: Path) -> None:
    with served() as vehicle:
        holds(vehicle, ORDERS)
        with station(tmp_path, vehicle.address) as found:
            client = Client(found)
            until(lambda: ("in memory", "aboard") in states(found))
            with pytest.raises(MissionError, match="before the present"):
                found.missions.roll_back(1, "ada", 600.0)
            upload(client, OTHER)
            until(lambda: client.get("/vehicles/1/mission")["previous_sha256"])
            client.post("/vehicles/1/mission/roll-back")
            until(lambda: vehicle.missions.files[-1] == ORDERS.encode())
            until(lambda: states(found) == [("Another way", "replaced"), ("in memory", "aboard")])


def test_what_the_vehicle_refuses_is_told_in_its_words_and_changes_nothing(tmp_path: Path) -> None:
    with served() as vehicle, station(tmp_path, vehicle.address) as found:

        def refuse() -> None:
            from stommel.errors import FileError, Problem

            raise FileError([Problem("mission", "dives.depth_m", "dives.depth_m = 100: must be at most 60 m")])

        vehicle.missions.check = refuse  # type: ignore[method-assign]
        client = Client(found)
        row = upload(client, OTHER)
        until(lambda: ("Another way", "refused") in states(found))
        history = client.get(f"/vehicles/1/missions/{row['id']}")["history"]
        assert "must be at most 60 m" in history[-1]["words"]
        assert vehicle.missions.files == [b"the first orders"]


@pytest.mark.parametrize("state", ["sending", "refused"])
def test_an_archive_that_is_busy_for_a_moment_loses_no_word_of_a_mission(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, state: str
) -> None:
    """Oracle: the states that a mission takes where the archive is not busy, of the test above."""
    change, failed = MissionRows.change, list[str]()

    def busy_once(rows: MissionRows, id: int, to: str, *rest: Any) -> None:
        if to == state and not failed:
            failed.append(to)
            raise ArchiveBusyError("archive.sqlite: another program is writing to the archive")
        change(rows, id, to, *rest)

    monkeypatch.setattr(MissionRows, "change", busy_once)
    with served() as vehicle, station(tmp_path, vehicle.address) as found:

        def refuse() -> None:
            raise StommelError("mission: too deep")

        vehicle.missions.check = refuse  # type: ignore[method-assign]
        client = Client(found)
        row = upload(client, OTHER)
        until(lambda: ("Another way", "refused") in states(found))
        history = client.get(f"/vehicles/1/missions/{row['id']}")["history"]
        assert [step["state"] for step in history] == ["waiting", "sending", "refused"]
        assert failed == [state]


def test_a_mission_that_a_busy_line_does_not_take_waits_for_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(asking, "ANSWER_WITHIN", 0.1)
    with served() as vehicle, station(tmp_path, vehicle.address, start=False) as found:
        with pytest.raises(VehicleError, match="nothing was done"):
            found.missions.upload(1, "ada", OTHER, valid_for_s=600.0)
        assert states(found) == [("Another way", "failed")]


def test_what_is_no_mission_is_refused_before_it_goes_to_sea(tmp_path: Path) -> None:
    with served() as vehicle, station(tmp_path, vehicle.address, start=False) as found:
        client = Client(found)
        for body in (
            {"orders": "nonsense"},
            {"orders": ORDERS, "plan": {}},
            {},
            {"orders": ORDERS.replace("100.0", "nan")},
        ):
            assert client.refused("POST", "/vehicles/1/mission", 422, json=body)["reason"]
        client.refused("GET", "/vehicles/1/missions/77", 404)
        assert states(found) == []


def test_a_mission_on_its_way_when_the_station_stops_goes_on_after_the_vehicle_has_said_what_it_holds(
    tmp_path: Path,
) -> None:
    with served() as vehicle:
        holds(vehicle, ORDERS)
        with station(tmp_path, vehicle.address) as found:
            until(lambda: ("in memory", "aboard") in states(found))
            vehicle.under_water = True
            upload(Client(found), OTHER)
            until(lambda: states(found)[0][1] == "sending")
        with station(tmp_path, vehicle.address) as again:
            assert states(again) == [("Another way", "sending"), ("in memory", "aboard")]
            vehicle.under_water = False
            until(lambda: states(again) == [("Another way", "aboard"), ("in memory", "replaced")])
            assert vehicle.missions.files == [ORDERS.encode(), OTHER.encode()]


def test_a_mission_refused_under_water_is_sent_again_at_the_surface(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The vehicle's own words of refusal; one on a cable is heard under water. Oracle: what it holds in the end."""
    from stommel.station.vehicles import mission_follower

    monkeypatch.setattr(mission_follower, "AGAIN", 1.0)
    dives = [True]
    with served() as vehicle, station(tmp_path, vehicle.address) as found:
        check = vehicle.missions.check

        def checked() -> None:
            if dives[0]:
                raise StommelError("mission: the vehicle is under water; send it at the surface")
            check()

        vehicle.missions.check = checked  # type: ignore[method-assign]
        client = Client(found)
        row = upload(client, OTHER)
        until(lambda: "under water" in client.get(f"/vehicles/1/missions/{row['id']}")["words"])
        assert ("Another way", "waiting") in states(found) or ("Another way", "sending") in states(found)
        dives[0] = False
        until(lambda: ("Another way", "aboard") in states(found))
        assert vehicle.missions.files[-1] == OTHER.encode()
