"""Heartbeats and versions. Oracle: the brief's rules, counted by hand."""

import pytest

from stommel.messages.codec import Decoder, Encoder, Rejected
from stommel.messages.database import ACQUISITION, MOTION, database_hash, words_of
from stommel.messages.frames import Frame
from stommel.messages.nodes import HeartbeatSender, Network, NodeKind, NodeReport, NodeState, NodeWatch


class Bus:
    """A node's sender and a watch on the other side."""

    def __init__(self, silent_after: int = 3) -> None:
        self.decoder = Decoder()
        self.watch = NodeWatch((MOTION, ACQUISITION), 0.0, silent_after)
        self.start(0)

    def start(self, restarts: int) -> None:
        self.encoder = Encoder()
        self.sender = HeartbeatSender(MOTION, self.encoder, restarts, NodeKind(3, (1, 2, 3)))

    def hear(self, frames: list[Frame], t: float) -> None:
        for frame in frames:
            self.watch.take(self.decoder.take(frame), t)

    def second(self, t: float, state: NodeState = NodeState.Operational) -> None:
        self.hear(self.sender.poll(t, state), t)

    def motion(self, t: float) -> NodeReport:
        return self.watch.snapshot(t).nodes[0]


def test_states_are_those_of_the_database() -> None:
    for node in ("Coordinator", "Motion", "Acquisition"):
        assert words_of(f"{node}Heartbeat", "state") == {state.value: state.name for state in NodeState}


def test_a_heartbeat_each_second_and_information_every_ten() -> None:
    sender = HeartbeatSender(MOTION, Encoder())
    sent = [(frame.identifier, k) for k in range(200) for frame in sender.poll(k * 0.1, NodeState.Safe)]
    assert [k for identifier, k in sent if identifier == 0x702] == list(range(0, 200, 10))
    assert [k for identifier, k in sent if identifier == 0x722] == [0, 100]


def test_what_a_node_says_is_known() -> None:
    bus = Bus()
    bus.start(7)
    for t in range(5):
        bus.second(float(t))
    report = bus.motion(4.0)
    assert report == NodeReport(
        "Motion", "Operational", 7, 0, 4.0, 4.0, silent=False, lost=0, version=(1, 2, 3), hardware=3, refused="",
        emergencies=(),
    )  # fmt: skip


@pytest.mark.parametrize("missed", [1, 2, 3])
def test_lost_frames_are_a_count_and_no_alarm(missed: int) -> None:
    """Field report 30, ArduPilot/ardupilot#13033: one lost frame was an alarm."""
    bus = Bus()
    for t in range(20):
        frames = bus.sender.poll(float(t), NodeState.Operational)
        if not 5 <= t < 5 + missed:
            bus.hear(frames, float(t))
        assert not bus.watch.is_silent(MOTION, float(t))
    assert bus.motion(19.0).lost == missed


@pytest.mark.parametrize("patience", [1, 3, 8])
def test_silent_after_as_many_missed_as_allowed_and_back_again(patience: int) -> None:
    bus = Bus(patience)
    for t in range(6):
        bus.second(float(t))
    assert next(t for t in range(6, 30) if bus.watch.is_silent(MOTION, float(t))) == 6 + patience
    bus.second(30.0)
    assert not bus.watch.is_silent(MOTION, 30.0)


def test_a_node_that_never_spoke_is_silent() -> None:
    bus = Bus()
    assert not bus.watch.is_silent(ACQUISITION, 3.0)
    assert bus.watch.is_silent(ACQUISITION, 4.0)
    assert bus.watch.snapshot(4.0).nodes[1].heard is None


@pytest.mark.parametrize("before", range(1, 18))
def test_each_restart_is_seen_once(before: int) -> None:
    """Whatever the alive counter stood at as it restarted."""
    bus = Bus()
    for t in range(before):
        bus.second(float(t))
    bus.start(1)
    for t in range(before, before + 5):
        bus.second(float(t))
    report = bus.motion(before + 4.0)
    assert (report.restarts, report.restarts_seen, report.silent) == (1, 1, False)


def test_a_node_with_another_database_is_refused_and_named() -> None:
    bus = Bus()
    theirs = database_hash() ^ 0x000100
    good, bad = (
        Encoder().frame(
            "MotionInformation", hardware=0, version_major=0, version_minor=0, version_patch=0, database_hash=number
        )
        for number in (database_hash(), theirs)
    )
    status = bus.decoder.take(Encoder().frame("MotionHeartbeat", state=2, restarts=0, uptime=0))
    depth = bus.decoder.take(Encoder().frame("AcquisitionHeartbeat", state=2, restarts=0, uptime=0))
    assert not isinstance(status, Rejected)
    assert not isinstance(depth, Rejected)
    bus.hear([bad], 0.0)
    assert bus.motion(0.0).refused == f"Motion: CAN database {theirs:06x}, must be {database_hash():06x}"
    assert not bus.watch.obeys(status)
    assert bus.watch.obeys(depth)
    bus.hear([good], 1.0)
    assert bus.watch.obeys(status)


def test_strangers_are_named() -> None:
    """Field report 29, PX4/PX4-Autopilot#28243: unknown nodes were refused in silence."""
    bus = Bus()
    bus.hear([Frame(0x709, bytes(8)), Frame(0x729, bytes(8)), Frame(0x709, bytes(8)), Frame(0x333, b"")], 0.0)
    bus.hear([Frame(0x702, bytes(7)), Frame(0x702, bytes(8))], 0.0)
    network = bus.watch.snapshot(0.0)
    assert network.unknown == (
        ("0x333", 1), ("0x709: heartbeat of an unknown node 9", 2), ("0x729: information of an unknown node 9", 1),
    )  # fmt: skip
    assert network.rejected == (("MotionHeartbeat", "checksum", 1), ("MotionHeartbeat", "length", 1))


def test_emergencies_hold_until_they_end() -> None:
    bus = Bus()
    code = {word: number for number, word in words_of("MotionEmergency", "code").items()}["PumpStuck"]
    bus.hear([bus.encoder.frame("MotionEmergency", code=code, active=1, detail=0)], 0.0)
    assert bus.motion(0.0).emergencies == ("PumpStuck",)
    bus.hear([bus.encoder.frame("MotionEmergency", code=code, active=0, detail=0)], 1.0)
    assert bus.motion(1.0).emergencies == ()


def test_a_snapshot_stays_as_it_was() -> None:
    bus = Bus()
    bus.second(0.0)
    before = bus.watch.snapshot(0.0)
    bus.hear([Frame(0x333, b"")], 1.0)
    bus.second(1.0)
    assert isinstance(before, Network)
    assert before.unknown == ()
    assert before.nodes[0].heard == 0.0
    assert hash(before) is not None
