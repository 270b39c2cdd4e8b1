"""What waits for a vehicle, in its summary. Oracle: what was given and has had no answer, counted by hand."""

from pathlib import Path
from typing import Any

from stommel.station.vehicles.waiting import NOTHING
from tests.link.commands.quay import FakePort
from tests.station.client import Client
from tests.station.served import served
from tests.station.speaker import until
from tests.station.stations import station
from tests.station.vehicles.test_missions import OTHER, upload


def waiting(client: Client) -> Any:
    return client.get("/vehicles/1")["waiting"]


def test_what_is_given_to_a_silent_vehicle_is_counted_until_its_last_word(tmp_path: Path) -> None:
    with served() as vehicle:
        vehicle.under_water = True
        with station(tmp_path, vehicle.address) as found:
            client = Client(found)
            assert waiting(client) == NOTHING
            given = client.post("/vehicles/1/commands", {"name": "hold", "valid_for_s": 3600.0})
            upload(client, OTHER)
            transfer = client.post("/vehicles/1/transfers", {"path": "logs/1.log"})
            counts = {"commands": 1, "parameters": 0, "missions": 1, "transfers": 1, "abort": None}
            until(lambda: waiting(client) == counts)
            client.post(f"/transfers/{transfer['id']}/pause")
            until(lambda: waiting(client) == counts | {"transfers": 0})
            vehicle.under_water = False
            until(lambda: waiting(client) == NOTHING)
            until(lambda: client.get(f"/vehicles/1/commands/{given['id']}")["state"] == "done")


def test_an_abort_is_told_from_the_station_to_the_vehicles_last_word(tmp_path: Path) -> None:
    with served() as vehicle:
        assert isinstance(vehicle.port, FakePort)
        vehicle.under_water = True
        with station(tmp_path, vehicle.address) as found:
            client = Client(found)
            given = client.post("/vehicles/1/abort")
            until(lambda: waiting(client)["abort"])
            told = waiting(client)["abort"]
            assert (told["id"], told["step"] in ("waits", "sent")) == (given["id"], True)
            assert abs(told["given"] - given["given"]) < 1.0
            assert abs(told["expires"] - given["expires"]) < 1.0
            vehicle.under_water = False
            until(lambda: waiting(client) == NOTHING)
            until(lambda: client.get(f"/vehicles/1/commands/{given['id']}")["is_last"])
