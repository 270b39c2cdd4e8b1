"""Commands aboard. Oracle: what the vehicle has begun, and what it has on its disk."""

from itertools import pairwise

import pytest

from stommel.link.commands.ledger import FOR_ABORTS
from stommel.link.commands.port import Answer, Readiness
from stommel.link.commands.states import MOST_AHEAD, Command, Progress, State, When
from stommel.link.commands.table import ABORT, HOLD, RADIO_TIME, START
from stommel.link.outbox import Outbox
from stommel.link.service import Received
from stommel.messages.mavlink import FieldValue, message_named
from tests.link.commands.quay import EPOCH, SHORE, VEHICLE, Quay, sayings
from tests.onboard.coordination.disk import PowerCutError


def said(command: Command, **other: FieldValue) -> Received:
    """A command as it arrives."""
    kind = message_named("GLIDER_COMMAND")
    return Received(*SHORE, kind.name, kind.unpack(kind.pack(command.values(*VEHICLE, 1) | other)))


def asked(command: Command, cancel: int = 0) -> Received:
    """A question for it."""
    kind = message_named("GLIDER_COMMAND_ASK")
    values: dict[str, FieldValue] = {
        "id": command.id, "given": command.given, "expires": command.expires, "cancel": cancel, "asking": 7,
        "target_system": VEHICLE[0], "target_component": VEHICLE[1],
    }  # fmt: skip
    return Received(*SHORE, kind.name, kind.unpack(kind.pack(values)))


def command(
    quay: Quay, id: int, number: int = START, *, when: When = When.UNTIL_EXPIRY, valid_for: float = 60.0
) -> Command:
    now = int(quay.shore_clock * 1000.0)
    return Command(id, number, (0.0,) * 4, when, now, now + int(valid_for * 1000.0))


def answer(quay: Quay, received: Received) -> tuple[State, str]:
    """What the vehicle answers."""
    quay.server.take(received, quay.t)
    outbox = Outbox()
    quay.server.poll(quay.t, outbox)
    values = [saying.values for saying in sayings(outbox, VEHICLE) if saying.values["id"] == received.values["id"]]
    (found,) = values
    return State(int(found["state"])), str(found["words"])  # type: ignore[arg-type]


def poll(quay: Quay, seconds: float) -> None:
    quay.t += seconds
    quay.server.poll(quay.t, Outbox())


def test_copies_of_a_command_are_answered_and_not_executed() -> None:
    quay = Quay()
    for _ in range(5):
        assert answer(quay, said(command(quay, 1))) == (State.DONE, "")
    quay.start_vehicle()
    assert answer(quay, said(command(quay, 1))) == (State.DONE, "")
    assert quay.port.numbers == [START]


def test_nothing_is_begun_before_clocks_are_compared_nor_from_its_expiry_on() -> None:
    quay = Quay()
    quay.clock.offset = None
    early = command(quay, 1)
    assert answer(quay, said(early)) == (State.RECEIVED, "clock of the sender is not compared yet")
    # the comparison leaves open whether 59.9 s or 60 s have passed
    quay.t += 59.9
    quay.clock.offset = EPOCH + 0.1
    assert answer(quay, said(early))[0] is State.EXPIRED
    quay.clock.offset = EPOCH
    assert answer(quay, said(early))[0] is State.EXPIRED
    assert quay.port.begun == []
    assert answer(quay, said(command(quay, 2)))[0] is State.DONE


def test_a_command_that_waits_expires_aboard_also_if_the_clock_ashore_is_set_back() -> None:
    """mavlink/qgroundcontrol#9104."""
    quay = Quay()
    quay.port.answer = Answer(Readiness.NOT_YET, "the start checks run")
    first, second = command(quay, 1), command(quay, 2)
    assert answer(quay, said(first)) == (State.WAITING, "the start checks run")
    answer(quay, said(second))
    poll(quay, 1.0)
    quay.clock.offset = EPOCH - 3600.0
    poll(quay, 60.0)
    quay.port.answer = Answer(Readiness.READY)
    poll(quay, 1.0)
    assert quay.port.begun == []
    assert answer(quay, asked(first))[0] is State.EXPIRED


