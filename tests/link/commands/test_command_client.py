"""Commands ashore. Oracle: what the vehicle has begun, and the sentences of the guide."""

import random

import pytest

from stommel.link.commands.client import CommandClient
from stommel.link.commands.shore_queue import MOST_OPEN
from stommel.link.commands.states import Progress, State, When
from stommel.link.commands.table import ABORT, HOLD, START, CommandError
from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Received
from stommel.messages.mavlink import message_named
from tests.link.commands.quay import SHORE, VEHICLE, Quay


def test_a_command_is_executed_and_its_sender_hears_it() -> None:
    quay = Quay()
    id = quay.give("start")
    assert quay.words(id) == "not sent yet"
    quay.run(1.0)
    assert quay.port.numbers == [START]
    assert quay.state(id) is State.DONE


def test_equal_commands_in_flight_have_outcomes_of_their_own() -> None:
    """mavlink/qgroundcontrol#2975 and #4417: arm, disarm, one acknowledgement: for which?"""
    quay = Quay()
    quay.port.outcome = Progress(State.IN_PROGRESS, 0)
    ids = [quay.give("check") for _ in range(5)]
    quay.run(5.0)
    assert [quay.state(id) for id in ids] == [State.IN_PROGRESS] * 5
    ends = [State.DONE, State.FAILED, State.DONE, State.REFUSED, State.FAILED]
    for id, end in zip(ids, ends, strict=True):
        quay.port.running[id] = Progress(end)
    quay.run(5.0)
    assert [quay.state(id) for id in ids] == ends
    assert len(quay.port.begun) == 5


def test_foreign_acknowledgements_change_nothing() -> None:
    """mavlink/qgroundcontrol#8334: they must not make a retry endless, nor end one, nor block the queue."""
    quiet, disturbed = Quay(), Quay()
    for quay in (quiet, disturbed):
        quay.down = lambda name: False
        quay.give("start")
    ack = message_named("COMMAND_ACK")
    sent = {}
    for quay in (quiet, disturbed):
        id = quay.client.reports(quay.shore_t)[0].id
        for _ in range(300):
            quay.run(0.25)
            if quay is disturbed:
                for strange in (
                    quay.status(id, State.DONE, system=9, asking=1),
                    quay.status(id, State.DONE, asking=1)._replace(
                        values=quay.status(id, State.DONE).values | {"target_system": 254}
                    ),
                    quay.status(id + 1, State.DONE, asking=1),
                    quay.status(id, State.DONE, asking=1)._replace(
                        values=quay.status(id, State.DONE).values | {"state": 99}
                    ),
                    Received(*VEHICLE, "COMMAND_ACK", ack.unpack(ack.pack({"command": START, "target_system": 255}))),
                ):
                    quay.client.take(strange, quay.shore_t)
        sent[quay is disturbed] = [quay.client.report(id, quay.shore_t).tries, len(quay.heard)]
        assert quay.state(id) is State.NOT_KNOWN
        assert "unknown until the vehicle is heard" in quay.words(id)
    assert sent[True] == sent[False]
    disturbed.down = lambda name: True
    after = disturbed.give("hold")
    disturbed.run(120.0)
    assert disturbed.state(after) is State.DONE


def test_the_queue_moves_on_behind_a_command_that_is_refused_expired_or_never_answered() -> None:
    quay = Quay()
    quay.port.outcome = Progress(State.REFUSED, words="hatch is open")
    refused, hold = quay.give("start"), quay.give("hold")
    quay.run(2.0)
    assert (quay.state(refused), quay.words(refused)) == (State.REFUSED, "hatch is open")
    assert quay.state(hold).is_last
    deaf = quay.give("start", valid_for=20.0)
    quay.up = lambda name: name != "GLIDER_COMMAND"
    quay.run(25.0)
    quay.up = lambda name: True
    next_one = quay.give("hold")
    quay.run(30.0)
    assert quay.state(deaf) is State.EXPIRED
    assert quay.state(next_one).is_last


def test_commands_arrive_in_their_order_although_the_first_is_lost_again_and_again() -> None:
    quay = Quay()
    lost = iter([False] * 4)
    quay.up = lambda name: name != "GLIDER_COMMAND" or next(lost, True)
    for name in ("start", "hold", "start", "hold"):
        quay.give(name)
    quay.run(120.0)
    assert quay.port.numbers == [START, HOLD, START, HOLD]


