"""Missions that are not over when the station stops. Oracle: which orders the vehicle held; what the archive had."""

import hashlib
import sqlite3
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

import pytest

from stommel.station.station import Station
from tests.station.client import Client
from tests.station.served import Served, served
from tests.station.speaker import until
from tests.station.stations import station
from tests.station.vehicles.test_missions import OTHER, holds, states, upload
from tests.station.vehicles.test_missions_taken_back import CORRECTED, HAS_NOT, flown, mission
from tests.support.orders import ORDERS


@contextmanager
def at_sea(folder: Path, *orders: str) -> Iterator[tuple[Served, list[int]]]:
    """A vehicle under water, whose station has stopped with these missions given in turn; and their numbers."""
    with served() as vehicle:
        holds(vehicle, ORDERS)
        vehicle.under_water = True
        with station(folder, vehicle.address) as found:
            ids = [upload(Client(found), each)["id"] for each in orders]
        yield vehicle, ids


def alter(folder: Path, change: str, *values: object) -> None:
    """Change the archive while no station has it."""
    with closing(sqlite3.connect(folder / "archive.sqlite")) as archive, archive:
        assert archive.execute(change, values).rowcount


def surfaces(vehicle: Served, found: Station) -> None:
    """Let the vehicle come up, and say which orders it holds."""
    vehicle.under_water = False
    until(lambda: Client(found).get("/vehicles/1/mission")["number"] is not None)


def test_one_that_waits_is_sent_by_the_next_station_in_the_time_that_it_had(tmp_path: Path) -> None:
    """Also where the archive does not know yet that it replaced another one: older stations wrote that later."""
    with at_sea(tmp_path, OTHER, CORRECTED) as (vehicle, (first, second)):
        alter(tmp_path, "UPDATE missions SET state = 'waiting' WHERE id = ?", first)
        with station(tmp_path, vehicle.address) as found:
            client = Client(found)
            told = client.get("/vehicles/1/mission")["upload"]
            assert (told["id"], told["state"], told["user"]) == (second, "waiting", "local")
            assert told["expires"] == pytest.approx(told["t"] + 86_400.0, abs=1.0)
            vehicle.under_water = False
            until(lambda: states(found)[0] == ("Corrected", "aboard"))
            assert flown(vehicle) == [ORDERS.encode(), CORRECTED.encode()]
            assert mission(client, first)["state"] == "superseded"


def test_one_that_waits_is_taken_back_from_the_next_station(tmp_path: Path) -> None:
    with at_sea(tmp_path, OTHER) as (vehicle, (id,)):
        with station(tmp_path, vehicle.address) as found:
            answer = Client(found).request("DELETE", f"/vehicles/1/missions/{id}").json()
            assert (answer["state"], HAS_NOT in answer["words"]) == ("cancelled", True)
        with station(tmp_path, vehicle.address) as found:
            surfaces(vehicle, found)
            assert mission(Client(found), id)["state"] == "cancelled"
            assert flown(vehicle) == [ORDERS.encode()]


def test_one_whose_time_ended_while_no_station_ran_is_told_and_never_sent(tmp_path: Path) -> None:
    with at_sea(tmp_path, OTHER) as (vehicle, (id,)):
        alter(tmp_path, "UPDATE missions SET until_us = ?", round((time.time() - 1.0) * 1e6))
        vehicle.under_water = False
        with station(tmp_path, vehicle.address) as found:
            until(lambda: mission(Client(found), id)["state"] == "expired")
            assert f"its time was over; {HAS_NOT}" in mission(Client(found), id)["words"]
            surfaces(vehicle, found)
            assert flown(vehicle) == [ORDERS.encode()]


def test_of_which_nobody_knows_how_long_it_is_tried_is_told_and_not_sent(tmp_path: Path) -> None:
    """An archive of a station that did not keep it."""
    with at_sea(tmp_path, OTHER) as (vehicle, (id,)):
        alter(tmp_path, "UPDATE missions SET until_us = NULL")
        with station(tmp_path, vehicle.address) as found:
            until(lambda: mission(Client(found), id)["state"] == "interrupted")
            assert "send it again" in mission(Client(found), id)["words"]
            surfaces(vehicle, found)
            assert flown(vehicle) == [ORDERS.encode()]


BAD = ORDERS.replace("100.0", "nan")


@pytest.mark.parametrize(
    ("orders", "sha256", "told"),
    [
        (ORDERS, hashlib.sha256(OTHER.encode()).hexdigest(), "their SHA-256 is another"),
        (BAD, hashlib.sha256(BAD.encode()).hexdigest(), "nan: must be a finite number"),
    ],
    ids=["damaged", "refused"],
)
def test_one_whose_orders_are_none_any_more_is_told_and_not_sent(
    tmp_path: Path, orders: str, sha256: str, told: str
) -> None:
    with at_sea(tmp_path, OTHER) as (vehicle, (id,)):
        alter(tmp_path, "UPDATE missions SET orders = ?, sha256 = ?", orders, sha256)
        with station(tmp_path, vehicle.address) as found:
            until(lambda: mission(Client(found), id)["state"] == "failed")
            words = mission(Client(found), id)["words"]
            assert told in words, words
            assert HAS_NOT in words
            surfaces(vehicle, found)
            assert flown(vehicle) == [ORDERS.encode()]


def test_one_that_was_flown_and_replaced_while_no_station_ran_is_not_flown_again(tmp_path: Path) -> None:
    """It was on its way; the vehicle had switched to it, and was given another one from elsewhere since."""
    with at_sea(tmp_path, OTHER) as (vehicle, (id,)):
        alter(tmp_path, "UPDATE missions SET state = 'sending' WHERE id = ?", id)
        vehicle.missions.files += [OTHER.encode(), CORRECTED.encode()]
        vehicle.under_water = False
        with station(tmp_path, vehicle.address) as found:
            until(lambda: mission(Client(found), id)["state"] == "interrupted")
            assert "it may have been flown" in mission(Client(found), id)["words"]
            until(lambda: Client(found).get("/vehicles/1/mission")["waiting"] == 0)
            assert flown(vehicle)[-1] == CORRECTED.encode()
