"""Oracles: what was put into the other end, the order of priorities, and the arithmetic of the line."""

import itertools
import random
import time
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from stommel.link.channel.channel import Channel, ChannelEnd
from stommel.link.channel.conversation import Conversation
from stommel.link.channel.settings import ChannelSettings
from stommel.link.exchange import exchange
from stommel.link.frames import FrameSplitter, RawFrame, frame_bytes
from stommel.link.outbox import Outbox, Priority
from stommel.link.rate import LineRate, RateError
from stommel.link.session import SILENCE, Session
from stommel.messages.mavlink import Fields, message_named, message_types

from .helpers import Listener, Speaker, Weak

HEARTBEAT: Fields = {"type": 12, "mavlink_version": 3}


def frame(sequence: int = 0, system: int = 9, name: str = "HEARTBEAT", values: Fields = HEARTBEAT) -> bytes:
    message = message_named(name)
    return frame_bytes(message, message.pack(values), system, 1, sequence % 256)


def file_piece(number: int) -> tuple[str, Fields]:
    return "FILE_TRANSFER_PROTOCOL", {"payload": number.to_bytes(4, "big") + bytes(range(1, 240)) + b"\1"}


class Only:
    """A guard that believes one system and marks what it signs."""

    def __init__(self, system: int) -> None:
        self.system, self.signs, self.asked = system, True, 0

    def accept(self, raw: RawFrame, t: float) -> bool:
        self.asked += 1
        return raw.system == self.system

    def sign(self, raw: bytes, t: float) -> bytes:
        return raw + b"S" * 13


def test_services_hear_what_was_said_and_nothing_twice() -> None:
    listener = Listener()
    session = Session(1, 1, [listener])
    data = frame(0) + frame(1) + frame(1) + frame(2)
    assert len(session.take(data, 0.0)) == 3
    assert len(listener.heard) == 3
    assert session.peers()[9, 1].duplicate == 1


def test_each_component_has_a_sequence_of_its_own() -> None:
    """As MAVLink has it: frames of one component between those of another are no frames that are missing."""
    session, listening = Session(1, 1, []), Session(255, 190, [])
    for number in range(600):
        session.outbox.put(Priority.STATE, "HEARTBEAT", HEARTBEAT, (None, 25, 26)[number % 3])
        listening.take(session.poll(float(number), 4096), float(number))
    counts = listening.peers()
    assert {peer: (each.good, each.lost) for peer, each in counts.items()} == {
        (1, component): (200, 0) for component in (1, 25, 26)
    }


def test_own_frames_that_come_back_are_not_heard() -> None:
    session = Session(9, 1, [])
    assert session.take(frame(), 0.0) == []
    assert session.echoes == 1


def test_a_guard_is_asked_and_signs() -> None:
    guard = Only(9)
    session = Session(1, 1, [Speaker(Priority.STATE, [("HEARTBEAT", HEARTBEAT)])], guard)
    assert [received.system for received in session.take(frame(0, 8) + frame(0, 9), 0.0)] == [9]
    assert session.refused == 1
    assert set(session.peers()) == {(9, 1)}
    sent = session.poll(0.0, 1000)
    assert sent.endswith(b"S" * 13)
    (raw,) = FrameSplitter().take(sent)
    assert raw.is_signed


def test_a_service_that_raises_is_a_note_and_the_others_hear_all_the_same() -> None:
    listener = Listener()
    session = Session(1, 1, [Weak(), listener, Speaker(Priority.STATE, [("HEARTBEAT", HEARTBEAT)] * 3)])
    for number in range(100):
        session.take(frame(number), 0.1 * number)
    assert len(listener.heard) == 100
    assert len(FrameSplitter().take(session.poll(10.0, 10_000))) == 3
    assert session.failures >= 101
    assert list(session.notes) == [
        "Weak: cannot bear HEARTBEAT (ValueError: no)",
        "Weak: cannot speak (ValueError: no)",
    ]


@given(st.integers(0, 2**32))
def test_no_value_of_a_valid_frame_raises(seed: int) -> None:
    draw = random.Random(seed)
    kinds = list(message_types().values())
    session = Session(1, 1, [Listener(), Weak("HEARTBEAT", lambda: OverflowError("x" * 1000))])
    for number in range(50):
        kind = draw.choice(kinds)
        payload = draw.randbytes(draw.randrange(1, 256))
        data = frame_bytes(kind, payload, draw.randrange(256), draw.randrange(256), number)
        session.take(data, 0.01 * number)
        session.poll(0.01 * number, 1000)
    assert all(len(note) <= 200 for note in session.notes)
    assert len(session.peers()) <= 32


