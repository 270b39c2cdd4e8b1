"""Commands of ordinary MAVLink software. Oracle: the MAVLink command protocol, packed by pymavlink itself."""

from typing import Any

import pytest
from pymavlink.dialects.v20 import common

from stommel.link.commands.identity import Identity
from stommel.link.commands.port import Answer, Readiness
from stommel.link.commands.standard import StandardCommands
from stommel.link.commands.states import Progress, State
from stommel.link.commands.table import ABORT, HOLD, RADIO_TIME, RECALL, START, SURFACE
from stommel.link.outbox import Outbox
from stommel.link.service import Received
from stommel.messages.mavlink import Fields, message_named
from tests.link.commands.quay import VEHICLE, FakePort, sayings

GROUND = (255, 190)
ARM, MISSION_START, RETURN, TERMINATE = 400, 300, 20, 185
REQUEST, INTERVAL, PROTOCOL, CAPABILITIES = 512, 511, 519, 520


class Bench:
    def __init__(self) -> None:
        self.port = FakePort()
        self.asked: list[tuple[Any, ...]] = []
        self.aborts: list[float] = []
        self.told: list[str] = []
        self.t = 0.0
        self.standard = StandardCommands(
            *VEHICLE, self.port, self, Identity("1.2.3"), self.aborts.append, self.told.append
        )

    def request(self, number: int, t: float) -> bool:
        self.asked.append((number,))
        return number == 30

    def set_interval(self, number: int, interval: float | None, t: float) -> bool:
        self.asked.append((number, interval))
        return number == 30

    def say(
        self,
        command: int,
        *parameters: float,
        confirmation: int = 0,
        is_int: bool = False,
        source: tuple[int, int] = GROUND,
        target: tuple[int, int] = VEHICLE,
    ) -> list[tuple[str, Fields]]:
        """Say a command as pymavlink packs it, and return what the vehicle answers."""
        values = [*parameters, *[0.0] * 7][:7]
        ground = common.MAVLink(None, *source)
        if is_int:
            message = common.MAVLink_command_int_message(
                *target, 0, command, 0, 0, *values[:4], int(values[4]), int(values[5]), values[6]
            )
        else:
            message = common.MAVLink_command_long_message(*target, command, confirmation, *values)
        payload = message.pack(ground)[10:-2]
        name = message.get_type()
        self.standard.take(Received(*source, name, message_named(name).unpack(payload)), self.t)
        return self.poll()

    def poll(self) -> list[tuple[str, Fields]]:
        outbox = Outbox()
        self.standard.poll(self.t, outbox)
        return [(received.name, received.values) for received in sayings(outbox, VEHICLE)]

    def result(self, *arguments: Any, **options: Any) -> str:
        """Word of the acknowledgement."""
        (ack,) = [values for name, values in self.say(*arguments, **options) if name == "COMMAND_ACK"]
        assert ack["command"] == arguments[0]
        assert (ack["target_system"], ack["target_component"]) == options.get("source", GROUND)
        return str(common.enums["MAV_RESULT"][ack["result"]].name).removeprefix("MAV_RESULT_")


@pytest.mark.parametrize("is_int", [False, True])
@pytest.mark.parametrize(
    ("said", "result", "begun"),
    [
        ((ARM, 1.0), "ACCEPTED", [START]),
        ((ARM, 0.0), "ACCEPTED", [HOLD]),
        ((ARM, 2.0), "DENIED", []),
        ((ARM, float("nan")), "DENIED", []),
        ((MISSION_START,), "ACCEPTED", [START]),
        ((MISSION_START, 3.0), "DENIED", []),
        ((RETURN,), "ACCEPTED", [RECALL]),
        ((TERMINATE, 1.0), "ACCEPTED", [ABORT]),
        ((TERMINATE, 0.0), "DENIED", []),
        ((SURFACE,), "ACCEPTED", [SURFACE]),
        ((SURFACE, float("nan")), "ACCEPTED", [SURFACE]),
        ((SURFACE, 1.0), "DENIED", []),
        ((RADIO_TIME, 600.0), "ACCEPTED", [RADIO_TIME]),
        ((RADIO_TIME, 1.0), "DENIED", []),
        ((PROTOCOL, 1.0), "UNSUPPORTED", []),
        ((22, 1.0), "UNSUPPORTED", []),
        ((60000,), "UNSUPPORTED", []),
    ],
)
def test_commands_and_their_results(said: tuple[Any, ...], result: str, begun: list[int], is_int: bool) -> None:
    bench = Bench()
    assert bench.result(*said, is_int=is_int) == result
    assert bench.port.numbers == begun


def test_retransmissions_are_not_done_twice_and_new_commands_are() -> None:
    bench = Bench()
    for confirmation in (0, 1, 2, 2):
        assert bench.result(ARM, 1.0, confirmation=confirmation) == "ACCEPTED"
        bench.t += 5.0
    assert bench.port.numbers == [START]
    # software that does not count its retries repeats within a second or two
    assert bench.result(ARM, 0.0) == "ACCEPTED"
    bench.t += 1.0
    assert bench.result(ARM, 0.0) == "ACCEPTED"
    assert bench.port.numbers == [START, HOLD]
    assert bench.result(ARM, 1.0) == "ACCEPTED"
    assert bench.result(ARM, 1.0, source=(254, 190)) == "ACCEPTED"
    bench.t += 60.0
    assert bench.result(ARM, 1.0) == "ACCEPTED"
    assert bench.port.numbers == [START, HOLD, START, START, START]


