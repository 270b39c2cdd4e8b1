"""Oracle: who holds which key. Two sessions with guards over a bad channel, and a stranger in between."""

import itertools
import random

from stommel.link.channel.channel import Channel
from stommel.link.channel.conversation import Conversation
from stommel.link.channel.settings import ChannelSettings
from stommel.link.frames import frame_bytes
from stommel.link.presence import SHORE_HEARTBEAT, Presence
from stommel.link.service import SHORE_COMPONENT, SHORE_SYSTEM
from stommel.link.session import Session
from stommel.link.signing.guard import Guard, PortGuard
from stommel.link.statistics import Statistics
from stommel.messages.mavlink import message_named
from tests.onboard.coordination.disk import Disk

from .helpers import Listener
from .signing.ends import CLOCK, KEY, OTHER, VEHICLE, KeyDisk, keys_of, seeded


def signed_session(system: int, component: int, key: object = KEY) -> tuple[Session, Guard, Listener, Statistics]:
    guard = Guard(system, KeyDisk(keys_of(key)), Disk(), CLOCK, seeded(system))  # type: ignore[arg-type]
    listener = Listener()
    session = Session(system, component, [Presence(lambda: SHORE_HEARTBEAT), listener], PortGuard(guard))
    statistics = Statistics(session, refusals=guard.refusals)
    session.services.append(statistics)
    return session, guard, listener, statistics


def test_two_ends_with_one_key_hear_each_other_and_no_stranger() -> None:
    vehicle, guard, vehicle_hears, statistics = signed_session(VEHICLE, 1)
    shore, _, shore_hears, _ = signed_session(SHORE_SYSTEM, SHORE_COMPONENT)
    stranger, _, _, _ = signed_session(200, 1, OTHER)
    talk = Conversation(vehicle, shore, Channel(ChannelSettings(whole_frames=True, loss=0.2), seed=4), step=0.02)
    command = message_named("COMMAND_LONG")
    draw = random.Random(1)
    for number in itertools.count():
        talk.run(lambda: False, 1.0)
        vehicle.take(stranger.poll(talk.t, 1000), talk.t)
        payload = command.pack({"command": draw.randrange(65_536)})
        vehicle.take(frame_bytes(command, payload, SHORE_SYSTEM, SHORE_COMPONENT, number % 256), talk.t)
        if number == 60:
            break
    assert {received.system for _, received in vehicle_hears.heard} == {SHORE_SYSTEM}
    assert {received.system for _, received in shore_hears.heard} == {VEHICLE}
    assert not vehicle_hears.named("COMMAND_LONG")
    assert guard.refusals.unsigned == 61
    assert guard.refusals.wrongly_signed >= 60
    assert guard.refusals.replayed == 0
    assert set(vehicle.peers()) == {(SHORE_SYSTEM, SHORE_COMPONENT)}
    seen = statistics.of((SHORE_SYSTEM, SHORE_COMPONENT), talk.t)
    assert seen.is_signing
    assert seen.refusals.unsigned == 61
    told = shore_hears.named("LINK_STATISTICS")[-1].values
    assert told["is_signing"] == 1
    assert int(str(told["unsigned_refused"])) > 40


def test_a_key_that_is_missing_is_silence_not_trust() -> None:
    """PX4/PX4-Autopilot#26847: signing required and no key meant that everything was accepted."""
    guard = Guard(VEHICLE, KeyDisk(None), Disk(), CLOCK, seeded(1))
    listener = Listener()
    session = Session(VEHICLE, 1, [listener], PortGuard(guard))
    shore, _, _, _ = signed_session(SHORE_SYSTEM, SHORE_COMPONENT)
    for t in range(30):
        session.take(shore.poll(float(t), 1000), float(t))
    assert listener.heard == []
    assert guard.alarm
