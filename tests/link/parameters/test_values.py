"""Single parameters: read, written, refused. Oracle: the vehicle's limits, MAVLink's own encoding, pymavlink."""

import random
import struct
from math import inf, nan
from types import SimpleNamespace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from stommel.link.endings import Ending
from stommel.link.parameters.encoding import (
    LEAST_INT,
    MOST_INT,
    ParameterValueError,
    check_description,
    float_of,
    value_of,
)
from stommel.link.parameters.port import MOTION_COMPONENT, Description, ParameterKind, ParameterState
from stommel.link.parameters.server import ParameterServer
from stommel.link.service import Received
from stommel.messages.mavlink import message_named
from tests.link.line import End, Line, Says, losing
from tests.link.parameters.vehicle import Vehicle, joined

TO_MOTION = {"target_system": 1, "target_component": MOTION_COMPONENT}


def spoken(vehicle: Vehicle, *messages):  # type: ignore[no-untyped-def]
    """What a vehicle answers to plain messages."""
    says = Says(*messages)
    line = Line(End(255, 190, [says]), End(1, 1, [ParameterServer(1, vehicle)]))
    line.wait(2.0)
    return says.heard


def test_a_value_is_set_and_its_outcome_told() -> None:
    vehicle = Vehicle()
    client, line = joined(vehicle)
    ticket = client.write(MOTION_COMPONENT, "RETRIES", 7)
    line.wait(2.0)
    (outcome,) = client.outcomes()
    assert (outcome.ticket, outcome.ending, outcome.value) == (ticket, Ending.WHOLE, 7)
    assert vehicle.writes == [(MOTION_COMPONENT, "RETRIES", 7)]
    asked = client.read(MOTION_COMPONENT, "RETRIES")
    line.wait(2.0)
    assert [(each.ticket, each.value) for each in client.outcomes()] == [(asked, 7)]


def test_a_refused_value_is_answered_with_the_reason_and_the_value_that_holds() -> None:
    vehicle = Vehicle()
    client, line = joined(vehicle)
    for value, words in [
        (101, "RETRIES = 101: must be a whole number between -5 and 100"),
        (1.5, "RETRIES = 1.5: must be a whole number between -5 and 100"),
        (nan, "RETRIES = nan: must be a whole number between -5 and 100"),
        (inf, "RETRIES = inf: must be a whole number between -5 and 100"),
    ]:
        client.write(MOTION_COMPONENT, "RETRIES", value)
        line.wait(2.0)
        (outcome,) = client.outcomes()
        assert (outcome.ending, outcome.value, outcome.words) == (Ending.REFUSED, 2, words)
    client.write(MOTION_COMPONENT, "RETIRES", 1)
    line.wait(2.0)
    assert client.outcomes()[0].words == "RETIRES: there is no such parameter"
    vehicle.states[MOTION_COMPONENT] = ParameterState.SILENT
    client.write(MOTION_COMPONENT, "RETRIES", 1)
    client.read(MOTION_COMPONENT, "RETRIES")
    line.wait(2.0)
    written, read = client.outcomes()
    assert written.words == "RETRIES: the motion node is silent"
    assert (read.ending, read.words) == (Ending.REFUSED, "its component is silent")
    assert vehicle.writes == []


def test_every_writing_is_carried_out_once_and_in_its_order() -> None:
    """Half of all is lost, and messages come late and twice: the value of the last one holds."""
    for seed in range(10):
        vehicle, draw = Vehicle(), random.Random(seed)
        client, line = joined(vehicle, seed=seed)
        line.loses, line.latency = losing(draw, 0.5), 0.3
        values = [draw.randint(-5, 100) for _ in range(10)]
        for value in values:
            client.write(MOTION_COMPONENT, "RETRIES", value)
        ended: list[Ending] = []
        while len(ended) < len(values):
            assert line.t < 2000.0
            line.step()
            if line.flying and draw.random() < 0.2:
                due, sent = draw.choice(line.flying)
                line.flying.append((due + draw.uniform(0.0, 20.0), sent))
            ended += [outcome.ending for outcome in client.outcomes()]
        line.wait(30.0)
        assert ended == [Ending.WHOLE] * len(values)
        assert [value for _, _, value in vehicle.writes] == values


