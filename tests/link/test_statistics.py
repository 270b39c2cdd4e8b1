"""Oracles: the counts of the simulated channel, and the arithmetic of goodput."""

import math

import pytest

from stommel.link.channel.channel import Channel
from stommel.link.channel.conversation import Conversation
from stommel.link.channel.settings import ChannelSettings
from stommel.link.presence import SHORE_HEARTBEAT, Presence
from stommel.link.session import Session
from stommel.link.statistics import Refusals, Statistics
from stommel.link.time_sync import TimeSync
from stommel.link.traffic import Traffic


def test_both_ends_know_how_the_link_is_and_tell_it() -> None:
    channel = Channel(ChannelSettings(whole_frames=True, loss=0.2, latency=0.3), seed=1)
    sync = TimeSync()
    vehicle = Session(1, 1, [Presence(lambda: SHORE_HEARTBEAT, period=0.2), TimeSync()])
    shore = Session(255, 190, [Presence(lambda: SHORE_HEARTBEAT, period=1.0), sync])
    of_vehicle = Statistics(vehicle, surface_time_left=lambda: 77.0, refusals=Refusals(1, 2, 3))
    of_shore = Statistics(shore, sync)
    vehicle.services.append(of_vehicle)
    shore.services.append(of_shore)
    talk = Conversation(vehicle, shore, channel, step=0.02)
    talk.run(lambda: False, 600.0)
    seen = of_shore.of((1, 1), talk.t)
    counts = channel.vehicle.counts
    assert seen.good == counts.packets - counts.lost - len(channel.shore.under_way)
    assert seen.lost == pytest.approx(counts.lost, abs=5)
    assert seen.loss == pytest.approx(0.2, abs=0.03)
    assert seen.duplicate == seen.bad == 0
    assert seen.round_trip_time == pytest.approx(0.6, abs=0.1)
    assert seen.time_out > seen.round_trip_time
    assert not seen.is_signing
    t, told = of_shore.told[1, 1]
    assert talk.t - t < 40.0
    assert (told["peer_system"], told["peer_component"]) == (255, 190)
    assert told["good"] == pytest.approx(of_vehicle.of((255, 190), t).good, abs=60)
    assert told["surface_time_left"] == 77.0
    assert (told["unsigned_refused"], told["wrongly_signed_refused"], told["replayed_refused"]) == (1, 2, 3)
    assert isinstance(told["round_trip_time"], float)
    assert math.isnan(told["round_trip_time"])


def test_a_peer_that_was_never_heard_has_zeros() -> None:
    seen = Statistics(Session(1, 1, [])).of((9, 9), 0.0)
    assert seen.good == seen.lost == 0
    assert seen.loss == 0.0
    assert math.isnan(seen.time_out)


def test_goodput_is_that_of_the_last_ten_seconds() -> None:
    traffic = Traffic()
    for number in range(3000):
        traffic.received(100, 0.01 * number)
        if number == 200:
            assert traffic.goodput(2.0) == pytest.approx(1e4, rel=0.05)
    assert traffic.goodput(30.0) == pytest.approx(1e4, rel=0.05)
    assert traffic.goodput(35.0) == pytest.approx(5e3, rel=0.05)
    assert traffic.goodput(41.0) == 0.0
    assert traffic.new_bytes == 300_000


def test_what_is_sent_again_is_held_against_all_that_is_sent() -> None:
    traffic = Traffic()
    assert traffic.retransmit_ratio == 0.0
    traffic.sent(900)
    traffic.sent(100, again=True)
    assert traffic.retransmit_ratio == pytest.approx(0.1)