def test_a_command_that_waits_is_begun_when_the_vehicle_can() -> None:
    quay = Quay()
    quay.port.answer = Answer(Readiness.NOT_YET, "not now")
    waits = command(quay, 1)
    answer(quay, said(waits))
    quay.start_vehicle()
    poll(quay, 30.0)
    quay.port.answer = Answer(Readiness.READY)
    poll(quay, 1.0)
    assert quay.port.begun == [waits]


@pytest.mark.parametrize("restarts", [False, True])
def test_at_the_next_surfacing_is_after_the_dive_that_follows(restarts: bool) -> None:
    quay = Quay()
    waits = command(quay, 1, HOLD, when=When.AT_NEXT_SURFACING)
    assert answer(quay, said(waits)) == (State.WAITING, "waits for the next surfacing")
    poll(quay, 5.0)
    quay.port.is_submerged = True
    poll(quay, 5.0)
    assert quay.port.begun == []
    if restarts:
        quay.start_vehicle()
    quay.port.is_submerged = False
    poll(quay, 5.0)
    assert quay.port.begun == [waits]


def test_at_once_or_never_does_not_wait() -> None:
    quay = Quay()
    quay.port.answer = Answer(Readiness.NOT_YET, "the start checks run")
    now_only = command(quay, 1, when=When.AT_ONCE)
    assert answer(quay, said(now_only)) == (State.REFUSED, "the start checks run")
    quay.port.answer = Answer(Readiness.READY)
    assert answer(quay, said(now_only))[0] is State.REFUSED
    poll(quay, 1.0)
    assert quay.port.begun == []


def test_power_cut_anywhere_in_the_execution_never_executes_twice() -> None:
    """The power goes at each operation of the disk in turn, the last before the execution or the first after it."""
    outcomes = set()
    for operations in range(1, 40):
        quay = Quay()
        quay.vehicle_disk.operations_left = operations
        one = command(quay, 1)
        try:
            answer(quay, said(one))
        except PowerCutError:
            quay.vehicle_disk = quay.vehicle_disk.after_power_cut(quay.client._draw, keeps_unsynced=False)
            quay.start_vehicle()
        quay.vehicle_disk.operations_left = None
        before = len(quay.port.begun)
        state, words = answer(quay, said(one))
        outcomes.add((before, state))
        assert len(quay.port.begun) <= 1
        if state is State.OUTCOME_UNKNOWN:
            assert words == "power failed while it was executed; not executed again"
            assert len(quay.port.begun) == before
    assert outcomes == {(0, State.DONE), (1, State.OUTCOME_UNKNOWN), (1, State.DONE)}