def test_ordinary_software_sets_reads_and_lists() -> None:
    """The standard messages alone, byte-wise encoded as MAVLink's union of a float and an int32_t."""
    vehicle = Vehicle()
    held = struct.unpack("<f", struct.pack("<i", 9))[0]
    (answer,) = spoken(
        vehicle, ("PARAM_SET", {**TO_MOTION, "param_id": "RETRIES", "param_type": 6, "param_value": held})
    )
    assert answer.name == "PARAM_VALUE"
    assert answer.component == MOTION_COMPONENT
    assert struct.unpack("<i", struct.pack("<f", answer.values["param_value"]))[0] == 9
    # software that knows no other type than float
    spoken(vehicle, ("PARAM_SET", {**TO_MOTION, "param_id": "RETRIES", "param_type": 9, "param_value": 12.0}))
    assert vehicle.writes[-1] == (MOTION_COMPONENT, "RETRIES", 12)
    heard = spoken(vehicle, ("PARAM_REQUEST_LIST", {"target_system": 1, "target_component": 0}))
    assert [(each.component, each.values["param_index"]) for each in heard] == [
        *((1, number) for number in range(20)), *((25, number) for number in range(33)), (26, 0),
    ]  # fmt: skip
    (by_name,) = spoken(vehicle, ("PARAM_REQUEST_READ", {**TO_MOTION, "param_id": "RETRIES", "param_index": -1}))
    assert by_name.values["param_index"] == 1
    (unknown,) = spoken(vehicle, ("PARAM_REQUEST_READ", {**TO_MOTION, "param_index": 400}))
    assert (unknown.name, unknown.values["error"]) == ("PARAM_ERROR", 1)


def test_ordinary_software_is_told_that_a_value_was_refused() -> None:
    heard = spoken(
        Vehicle(), ("PARAM_SET", {**TO_MOTION, "param_id": "PUMP_FLOW", "param_type": 9, "param_value": 1.0})
    )
    told = {each.name: each.values for each in heard}
    assert told["PARAM_ERROR"]["error"] == 2
    assert told["PARAM_VALUE"]["param_value"] == pytest.approx(8.3e-6, rel=1e-7)
    assert told["PARAMETER_OUTCOME"]["words"] == "PUMP_FLOW = 1: must be between 1e-06 and 5e-05 m3/s"


def test_pymavlink_sets_a_parameter() -> None:
    """pymavlink's own helper, which packs what it sends and waits for the echo."""
    from pymavlink.dialects.v20 import common
    from pymavlink.mavparm import MAVParmDict

    vehicle, told = Vehicle(), []

    class Master:
        def param_set_send(self, name: str, value: float, parm_type: int | None = None) -> None:
            message = common.MAVLink_param_set_message(1, 26, name.encode(), value, parm_type or 9)
            packed = message.pack(common.MAVLink(None, 255, 190))[10:-2]
            told.extend(spoken(vehicle, ("PARAM_SET", message_named("PARAM_SET").unpack(packed))))

        def recv_match(self, type: str, blocking: bool) -> object:
            return next(SimpleNamespace(**each.values) for each in told if each.name == type)

    assert MAVParmDict().mavset(Master(), "CTD_PERIOD", 20.0)
    assert vehicle.values[26] == [20.0]


@given(st.integers(LEAST_INT, MOST_INT))
def test_whole_numbers_survive_the_float(value: int) -> None:
    """Through the message's bytes; the bits on the wire are the number's own."""
    message = message_named("PARAM_VALUE")
    payload = message.pack({"param_value": float_of(ParameterKind.INT32, value), "param_id": "A"})
    assert payload[:4] == struct.pack("<i", value)
    assert value_of(6, float(message.unpack(payload)["param_value"])) == value  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("described", "words"),
    [
        (Description("too_small", ParameterKind.UINT8, 0, 0, 1), "capital letters"),
        (Description("A" * 17, ParameterKind.UINT8, 0, 0, 1), "up to 16"),
        (Description("A", ParameterKind.UINT8, 0, 0, 256), "0 to 255"),
        (Description("A", ParameterKind.INT32, 0, LEAST_INT - 1, 0), "-4194304 to 2.13909504e"),
        (Description("A", ParameterKind.FLOAT32, 2.0, 0.0, 1.0), "must rise"),
        (Description("A", ParameterKind.FLOAT32, nan, 0.0, 1.0), "must rise"),
        (Description("A", ParameterKind.UINT8, 0, 0, 1, words="x" * 181), "16 and 180 bytes"),
    ],
)
def test_what_cannot_be_said_is_refused(described: Description, words: str) -> None:
    with pytest.raises(ParameterValueError, match=words):
        check_description(described, "motion node")


@settings(deadline=None)  # the machine may be busy
@given(st.data())
def test_no_message_ends_the_server(data: st.DataObject) -> None:
    """Any payload of any message that it takes; whatever it then says can be packed."""
    names = [
        "PARAM_REQUEST_READ",
        "PARAM_SET",
        "PARAMETER_WRITE",
        "PARAMETER_DESCRIPTION_REQUEST",
        "PARAM_REQUEST_LIST",
    ]
    messages = []
    for _ in range(3):
        message = message_named(data.draw(st.sampled_from(names)))
        values = message.unpack(data.draw(st.binary(max_size=message.layout.size)))
        values["target_system"] = 1
        messages.append((message.name, values))
    says = Says()
    line = Line(End(255, 190, [says]), End(1, 1, [ParameterServer(1, Vehicle())]))
    for name, values in messages:
        line.vehicle.services[0].take(Received(255, 190, name, values), 0.0)
    for _ in range(30):
        line.step()
