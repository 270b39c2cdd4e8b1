"""Parameters of a vehicle at the station. Oracle: the vehicle's side of the link."""

from pathlib import Path

import pytest

from stommel.link.parameters.port import MOTION_COMPONENT, ParameterState
from stommel.station.station import Station
from tests.link.parameters.vehicle import NAMES
from tests.station.client import Client
from tests.station.served import served
from tests.station.speaker import until
from tests.station.stations import station

MOTION = f"/vehicles/1/parameters/{MOTION_COMPONENT}"


def is_whole(client: Client) -> bool:
    components = client.get("/vehicles/1/parameters")["components"]
    return len(components) == 3 and all(each["whole"] for each in components)


def history(found: Station, name: str) -> list[tuple[float, str | None, str]]:
    rows = found.parameters.history(1, MOTION_COMPONENT, name, 10)
    return [(row.value, row.user, row.source) for row in rows]


def test_all_parameters_are_known_when_the_vehicle_is_first_heard(tmp_path: Path) -> None:
    with served() as vehicle, station(tmp_path, vehicle.address) as found:
        client = Client(found)
        until(lambda: is_whole(client))
        told = {each["component"]: each for each in client.get("/vehicles/1/parameters")["components"]}
        for component, (name, described) in NAMES.items():
            assert told[component]["name"] == name
            assert [each["name"] for each in told[component]["parameters"]] == [each.id for each in described]
            assert [each["value"] for each in told[component]["parameters"]] == pytest.approx(
                vehicle.parameters.values[component]
            )


def test_a_value_is_set_and_kept_with_who_and_what_was_before(tmp_path: Path) -> None:
    with served() as vehicle:
        with station(tmp_path, vehicle.address) as found:
            client = Client(found)
            until(lambda: is_whole(client) and history(found, "RETRIES"))
            answer = client.request("PUT", f"{MOTION}/RETRIES", json={"value": 7})
            assert (answer.status_code, answer.json()["state"]) == (202, "waiting")
            until(lambda: history(found, "RETRIES")[0] == (7.0, "local", "written"))
            assert history(found, "RETRIES")[1] == (2.0, None, "vehicle")
            assert vehicle.parameters.writes == [(MOTION_COMPONENT, "RETRIES", 7)]
            (write,) = client.get("/vehicles/1/parameters")["writes"]
            assert (write["state"], write["holds"]) == ("done", 7.0)
        with station(tmp_path, vehicle.address) as again:
            until(lambda: is_whole(Client(again)))
            assert len(history(again, "RETRIES")) == 2, "what has not changed is not written again"


def test_what_cannot_be_set_is_told(tmp_path: Path) -> None:
    with served() as vehicle, station(tmp_path, vehicle.address) as found:
        client = Client(found)
        until(lambda: is_whole(client))
        assert "100" in client.refused("PUT", f"{MOTION}/RETRIES", 422, json={"value": 5000})["reason"]
        client.refused("PUT", f"{MOTION}/RETRIES", 422, json={"value": "much"})
        client.refused("PUT", f"{MOTION}/NOTHING", 404, json={"value": 1})
        client.refused("PUT", "/vehicles/1/parameters/77/RETRIES", 404, json={"value": 1})
        assert vehicle.parameters.writes == []


def test_a_dead_node_marks_only_its_own_parameters(tmp_path: Path) -> None:
    """mavlink/qgroundcontrol#4716, #6890, #15114: a silent node does not block the rest."""
    with served() as vehicle:
        vehicle.parameters.states[MOTION_COMPONENT] = ParameterState.SILENT
        with station(tmp_path, vehicle.address) as found:
            client = Client(found)

            def told(kind: str) -> list[int]:
                return [each["component"] for each in client.get("/vehicles/1/parameters")[kind]]

            until(lambda: told("missing"))
            assert (told("components"), told("missing")) == ([1, 26], [25])