def test_a_first_transmission_that_was_lost_does_not_keep_the_second_from_being_done() -> None:
    bench = Bench()
    assert bench.result(ARM, 1.0, confirmation=1) == "ACCEPTED"
    assert bench.port.numbers == [START]


def test_progress_is_told_and_a_retransmission_hears_the_end() -> None:
    bench = Bench()
    bench.port.outcome = Progress(State.IN_PROGRESS, 0)
    assert bench.result(SURFACE) == "IN_PROGRESS"
    (id,) = bench.port.running
    bench.port.running[id] = Progress(State.IN_PROGRESS, 40)
    bench.t += 2.0
    (said,) = bench.poll()
    assert (said[1]["result"], said[1]["progress"]) == (common.MAV_RESULT_IN_PROGRESS, 40)
    bench.port.running[id] = Progress(State.FAILED)
    (said,) = bench.poll()
    assert said[1]["result"] == common.MAV_RESULT_FAILED
    assert bench.poll() == []
    assert bench.result(SURFACE, confirmation=1) == "FAILED"
    assert len(bench.port.begun) == 1


@pytest.mark.parametrize(
    ("readiness", "result"), [(Readiness.NOT_YET, "TEMPORARILY_REJECTED"), (Readiness.NEVER, "DENIED")]
)
def test_what_the_vehicle_cannot_do_is_not_begun(readiness: Readiness, result: str) -> None:
    bench = Bench()
    bench.port.answer = Answer(readiness)
    assert bench.result(ARM, 1.0) == result
    assert bench.port.begun == []


def test_why_a_command_is_not_executed_is_told_in_words() -> None:
    """COMMAND_ACK has room for a number alone; ground software shows STATUSTEXT."""
    bench = Bench()
    bench.port.answer = Answer(Readiness.NEVER, "there is no mission aboard")
    bench.result(ARM, 1.0)
    bench.result(RADIO_TIME, 1.0)
    bench.port.answer, bench.port.outcome = Answer(Readiness.READY), Progress(State.IN_PROGRESS)
    bench.result(SURFACE)
    bench.port.running[next(iter(bench.port.running))] = Progress(State.FAILED, words="the pump is stuck")
    bench.poll()
    assert bench.told[0] == f"command {START} refused: there is no mission aboard"
    assert bench.told[1].startswith(f"command {RADIO_TIME} refused: ")
    assert bench.told[2:] == [f"command {SURFACE} failed: the pump is stuck"]


def test_an_abort_is_told_to_the_ledger() -> None:
    bench = Bench()
    bench.t = 12.0
    bench.result(TERMINATE, 1.0)
    assert bench.aborts == [12.0]


def test_messages_are_asked_for() -> None:
    bench = Bench()
    assert bench.result(REQUEST, 30.0) == "ACCEPTED"
    assert bench.result(REQUEST, 30.0) == "ACCEPTED"
    assert bench.result(REQUEST, 31.0) == "UNSUPPORTED"
    assert bench.result(REQUEST, -1.0) == "DENIED"
    assert bench.result(INTERVAL, 30.0, 2e6) == "ACCEPTED"
    assert bench.result(INTERVAL, 30.0, -1.0) == "ACCEPTED"
    assert bench.result(INTERVAL, 30.0, 0.0) == "ACCEPTED"
    assert bench.result(INTERVAL, 31.0, 0.0) == "UNSUPPORTED"
    for wrong in (1.0, -2.0, 1e12, float("nan")):
        assert bench.result(INTERVAL, 30.0, wrong) == "DENIED"
    assert bench.asked == [(30,), (30,), (31,), (30, 2.0), (30, None), (30, 0.0), (31, 0.0)]


@pytest.mark.parametrize("said", [(REQUEST, 148.0), (CAPABILITIES, 1.0)])
def test_the_vehicle_says_who_it_is(said: tuple[Any, ...]) -> None:
    answers = dict(Bench().say(*said))
    assert answers["COMMAND_ACK"]["result"] == common.MAV_RESULT_ACCEPTED
    version = answers["AUTOPILOT_VERSION"]
    bits = version["capabilities"]
    assert isinstance(bits, int)
    for bit in (
        common.MAV_PROTOCOL_CAPABILITY_MISSION_INT,
        common.MAV_PROTOCOL_CAPABILITY_FTP,
        common.MAV_PROTOCOL_CAPABILITY_MAVLINK2,
        common.MAV_PROTOCOL_CAPABILITY_COMMAND_INT,
        common.MAV_PROTOCOL_CAPABILITY_FLIGHT_TERMINATION,
    ):
        assert bits & bit
    assert version["flight_sw_version"] == 0x010203FF


@pytest.mark.parametrize(
    ("version", "number"), [("0.7.0", 0x000700FF), ("1.2.dev3", 0x01020000), ("1.2.3+gabc", 0x01020300), ("", 0)]
)
def test_versions_as_numbers(version: str, number: int) -> None:
    assert Identity(version).values()["flight_sw_version"] == number


def test_commands_for_others_are_not_obeyed() -> None:
    bench = Bench()
    assert bench.say(ARM, 1.0, target=(9, 1)) == []
    assert bench.say(ARM, 1.0, target=(VEHICLE[0], 100)) == []
    assert bench.port.begun == []
    assert bench.result(ARM, 1.0, target=(VEHICLE[0], 0)) == "ACCEPTED"
