"""Oracles: MAVLink's own values of types and states, and a line that goes quiet when the test says so."""

import pytest

from stommel.link.channel.channel import Channel
from stommel.link.channel.conversation import Conversation
from stommel.link.channel.settings import ChannelSettings
from stommel.link.presence import SHORE_HEARTBEAT, Presence
from stommel.link.service import Received
from stommel.link.session import Session
from stommel.messages.mavlink import Fields, enumeration

VEHICLE: Fields = {"type": 12, "autopilot": 0, "base_mode": 129, "system_status": 4, "mavlink_version": 3}
DAY = 86_400.0


def heard(presence: Presence, t: float, name: str = "HEARTBEAT", **values: int) -> None:
    presence.take(Received(1, 1, name, {**values}), t)


def talk(settings: ChannelSettings, seed: int = 0) -> tuple[Conversation, Presence, Presence]:
    vehicle, shore = Presence(lambda: VEHICLE), Presence(lambda: SHORE_HEARTBEAT)
    sessions = Session(1, 1, [vehicle]), Session(255, 190, [shore])
    return Conversation(*sessions, Channel(settings, seed), step=0.05), vehicle, shore


def test_a_shore_station_says_what_ground_stations_say() -> None:
    assert SHORE_HEARTBEAT["type"] == enumeration("MAV_TYPE")["MAV_TYPE_GCS"]
    assert SHORE_HEARTBEAT["autopilot"] == enumeration("MAV_AUTOPILOT")["MAV_AUTOPILOT_INVALID"]
    assert SHORE_HEARTBEAT["system_status"] == enumeration("MAV_STATE")["MAV_STATE_ACTIVE"]


def test_both_ends_hear_each_other_within_two_heartbeats() -> None:
    conversation, vehicle, shore = talk(ChannelSettings())
    assert conversation.run(lambda: vehicle.is_heard(conversation.t, 255) and shore.is_heard(conversation.t, 1), 2.0)
    assert shore.peers[1, 1].heartbeat["type"] == enumeration("MAV_TYPE")["MAV_TYPE_SUBMARINE"]


@pytest.mark.parametrize("loss", [0.0, 0.4])
def test_loss_alone_makes_nobody_absent(loss: float) -> None:
    conversation, _, shore = talk(ChannelSettings(whole_frames=True, loss=loss), seed=3)
    conversation.run(lambda: False, 30.0)
    absent = 0
    for _ in range(600):
        conversation.run(lambda: False, 1.0)
        absent += not shore.is_heard(conversation.t, 1)
    assert absent <= (0 if not loss else 12)


def test_a_peer_under_water_is_lost_and_is_heard_again_with_its_first_word() -> None:
    """yamcs/yamcs#455: after a day of silence nothing has to be enabled by hand."""
    up = 60.0 + DAY
    conversation, vehicle, shore = talk(ChannelSettings(outages=((60.0, up),)))
    conversation.run(lambda: False, 59.0)
    assert shore.is_heard(conversation.t)
    conversation.run(lambda: False, 11.0)
    assert not shore.is_heard(conversation.t)
    assert not vehicle.is_heard(conversation.t)
    conversation.run(lambda: False, up - 1.0 - conversation.t, step=5.0)
    assert not shore.is_heard(conversation.t)
    assert conversation.run(
        lambda: shore.is_heard(conversation.t) and vehicle.is_heard(conversation.t), 10.0, step=0.05
    )
    assert conversation.t <= up + 5.0
    assert shore.peers[1, 1].since >= up


def test_a_slow_heart_is_waited_for_longer() -> None:
    presence = Presence()
    for number in range(20):
        heard(presence, 10.0 * number)
    assert presence.is_heard(190.0 + 35.0)
    assert not presence.is_heard(190.0 + 61.0)


def test_only_who_is_asked_for_counts() -> None:
    presence = Presence()
    heard(presence, 0.0)
    assert presence.is_heard(1.0, 1, 1)
    assert not presence.is_heard(1.0, 2)
    assert not presence.is_heard(1.0, 1, 190)


def test_a_restart_is_told_by_the_time_since_boot() -> None:
    presence = Presence()
    for boot_ms in (100_000, 101_000, 100_500, 102_000, 500, 1500, 900_000, 2000):
        heard(presence, 0.0, "GLIDER_STATE", time_boot_ms=boot_ms)
    assert presence.peers[1, 1].restarts == 2


def test_a_time_since_boot_that_comes_round_is_no_restart() -> None:
    presence = Presence()
    for boot_ms in (2**32 - 1000, 2**32 - 1, 500, 1000):
        heard(presence, 0.0, "GLIDER_STATE", time_boot_ms=boot_ms)
    assert presence.peers[1, 1].restarts == 0


def test_a_crowd_of_peers_is_bounded() -> None:
    presence = Presence()
    for system in range(256):
        presence.take(Received(system, 1, "HEARTBEAT", {"type": 6}), float(system))
    assert len(presence.peers) == 32
    assert (255, 1) in presence.peers