@given(st.lists(st.binary(max_size=400), max_size=20))
def test_no_bytes_raise(pieces: list[bytes]) -> None:
    session = Session(1, 1, [Listener()])
    for number, piece in enumerate(pieces):
        session.take(piece, 0.3 * number)
        session.take(piece + frame(number)[: len(piece)], 0.3 * number)
    session.take(b"", 1e9)
    assert len(session.take(frame(200) + frame(201), 2e9)) == 2


def test_a_false_beginning_hides_a_frame_no_longer_than_a_silence() -> None:
    listener = Listener()
    session = Session(1, 1, [listener])
    session.take(b"\xfd\xff\x00" + frame(), 0.0)
    session.poll(SILENCE, 1000)
    assert listener.heard == []
    session.poll(SILENCE + 0.01, 1000)
    assert len(listener.heard) == 1


def test_the_beginning_of_a_frame_is_forgotten_after_a_silence() -> None:
    session = Session(1, 1, [])
    session.take(frame(0)[:15], 0.0)
    assert len(session.take(frame(1), 10.0)) == 1
    assert session.bad == 1


def test_a_frame_in_pieces_is_whole_within_the_silence() -> None:
    session = Session(1, 1, [])
    whole = frame()
    taken = [session.take(whole[at : at + 1], 0.4 * at) for at in range(len(whole))]
    assert [len(accepted) for accepted in taken] == [0] * (len(whole) - 1) + [1]


def test_no_more_is_sent_than_the_line_carries() -> None:
    session = Session(1, 1, [Speaker(Priority.DATA, map(file_piece, itertools.count()))], rate=LineRate(9600.0))
    sent = [(0.1 * number, len(session.poll(0.1 * number, 10_000))) for number in range(1, 600)]
    total = sum(count for _, count in sent)
    assert 0.95 * 960 * 59.8 <= total <= 960 * 59.8 + 520
    for begin in (0.0, 20.0, 40.0):
        window = sum(count for t, count in sent if begin < t <= begin + 5.0)
        assert window <= 960 * 5.0 + 520


def test_a_modem_is_given_a_quarter_of_a_second_ahead_after_any_rest() -> None:
    speaker = Speaker(Priority.DATA, map(file_piece, itertools.count()), since=1000.0)
    session = Session(1, 1, [speaker], rate=LineRate(115_200.0))
    assert session.poll(0.0, 10_000) == b""
    assert 0.25 * 11_520 - 280 <= len(session.poll(1000.0, 10_000)) <= 0.25 * 11_520 + 280


def test_a_peer_that_never_stops_leaves_a_part_of_the_line() -> None:
    session = Session(1, 1, [Speaker(Priority.COMMAND, map(file_piece, itertools.count()))], rate=LineRate(9600.0))
    sent = 0
    for number in range(1000):
        session.take(bytes(96), 0.1 * number)
        sent += len(session.poll(0.1 * number, 10_000))
    assert 0.07 * 96 * 1000 <= sent <= 0.15 * 96 * 1000


def test_a_command_overtakes_files_on_a_slow_line() -> None:
    """115.2 kbit/s and a file that never ends: a command arrives within what was handed to the modem before it."""
    vehicle, shore = Listener(), Listener()
    command: tuple[str, Fields] = ("COMMAND_LONG", {"command": 400})
    shore_session = Session(255, 190, [shore])
    speakers = [
        Speaker(Priority.DATA, map(file_piece, itertools.count())),
        Speaker(Priority.STATE, itertools.repeat(("HEARTBEAT", HEARTBEAT))),
        Speaker(Priority.COMMAND, [command], since=10.0),
    ]
    vehicle_session = Session(1, 1, [vehicle, *speakers])
    talk = Conversation(vehicle_session, shore_session, Channel(ChannelSettings(whole_frames=True)))
    assert talk.run(lambda: bool(shore.named("COMMAND_LONG")), 20.0)
    assert talk.t - 10.0 <= 0.25 + 280 / 11_520 + 0.05 + 0.05
    files, states = len(shore.named("FILE_TRANSFER_PROTOCOL")), len(shore.named("HEARTBEAT"))
    share = files * 263 / (files * 263 + states * 21)
    assert 0.11 <= share <= 0.18


