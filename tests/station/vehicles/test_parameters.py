"""Parameters of a vehicle at the station. Oracle: the vehicle's side of the link."""

from pathlib import Path

import pytest

from stommel.archive import ArchiveFullError
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


@pytest.mark.parametrize(
    ("aboard", "state", "words"),
    [(7, "done", "the vehicle holds this value"), (2, "failed", "the vehicle holds 2")],
    ids=["it came aboard", "it did not"],
)
def test_what_was_set_just_before_the_station_stopped_has_a_true_outcome(
    tmp_path: Path, aboard: int, state: str, words: str
) -> None:
    """The link forgets what waits when it is started anew; what the vehicle holds then tells what became of it."""
    with served() as vehicle:
        with station(tmp_path, vehicle.address) as found:
            until(lambda: is_whole(Client(found)))
            vehicle.under_water = True
            answer = Client(found).request("PUT", f"{MOTION}/RETRIES", json={"value": 7})
            assert answer.json()["state"] == "waiting"
        number = [each.id for each in NAMES[MOTION_COMPONENT][1]].index("RETRIES")
        vehicle.parameters.values[MOTION_COMPONENT][number] = aboard
        with station(tmp_path, vehicle.address) as again:
            client = Client(again)
            (waits,) = client.get("/vehicles/1/parameters")["writes"]
            assert (waits["ticket"], waits["state"]) == (answer.json()["ticket"], "waiting")
            assert "started anew" in waits["words"]
            vehicle.under_water = False

            def ended() -> dict[str, object]:
                (write,) = client.get("/vehicles/1/parameters")["writes"]
                return write if write["state"] != "waiting" else {}

            until(ended, within=60.0)
            told = ended()
            assert (told["state"], told["holds"], told["user"]) == (state, float(aboard), "local")
            assert words in str(told["words"])
        with station(tmp_path, vehicle.address, start=False) as later:
            (write,) = Client(later).get("/vehicles/1/parameters")["writes"]
            assert write == told
        assert vehicle.parameters.writes == []


def test_a_value_is_not_set_that_cannot_be_written_down(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with served() as vehicle, station(tmp_path, vehicle.address) as found:
        until(lambda: is_whole(Client(found)))

        def full(*_: object) -> None:
            raise ArchiveFullError("archive.sqlite: the disk is full")

        monkeypatch.setattr(found.parameters._writes, "add", full)
        refused = Client(found).refused("PUT", f"{MOTION}/RETRIES", 503, json={"value": 7})
        assert "disk is full" in refused["reason"]
        assert Client(found).get("/vehicles/1/parameters")["writes"] == []
        assert vehicle.parameters.writes == []
