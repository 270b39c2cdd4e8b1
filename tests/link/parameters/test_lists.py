"""Parameter lists over a bad line. Oracle: the values that the vehicle holds."""

import json
import math
import random

import pytest

from stommel.link.endings import Ending
from stommel.link.parameters.client import ParameterClient
from stommel.link.parameters.known import KnownParameters
from stommel.link.parameters.port import COORDINATOR_COMPONENT, MOTION_COMPONENT, ParameterState
from tests.link.line import Line, losing, losing_number
from tests.link.parameters.vehicle import NAMES, Vehicle, joined, read_values
from tests.onboard.coordination.disk import Disk


def refreshed(client: ParameterClient, line: Line, within: float = 3600.0) -> dict[str, Ending]:
    client.refresh(line.t, within)
    line.run(lambda: client.refreshed is not None, within + 1.0)
    assert client.refreshed is not None
    return {outcome.name: outcome.ending for outcome in client.refreshed}


def agree(client: ParameterClient, vehicle: Vehicle) -> bool:
    return read_values(client) == pytest.approx(
        {component: pytest.approx(values, rel=1e-7) for component, values in vehicle.values.items()}
    )


WHOLE = {name: Ending.WHOLE for name, _ in NAMES.values()}


def test_everything_arrives_with_its_description() -> None:
    vehicle = Vehicle()
    client, line = joined(vehicle)
    assert refreshed(client, line) == WHOLE
    for component, (_, described) in NAMES.items():
        assert client.known.sets[component].descriptions == described
        assert list(client.known.sets[component].values) == pytest.approx(vehicle.values[component], rel=1e-7)
    assert (
        line.counted("PARAM_VALUE")
        == line.counted("PARAMETER_DESCRIPTION")
        == sum(len(described) for _, described in NAMES.values())
    )


def test_an_unchanged_set_costs_one_message_and_a_changed_one_no_descriptions() -> None:
    """mavlink/qgroundcontrol#4716, #15114. After a restart of the shore, too: what is known lies on its disk."""
    vehicle, disk = Vehicle(), Disk()
    client, line = joined(vehicle, KnownParameters(1, disk))
    refreshed(client, line)
    again, line = joined(vehicle, KnownParameters(1, disk))
    assert refreshed(again, line) == WHOLE
    assert {sent.received.name for sent in line.sent} == {"PARAMETER_DIGEST_REQUEST", "PARAMETER_DIGEST"}
    assert len(line.sent) == 1 + len(NAMES)
    vehicle.values[MOTION_COMPONENT][3] = 77
    line.sent.clear()
    assert refreshed(again, line) == WHOLE
    assert again.known.sets[MOTION_COMPONENT].values[3] == 77
    assert line.counted("PARAMETER_DESCRIPTION") == 0
    assert line.counted("PARAM_VALUE") == len(vehicle.values[MOTION_COMPONENT])


def test_any_single_message_lost() -> None:
    """mavlink/qgroundcontrol#6890, #4716: the list never stops partway. Each message of it is lost in turn."""
    vehicle = Vehicle()
    client, line = joined(vehicle)
    refreshed(client, line)
    total = len(line.sent)
    assert total > 100
    for number in range(total):
        client, line = joined(vehicle, seed=number)
        line.loses = losing_number(number)
        assert refreshed(client, line, within=30.0) == WHOLE, f"message {number} lost"
        assert len(line.sent) <= total + 5, f"message {number} lost: more than it is asked for again"


@pytest.mark.parametrize(("loss", "latency", "rate"), [(0.3, 0.5, 11520.0), (0.5, 0.5, 1200.0), (0.2, 3.0, 240.0)])
def test_a_bad_line(loss: float, latency: float, rate: float) -> None:
    for seed in range(5):
        vehicle = Vehicle()
        client, line = joined(vehicle, seed=seed)
        line.loses, line.latency, line.rate = losing(random.Random(seed), loss), latency, rate
        assert refreshed(client, line) == WHOLE
        assert read_values(client)[MOTION_COMPONENT][1:] == vehicle.values[MOTION_COMPONENT][1:]


def test_a_round_trip_of_two_seconds_brings_few_duplicates() -> None:
    """PX4/PX4-Autopilot#11078: at most 5 % are asked twice."""
    client, line = joined(Vehicle())
    line.latency = 1.0
    assert refreshed(client, line) == WHOLE
    assert len(line.sent) <= 1.05 * (1 + 3 + 2 * 3 + 2 * 54)