@pytest.mark.parametrize("flood", [Priority.COMMAND, Priority.STATE, Priority.SUMMARY])
def test_no_flood_ends_what_is_less_urgent(flood: Priority) -> None:
    outbox = Outbox()
    for priority in Priority:
        if priority > flood:
            outbox.put(priority, "HEARTBEAT", HEARTBEAT)
    names: list[str] = []
    for _ in range(200):
        outbox.put(flood, "SYSTEM_TIME", {"time_boot_ms": 1})
        outgoing = outbox.next()
        assert outgoing is not None
        names.append(outgoing.name)
    assert names.count("HEARTBEAT") == sum(priority > flood for priority in Priority)


def test_nothing_goes_before_an_abort() -> None:
    outbox = Outbox()
    for _ in range(300):
        outbox.put(Priority.ABORT, "SYSTEM_TIME", {"time_boot_ms": 1})
        outbox.put(Priority.DATA, "HEARTBEAT", HEARTBEAT)
        outgoing = outbox.next()
        assert outgoing is not None
        assert outgoing.name == "SYSTEM_TIME"


def test_bytes_without_frames_are_named() -> None:
    session = Session(1, 1, [])
    draw = random.Random(1)
    for number in range(100):
        session.take(bytes(byte & 0x7F for byte in draw.randbytes(20)), 0.2 * number)
    assert session.line.complaint(20.0).startswith("2000 bytes came, but no frame in them")
    session.take(frame(), 20.0)
    assert session.line.complaint(20.0) == ""
    assert Session(1, 1, []).line.complaint(1e6) == ""


def test_after_a_day_of_silence_data_are_received_at_once() -> None:
    """yamcs/yamcs#455: after silence a link received nothing until it was enabled again by hand."""
    listener = Listener()
    session = Session(1, 1, [listener], rate=LineRate(9600.0))
    session.take(frame(7), 0.0)
    for t in range(0, 86_400, 10):
        session.take(b"", float(t))
        session.poll(float(t), 1000)
    assert len(session.take(frame(99), 86_400.0)) == 1
    assert session.peers()[9, 1].lost == 0


def test_a_rate_that_cannot_be_is_refused() -> None:
    with pytest.raises(RateError, match=r"link\.bit_rate = 0: must be from 10 to 1e9"):
        LineRate(0)
    with pytest.raises(RateError, match=r"link\.turn_round = -1: must be from 0 to 10"):
        LineRate(9600.0, turn_round=-1)


def test_session_code_is_fast_enough_for_the_figure() -> None:
    """A wide share of the bar of 5000 messages/s, so that a busy machine does not fail; the bench has the figure."""
    sender = Session(1, 1, [Speaker(Priority.DATA, map(file_piece, range(2000)))])
    receiver: Any = Session(255, 190, [Listener()])
    begin = time.process_time()
    while data := sender.poll(0.0, 4096):
        receiver.take(data, 0.0)
    assert receiver.peers()[1, 1].good == 2000
    assert time.process_time() - begin < 2.0


class Silent:
    """A modem that says nothing of what waits in it, as most radios."""

    def __init__(self, end: ChannelEnd) -> None:
        self._end = end

    def read(self, t: float) -> bytes:
        return self._end.read(t)

    def write(self, data: bytes, t: float) -> int:
        self._end.write(data, t)
        return len(data)

    def room(self, t: float) -> int:
        return 65_536

    def waiting(self, t: float) -> int:
        return 0


@pytest.mark.parametrize("every", [0.1, 0.3, 1.0])
def test_a_modem_that_says_nothing_of_its_buffer_does_not_overflow(every: float) -> None:
    """A file one way and a word the other way now and then, for two minutes; the line is used well all the same."""
    ears, t = Listener(), 0.0
    vehicle = Session(1, 1, [Speaker(Priority.DATA, map(file_piece, itertools.count()))], rate=LineRate(115_200.0))
    shore = Session(255, 190, [ears], rate=LineRate(115_200.0))
    channel = Channel(ChannelSettings(latency=0.5, whole_frames=True))
    for number in range(12_000):
        t = 0.01 * number
        if number % round(every / 0.01) == 0:
            shore.outbox.put(Priority.COMMAND, *file_piece(0))
        exchange(vehicle, Silent(channel.vehicle), t)
        exchange(shore, Silent(channel.shore), t)
    counts = channel.vehicle.counts
    assert counts.refused_bytes <= 0.005 * counts.sent_bytes
    free = 1.0 - (275 / 11_520 + 0.02) / every
    assert len(ears.heard) * 263 >= 0.93 * free * 11_520 * t