@pytest.mark.parametrize("has_effect", [False, True])
def test_power_cut_in_the_middle_of_an_execution_leaves_its_outcome_unknown(
    has_effect: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    quay = Quay()
    one = command(quay, 1)

    def begin(begun: Command) -> Progress:
        if has_effect:
            quay.port.begun.append(begun)
        raise PowerCutError

    monkeypatch.setattr(quay.port, "begin", begin)
    with pytest.raises(PowerCutError):
        answer(quay, said(one))
    monkeypatch.undo()
    for _ in range(2):
        quay.start_vehicle()
        assert answer(quay, said(one)) == (
            State.OUTCOME_UNKNOWN, "power failed while it was executed; not executed again",
        )  # fmt: skip
    assert len(quay.port.begun) == has_effect


def test_a_full_ledger_refuses_with_words_and_forgets_only_what_has_expired() -> None:
    quay = Quay(most=FOR_ABORTS + 3)
    old = [command(quay, id, valid_for=60.0) for id in (1, 2, 3)]
    for one in old:
        answer(quay, said(one))
    assert answer(quay, said(command(quay, 4))) == (State.RECEIVED, "ledger is full: no command in it has expired")
    assert answer(quay, said(command(quay, 5, ABORT)))[0] is State.DONE
    quay.t += 61.0
    assert answer(quay, said(command(quay, 6)))[0] is State.DONE
    # a late copy of the one that gave way, by a clock that was compared anew and is less in doubt
    quay.clock.offset = EPOCH - 3.0
    for one in old:
        assert answer(quay, said(one))[0] in (State.FORGOTTEN, State.DONE)
    assert quay.port.numbers == [START, START, START, ABORT, START]
    assert answer(quay, asked(old[0])) == (State.FORGOTTEN, "older than what the vehicle remembers")


def test_a_damaged_ledger_executes_nothing_that_was_given_before() -> None:
    quay = Quay()
    done, waits = command(quay, 1), command(quay, 2, when=When.AT_NEXT_SURFACING)
    for one in (done, waits):
        answer(quay, said(one))
    content = quay.vehicle_disk.files["commands"].data
    content[len(content) // 2] ^= 4
    quay.start_vehicle()
    assert quay.server.notes == [
        "commands: is damaged: its SHA-256 is another; no command that was given before now is executed any more"
    ]
    quay.clock.offset = None
    assert answer(quay, said(done))[0] is State.RECEIVED
    quay.clock.offset = EPOCH
    quay.t += 1.0
    for one in (done, waits):
        assert answer(quay, said(one))[0] is State.FORGOTTEN
    quay.start_vehicle()
    assert answer(quay, said(done))[0] is State.FORGOTTEN
    quay.t += 1.0
    assert answer(quay, said(command(quay, 3)))[0] is State.DONE
    assert quay.port.numbers == [START, START]


def test_a_disk_that_takes_nothing_keeps_commands_from_being_executed() -> None:
    quay = Quay()
    quay.vehicle_disk.broken = True
    one = command(quay, 1)
    state, words = answer(quay, said(one))
    assert (state, words) == (State.RECEIVED, "disk does not keep it: Input/output error")
    assert quay.port.begun == []
    quay.vehicle_disk.broken = False
    assert answer(quay, said(one))[0] is State.DONE


def test_an_abort_overtakes_what_waits_and_what_was_given_before_it() -> None:
    quay = Quay()
    waits, late = command(quay, 1, when=When.AT_NEXT_SURFACING), command(quay, 2)
    answer(quay, said(waits))
    quay.t += 1.0
    assert answer(quay, said(command(quay, 3, ABORT)))[0] is State.DONE
    assert answer(quay, asked(waits)) == (State.CANCELLED, "an abort overtook it")
    assert answer(quay, said(late)) == (State.CANCELLED, "an abort overtook it")
    quay.t += 1.0
    assert answer(quay, said(command(quay, 4)))[0] is State.DONE
    assert quay.port.numbers == [ABORT, START]


def test_an_older_abort_that_comes_late_does_not_let_through_what_a_newer_one_has_overtaken() -> None:
    quay = Quay()
    older = command(quay, 1, ABORT)
    quay.t += 1.0
    between = command(quay, 2)
    quay.t += 1.0
    newer = command(quay, 3, ABORT)
    for one in (newer, older):
        assert answer(quay, said(one))[0] is State.DONE
    assert answer(quay, said(between))[0] is State.CANCELLED


def test_the_mark_of_an_abort_given_by_a_clock_that_ran_ahead_is_void_once_that_is_put_right() -> None:
    quay = Quay()
    quay.clock.offset = EPOCH + 86_400.0
    ahead = command(quay, 1, ABORT)
    ahead = ahead._replace(given=ahead.given + 86_400_000, expires=ahead.expires + 86_400_000)
    assert answer(quay, said(ahead))[0] is State.DONE
    quay.clock.offset = EPOCH
    quay.t += 1.0
    assert answer(quay, said(command(quay, 2)))[0] is State.DONE
    quay.t += 1.0
    assert answer(quay, said(command(quay, 3, ABORT)))[0] is State.DONE
    assert quay.port.numbers == [ABORT, START, ABORT]


@pytest.mark.parametrize("disk_fails", [False, True])
def test_an_abort_by_another_way_overtakes_as_well(disk_fails: bool) -> None:
    quay = Quay()
    waits, late = command(quay, 1, when=When.AT_NEXT_SURFACING), command(quay, 2)
    answer(quay, said(waits))
    quay.t += 1.0
    quay.vehicle_disk.broken = disk_fails
    quay.server.abort_came(quay.t)
    quay.port.is_submerged = True
    poll(quay, 1.0)
    quay.port.is_submerged = False
    poll(quay, 1.0)
    quay.vehicle_disk.broken = False
    poll(quay, 20.0)
    assert answer(quay, asked(waits))[0] is State.CANCELLED
    assert answer(quay, said(late))[0] is State.CANCELLED
    assert quay.port.begun == []


def test_a_command_in_progress_is_reported_with_its_share_and_not_too_often() -> None:
    quay = Quay()
    quay.port.outcome = Progress(State.IN_PROGRESS, 0)
    quay.give("check")
    quay.run(1.0)
    (id,) = quay.port.running
    quay.said.clear()
    for percent in range(100):
        quay.port.running[id] = Progress(State.IN_PROGRESS, percent)
        quay.run(0.1, 0.1)
    shares = [received.values["percent"] for received in quay.said]
    assert 9 <= len(shares) <= 14  # each second, and what the shore station asked
    assert all(one <= other for one, other in pairwise(shares))  # type: ignore[operator]
    quay.port.running[id] = Progress(State.FAILED, 99, "pump does not follow")
    quay.run(0.5)
    assert (quay.state(id), quay.words(id)) == (State.FAILED, "pump does not follow")


def test_what_no_vehicle_can_do_is_refused_with_words() -> None:
    quay = Quay()
    assert answer(quay, said(command(quay, 1, 5))) == (State.REFUSED, "command 5: there is none")
    assert answer(quay, said(command(quay, 2, RADIO_TIME)))[1].startswith("radio-time.time is 0; must be a number")
    far = command(quay, 3, valid_for=MOST_AHEAD / 1000.0 + 1.0)
    assert answer(quay, said(far)) == (State.REFUSED, "expires in more than 31 days")
    assert answer(quay, said(command(quay, 4), parameters=(0.0, 1.0)))[0] is State.REFUSED
    quay.port.answer = Answer(Readiness.NEVER, "there is no mission")
    assert answer(quay, said(command(quay, 5))) == (State.REFUSED, "there is no mission")
    assert quay.port.begun == []


def test_strangers_and_commands_that_contradict_themselves_are_passed_over() -> None:
    quay = Quay()
    good = command(quay, 1, when=When.AT_NEXT_SURFACING)
    assert answer(quay, said(good))[0] is State.WAITING
    strange = [
        said(command(quay, 0)),
        said(command(quay, 2), when=9),
        said(command(quay, 2), expires=good.given),
        said(command(quay, 2), expires=2**63),
        said(command(quay, 2), parameters=(float("nan"),)),
        said(good._replace(number=HOLD)),
        said(good._replace(expires=good.expires + 1)),
        asked(good._replace(expires=good.expires + 1), cancel=1),
    ]
    for received in strange:
        quay.server.take(received, quay.t)
    assert quay.server.passed_over == len(strange)
    for received in (
        said(command(quay, 2))._replace(system=7),
        said(command(quay, 2), target_system=9),
        said(command(quay, 2), target_system=0),
        said(command(quay, 2), target_component=0),
    ):
        quay.server.take(received, quay.t)
    outbox = Outbox()
    quay.server.poll(quay.t, outbox)
    assert outbox.next() is None
    assert answer(quay, asked(good))[0] is State.WAITING
    assert quay.port.begun == []


def test_questions_beyond_what_can_be_answered_at_once_do_not_grow() -> None:
    quay = Quay()
    for id in range(1, 1000):
        quay.server.take(asked(command(quay, id)), quay.t)
    outbox = Outbox()
    quay.server.poll(quay.t, outbox)
    assert len(sayings(outbox, VEHICLE)) <= 64
    assert outbox.dropped == 0