def test_an_abort_waits_for_nothing_and_takes_all_back() -> None:
    quay = Quay()
    quay.up = lambda name: False
    before = [quay.give("start") for _ in range(10)]
    quay.run(60.0)
    outbox = Outbox()
    abort = quay.client.abort(quay.shore_t, valid_for=600.0)
    quay.client.poll(quay.shore_t, outbox)
    assert outbox.room(Priority.ABORT) < outbox.room(Priority.DATA)
    first = outbox.next()
    assert first is not None
    assert message_named(first.name).unpack(first.payload)["command"] == ABORT
    quay.up = lambda name: True
    quay.run(60.0)
    assert quay.port.numbers == [ABORT]
    assert quay.state(abort) is State.DONE
    assert {quay.state(id) for id in before} == {State.CANCELLED}


def test_what_was_sent_is_never_called_not_executed_by_the_clock_alone() -> None:
    """The answer was lost, not the command: until the vehicle says so, nobody knows."""
    quay = Quay()
    quay.down = lambda name: False
    sent = quay.give("start", valid_for=10.0)
    quay.run(60.0)
    assert quay.port.numbers == [START]
    assert not quay.state(sent).is_last
    assert "unknown until the vehicle is heard" in quay.words(sent)
    quay.down = lambda name: True
    quay.run(120.0)
    assert quay.state(sent) is State.DONE


def test_a_queued_command_expires_ashore_and_is_never_sent() -> None:
    """mavlink/qgroundcontrol#9104: a command that is queued for a submerged vehicle acts when nobody expects it."""
    quay = Quay()
    quay.up = lambda name: False
    quay.give("hold", valid_for=500.0)
    queued = quay.give("start", valid_for=30.0)
    quay.run(31.0)
    quay.up = lambda name: True
    quay.run(100.0)
    assert quay.state(queued) is State.EXPIRED
    assert START not in quay.port.numbers
    assert START not in [received.values.get("command") for received in quay.heard]


def test_a_command_is_taken_back_before_it_is_sent_while_it_waits_aboard_and_not_once_it_has_begun() -> None:
    quay = Quay()
    unsent = quay.give("start")
    quay.client.cancel(unsent, quay.shore_t)
    assert quay.state(unsent) is State.CANCELLED
    waits = quay.give("start", when=When.AT_NEXT_SURFACING)
    quay.run(2.0)
    assert quay.state(waits) is State.WAITING
    quay.client.cancel(waits, quay.shore_t)
    quay.run(2.0)
    assert quay.state(waits) is State.CANCELLED
    quay.port.outcome = Progress(State.IN_PROGRESS, 10)
    runs = quay.give("check")
    quay.run(2.0)
    quay.client.cancel(runs, quay.shore_t)
    quay.run(2.0)
    assert quay.state(runs) is State.IN_PROGRESS
    assert len(quay.port.begun) == 1


def test_a_command_that_was_lost_on_its_way_is_cancelled_for_good() -> None:
    """The vehicle remembers an id that it hears of first as taken back: a late copy of the command is not executed."""
    quay = Quay()
    quay.up = lambda name: False
    id = quay.give("start")
    outbox = Outbox()
    quay.t += 1.0
    quay.client.poll(quay.shore_t, outbox)
    late = outbox.next()
    assert late is not None
    quay.client.cancel(id, quay.shore_t)
    quay.up = lambda name: True
    quay.run(10.0)
    assert quay.state(id) is State.CANCELLED
    kind = message_named(late.name)
    quay.tell_vehicle(Received(*SHORE, kind.name, kind.unpack(late.payload)))
    quay.run(1.0)
    assert quay.port.begun == []


def test_time_outs_follow_the_round_trip_and_a_silent_vehicle_is_asked_at_once_when_it_speaks() -> None:
    """PX4/PX4-Autopilot#11078: no flood while nobody answers."""
    quay = Quay()
    quay.up = lambda name: False
    id = quay.give("start", valid_for=7200.0)
    tries = 0

    def count(name: str) -> bool:
        nonlocal tries
        tries += 1
        return False

    quay.up = count
    quay.run(3600.0)
    assert tries <= 3600 / 60 + 6
    quay.up = lambda name: True
    heartbeat = message_named("HEARTBEAT")
    quay.client.take(Received(*VEHICLE, "HEARTBEAT", heartbeat.unpack(b"\0")), quay.shore_t)
    quay.run(0.5)
    assert quay.state(id) is State.DONE


def test_a_killed_shore_station_follows_its_commands_to_the_end() -> None:
    quay = Quay()
    quay.down = lambda name: False
    sent, later = quay.give("start"), quay.give("hold", valid_for=3000.0)
    quay.run(2.0)
    quay.start_shore()
    quay.down = lambda name: True
    quay.run(30.0)
    assert (quay.state(sent), quay.state(later)) == (State.DONE, State.DONE)
    assert quay.port.numbers == [START, HOLD]
    quay.start_shore()
    assert [report.state for report in quay.client.reports(quay.shore_t)] == [State.DONE, State.DONE]


