"""Commands of people: written down before they are queued, followed to the last word, over a restart too.

Oracle: what the vehicle's side of the link has begun, and the rows of the archive.
"""

from pathlib import Path

import pytest

from stommel.archive import ArchiveError
from stommel.link.commands.port import Answer, Readiness
from stommel.link.commands.states import Progress, State, When
from stommel.link.commands.table import ABORT, HOLD, CommandError
from stommel.station.station import Station
from stommel.station.vehicles.command_rows import CommandRow
from tests.station.client import Client
from tests.station.served import served
from tests.station.speaker import until
from tests.station.stations import station


def give(found: Station, name: str = "hold", valid_for: float = 600.0) -> str:
    return found.commands.give(1, "ada", name, {}, valid_for_s=valid_for, when=When.UNTIL_EXPIRY).id


def state(found: Station, id: str) -> str:
    return found.commands.find(1, id).state


def test_a_command_is_followed_until_the_vehicle_has_said_its_last_word(tmp_path: Path) -> None:
    with served() as vehicle, station(tmp_path, vehicle.address) as found:
        client = Client(found)
        row = client.post("/vehicles/1/commands", {"name": "hold", "valid_for_s": 300})
        assert (row["state"], row["user"], row["is_last"]) == ("queued", "local", False)
        until(lambda: client.get(f"/vehicles/1/commands/{row['id']}")["is_last"])
        told = client.get(f"/vehicles/1/commands/{row['id']}")
        assert told["state"] == "done"
        states = [each["state"] for each in told["history"]]
        assert states[:2] == ["given", "queued"]
        assert states[-1] == "done"
        assert vehicle.port.numbers == [HOLD]
        assert row["expires"] - row["given"] == pytest.approx(300.0, abs=0.5)


def test_what_becomes_of_a_command_is_never_told_as_before_it_was_given_though_the_clock_is_set_back(
    tmp_path: Path,
) -> None:
    """A simulation that falls behind sets the clock of its world back; who watches takes the row that changed last.

    Oracle: the order in which it happened.
    """
    with served() as vehicle, station(tmp_path, vehicle.address) as found:
        vehicle.under_water = True
        row = found.commands.find(1, give(found))
        told: list[CommandRow] = [row]
        found.commands._followers[1]._tell = told.append
        found.vehicles[1].clock._offset = -900.0
        vehicle.under_water = False
        until(lambda: state(found, row.id) == "done")
        until(lambda: told[-1].state == "done")
        history = found.commands.history(row.id)
        assert [each.state for each in told][-1] == history[-1][1] == "done"
        assert [each.changed for each in told] == sorted({each.changed for each in told})
        assert [t for t, _, _ in history] == sorted({t for t, _, _ in history})


def test_a_command_waits_for_the_vehicle_over_a_restart_of_the_station(tmp_path: Path) -> None:
    with served() as vehicle:
        vehicle.under_water = True
        with station(tmp_path, vehicle.address) as found:
            id = give(found)
            assert state(found, id) == "queued"
        with station(tmp_path, vehicle.address) as again:
            assert state(again, id) == "queued"
            vehicle.under_water = False
            until(lambda: state(again, id) == "done")
            assert vehicle.port.numbers == [HOLD]


def test_a_command_that_was_written_and_never_queued_is_told_as_not_sent(tmp_path: Path) -> None:
    with served() as vehicle, station(tmp_path, vehicle.address, start=False) as found:
        line = found.vehicles[1]
        row = found.commands._row(line, "ada", "hold", {}, 600.0, When.UNTIL_EXPIRY)
        found.commands._rows.add(row)  # the station dies here
    with served() as vehicle, station(tmp_path, vehicle.address) as again:
        until(lambda: state(again, row.id) == "not_sent")
        assert vehicle.port.numbers == []


def test_a_command_expires_before_the_vehicle_is_heard_and_is_never_executed(tmp_path: Path) -> None:
    with served() as vehicle, station(tmp_path, vehicle.address) as found:
        vehicle.under_water = True
        id = give(found, valid_for=1.0)
        until(lambda: "time is over" in found.commands.find(1, id).words or state(found, id) == "expired")
        vehicle.under_water = False
        until(lambda: found.commands.find(1, id).is_last)
        assert state(found, id) == "expired"
        assert vehicle.port.numbers == []


def test_a_cancelled_command_is_not_executed(tmp_path: Path) -> None:
    with served() as vehicle, station(tmp_path, vehicle.address) as found:
        vehicle.port.answer = Answer(Readiness.NOT_YET, "under way")
        id = give(found)
        until(lambda: state(found, id) == "waiting")
        client = Client(found)
        assert client.request("DELETE", f"/vehicles/1/commands/{id}").status_code == 200
        until(lambda: state(found, id) == "cancelled")
        assert vehicle.port.numbers == []


def test_progress_is_told(tmp_path: Path) -> None:
    with served() as vehicle, station(tmp_path, vehicle.address) as found:
        vehicle.port.outcome = Progress(State.IN_PROGRESS, 40, "pump moves")
        id = give(found, "self-test")
        until(lambda: state(found, id) == "in_progress")
        until(lambda: found.commands.told(found.commands.find(1, id))["percent"] == 40)


def test_refusals_name_what_is_wrong(tmp_path: Path) -> None:
    with served() as vehicle, station(tmp_path, vehicle.address, start=False) as found:
        client = Client(found)
        body = {"name": "radio-time", "parameters": {"time": 1}}
        assert "60" in client.refused("POST", "/vehicles/1/commands", 422, json=body)["reason"]
        assert "dance" in client.refused("POST", "/vehicles/1/commands", 422, json={"name": "dance"})["reason"]
        client.refused("POST", "/vehicles/1/commands", 422, json={"name": "hold", "valid_for_s": 1e99})
        client.refused("DELETE", f"/vehicles/1/commands/{'0' * 16}", 404)
        assert found.commands.list(1) == []


def test_nothing_is_given_while_the_archive_takes_nothing_but_an_abort(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with served() as vehicle, station(tmp_path, vehicle.address) as found:
        until(lambda: found.vehicles[1].status().heard)

        def full(*_: object) -> None:
            raise ArchiveError("the disk is full")

        with monkeypatch.context() as broken:
            broken.setattr(found.archive, "store", full)
            broken.setattr(found.commands._rows, "add", full)
            until(lambda: found.vehicles[1].status().archive)
            with pytest.raises(ArchiveError, match="disk is full"):
                give(found)
            row = Client(found).post("/vehicles/1/abort")
            assert "disk is full" in row["words"]
            until(lambda: vehicle.port.numbers == [ABORT])
        until(lambda: state(found, row["id"]) == "done")
        assert found.commands.find(1, row["id"]).user == "local"
        assert vehicle.port.numbers == [ABORT]


def test_two_equal_commands_have_two_outcomes(tmp_path: Path) -> None:
    """mavlink/qgroundcontrol#2975: N equal commands get N outcomes of their own."""
    with served() as vehicle, station(tmp_path, vehicle.address) as found:
        ids = [give(found) for _ in range(5)]
        until(lambda: all(state(found, id) == "done" for id in ids))
        assert vehicle.port.numbers == [HOLD] * 5


def test_a_command_that_the_queue_does_not_take_is_told_as_not_sent(tmp_path: Path) -> None:
    with served() as vehicle, station(tmp_path, vehicle.address) as found:
        vehicle.under_water = True
        for _ in range(64):
            give(found)
        with pytest.raises(CommandError, match="64 are open"):
            give(found)
        assert found.commands.list(1)[0].state == "not_sent"