def test_one_dead_node_marks_only_its_own() -> None:
    """mavlink/qgroundcontrol#6890: a silent node must not block the vehicle."""
    vehicle = Vehicle()
    client, line = joined(vehicle)
    refreshed(client, line)
    vehicle.states[MOTION_COMPONENT] = ParameterState.SILENT
    vehicle.values[1][0] = 99.0
    assert refreshed(client, line) == {**WHOLE, "motion node": Ending.FAILED}
    assert client.refreshed is not None
    assert "the motion node is silent" in client.refreshed[1].words
    states = {component: known.state for component, known in client.known.sets.items()}
    assert states == {1: ParameterState.KNOWN, 25: ParameterState.SILENT, 26: ParameterState.KNOWN}
    assert client.known.sets[1].values[0] == 99.0
    assert client.known.sets[25].values[1] == 2
    vehicle.states[MOTION_COMPONENT] = ParameterState.KNOWN
    assert refreshed(client, line) == WHOLE


def test_a_node_that_is_being_read_is_waited_for() -> None:
    vehicle = Vehicle()
    vehicle.states[MOTION_COMPONENT] = ParameterState.BEING_READ
    client, line = joined(vehicle)
    client.refresh(line.t)
    line.wait(20.0)
    assert client.refreshed is None
    vehicle.states[MOTION_COMPONENT], vehicle.values[MOTION_COMPONENT][5] = ParameterState.KNOWN, None
    line.wait(20.0)
    assert client.refreshed is None, "one value is not known yet"
    vehicle.values[MOTION_COMPONENT][5] = 6
    line.run(lambda: client.refreshed is not None, 10.0)
    assert {outcome.ending for outcome in client.refreshed or ()} == {Ending.WHOLE}


def test_a_value_that_changes_meanwhile_is_seen() -> None:
    """Digests compare what has arrived with what is held at the end."""
    vehicle = Vehicle()
    client, line = joined(vehicle)
    client.refresh(line.t)
    line.run(lambda: line.counted("PARAM_VALUE") > 30, 60.0)
    vehicle.values[MOTION_COMPONENT][1] = 55
    line.run(lambda: client.refreshed is not None, 60.0)
    assert client.known.sets[MOTION_COMPONENT].values[1] in (2, 55)
    assert refreshed(client, line) == WHOLE
    assert client.known.sets[MOTION_COMPONENT].values[1] == 55


def test_a_dive_in_the_middle_of_a_list() -> None:
    """A vehicle under water refuses nothing: the list goes on when it is heard again, and asks for nothing twice."""
    vehicle = Vehicle()
    client, line = joined(vehicle)
    line.rate = 600.0
    client.refresh(line.t)
    line.run(lambda: line.counted("PARAM_VALUE") > 10, 60.0)
    line.is_silent = True
    line.wait(900.0)
    assert client.refreshed is None
    line.is_silent = False
    line.run(lambda: client.refreshed is not None, 60.0)
    assert {outcome.ending for outcome in client.refreshed or ()} == {Ending.WHOLE}


def test_a_vehicle_without_this_service_fails_within_its_time() -> None:
    client, line = joined(Vehicle())
    line.vehicle.services = []
    client.refresh(line.t)
    took = line.run(lambda: client.refreshed is not None, 200.0)
    assert took == pytest.approx(180.0, abs=1.0)
    assert client.refreshed is not None
    assert client.refreshed[0].words == "no answer for 180 s, though the vehicle is heard"
    line.is_silent = True
    client.refresh(line.t, within=500.0)
    assert line.run(lambda: client.refreshed is not None, 600.0) == pytest.approx(500.0, abs=1.0)


@pytest.mark.parametrize("damage", [b"", b"{", b'{"format": 1, "sets": [{}]}', b"[1]", b"\xff\xfe", b"9" * 100])
def test_a_damaged_memory_of_the_shore_is_asked_for_anew(damage: bytes) -> None:
    disk = Disk({"parameters-1.json": damage})
    client, line = joined(Vehicle(), KnownParameters(1, disk))
    assert len(client.known.notes) == 1
    assert refreshed(client, line) == WHOLE
    assert set(KnownParameters(1, disk).sets) == set(NAMES)


def test_a_full_disk_is_noted() -> None:
    disk = Disk()
    disk.broken = True
    client, line = joined(Vehicle(), KnownParameters(1, disk))
    assert refreshed(client, line) == WHOLE
    assert any("cannot be kept" in note for note in client.known.notes)


def test_a_value_that_is_no_number_is_kept_as_not_known() -> None:
    """JSON has no word for it, and other programs would not read the file."""
    disk, vehicle = Disk(), Vehicle()
    vehicle.values[COORDINATOR_COMPONENT][1] = math.nan
    client, line = joined(vehicle, KnownParameters(1, disk))
    assert set(refreshed(client, line).values()) == {Ending.WHOLE}
    told = disk.read("parameters-1.json")
    assert json.loads(told, parse_constant=pytest.fail)["sets"][0]["values"][1] is None
    assert KnownParameters(1, disk).sets[COORDINATOR_COMPONENT].values[1] is None
    for _ in range(3):
        disk.broken = True
        client.known.keep(0.0)
    assert len(client.known.notes) == 1, "the same again is no news"