def test_a_shore_station_that_was_killed_after_sending_does_not_call_a_command_unsent() -> None:
    quay = Quay()
    quay.down = lambda name: False
    sent = quay.give("start", valid_for=20.0)
    quay.exchange()
    assert quay.port.numbers == [START]
    quay.start_shore()
    quay.client.cancel(sent, quay.shore_t)
    assert not quay.state(sent).is_last
    quay.run(40.0)
    assert not quay.state(sent).is_last
    quay.down = lambda name: True
    quay.run(90.0)
    assert quay.state(sent) is State.DONE


def test_a_clock_that_is_set_back_takes_open_commands_back() -> None:
    quay = Quay()
    quay.up = lambda name: False
    sent, unsent = quay.give("start"), quay.give("hold")
    quay.run(2.0)
    client = CommandClient(*SHORE, VEHICLE[0], quay.shore_disk, random.Random(9), quay.shore_clock - 7200.0)
    assert client.notes == ["clock is 7198 s behind: open commands are taken back"]  # kept 2 s ago
    assert client.report(unsent, quay.shore_clock - 7200.0).state is State.CANCELLED
    assert not client.report(sent, quay.shore_clock - 7200.0).is_last


def test_a_full_disk_keeps_commands_from_being_given_and_from_being_sent() -> None:
    quay = Quay()
    id = quay.give("start")
    quay.shore_disk.broken = True
    with pytest.raises(CommandError, match="cannot be kept"):
        quay.give("hold")
    quay.run(60.0)
    assert quay.heard == []
    quay.shore_disk.broken = False
    quay.run(30.0)
    assert quay.state(id) is State.DONE


def test_an_abort_goes_out_though_the_disk_is_full() -> None:
    """Said twice after a restart it does no harm; not said at all it may."""
    quay = Quay()
    quay.shore_disk.broken = True
    id = quay.client.abort(quay.shore_t, valid_for=600.0)
    quay.run(60.0)
    assert quay.state(id) is State.DONE


def test_a_damaged_queue_is_told_and_not_followed() -> None:
    quay = Quay()
    quay.give("start")
    content = quay.shore_disk.files["commands"].data
    content[-3] ^= 1
    quay.start_shore()
    assert quay.client.notes == [
        "commands: is damaged: its SHA-256 is another; commands that were given before are not followed any more"
    ]
    assert quay.client.reports(quay.shore_t) == []


@pytest.mark.parametrize(
    ("name", "parameters", "valid_for", "sentence"),
    [
        ("dive", {}, 60.0, "command 'dive': there is none; known are abort, start"),
        ("start", {"speed": 1.0}, 60.0, "start: has no parameter 'speed'; it has none"),
        ("radio-time", {}, 60.0, "radio-time.time: is missing"),
        ("radio-time", {"time": 5.0}, 60.0, "radio-time.time is 5; must be a number from 60 to 86400 s"),
        ("radio-time", {"time": float("nan")}, 60.0, "radio-time.time is nan"),
        ("switch-mission", {"mission": 1.5}, 60.0, "must be a whole number from 0 to 4294967295"),
        ("start", {}, 0.0, "start: valid for 0 s; must be from 1 to"),
        ("start", {}, float("inf"), "start: valid for inf s; must be from 1 to"),
    ],
)
def test_what_cannot_be_given_is_named(
    name: str, parameters: dict[str, float], valid_for: float, sentence: str
) -> None:
    quay = Quay()
    with pytest.raises(CommandError) as told:
        quay.client.give(name, parameters, quay.shore_t, valid_for=valid_for)
    assert sentence in str(told.value)
    assert quay.client.reports(quay.shore_t) == []


def test_the_queue_is_bounded_and_dropping_what_may_still_be_executed_is_refused() -> None:
    quay = Quay()
    quay.up = lambda name: False
    ids = [quay.give("start", valid_for=60.0) for _ in range(MOST_OPEN)]
    with pytest.raises(CommandError, match="64 are open"):
        quay.give("start")
    with pytest.raises(CommandError, match="may still be executed"):
        quay.client.forget(ids[0], quay.shore_t)
    quay.run(90.0)
    quay.client.forget(ids[0], quay.shore_t)
    with pytest.raises(CommandError, match="there is none"):
        quay.client.report(ids[0], quay.shore_t)
