"""Vehicles that are silent, and several of them. Oracle: what each said."""

import time
from pathlib import Path

import pytest

from stommel.station.channels import channel_named
from stommel.station.clock import VehicleClock
from stommel.station.periods import Periods
from tests.station.client import Client
from tests.station.speaker import speaker, until
from tests.station.stations import station

DAY = 86_400.0


def test_after_a_day_of_silence_data_are_received_at_once(tmp_path: Path) -> None:
    """yamcs/yamcs#455: after silence nothing has to be enabled again."""
    with speaker() as vehicle, station(tmp_path, vehicle.address, start=False) as found:
        ticks = [0.0]
        clock = found.vehicles[1].clock
        real = VehicleClock.link_now
        clock.link_now = lambda: real(clock) + ticks[0]  # type: ignore[method-assign]
        found.start()
        vehicle.connect()
        vehicle.say("GLIDER_STATE", time_boot_ms=1, depth=1.0)
        until(lambda: found.vehicles[1].status().heard)
        ticks[0] = DAY
        until(lambda: not found.vehicles[1].status().heard)
        assert found.summary(1)["now"] - found.summary(1)["last_contact"] > 0.99 * DAY
        vehicle.say("GLIDER_STATE", time_boot_ms=1 + int(1000 * DAY), depth=2.0)
        until(lambda: found.hub.values(1)["depth_m"][1] == 2.0)
        until(lambda: found.vehicles[1].status().heard)


def test_several_vehicles_at_once_are_kept_apart(tmp_path: Path) -> None:
    with (
        speaker(1) as one, speaker(2) as two, speaker(3) as three,
        station(tmp_path, one.address, two.address, three.address) as found,
    ):  # fmt: skip
        for vehicle in (one, two, three):
            vehicle.connect()
        for k in range(100):
            for vehicle in (one, two, three):
                vehicle.say("GLIDER_STATE", time_boot_ms=k, depth=1000.0 * vehicle.system + k)
        for number in (1, 2, 3):
            until(lambda: found.hub.values(number).get("depth_m", (0, 0))[1] == 1000.0 * number + 99)  # noqa: B023
            assert found.archive.series(number, "depth_m", 0.0, 4e9).samples == 100
        two.close()  # for good: a line that can open again does so between two looks at its status
        until(lambda: not found.vehicles[2].status().is_open)
        one.say("GLIDER_STATE", time_boot_ms=500, depth=7.0)
        until(lambda: found.hub.values(1)["depth_m"][1] == 7.0)


def test_a_restart_of_the_station_forgets_neither_the_dive_nor_the_way(tmp_path: Path) -> None:
    with speaker() as vehicle:
        with station(tmp_path, vehicle.address) as found:
            vehicle.connect()
            now = time.time()
            vehicle.say("SYSTEM_TIME", time_unix_usec=int(now * 1e6), time_boot_ms=10_000_000)
            vehicle.say("NAVIGATION_ESTIMATE", time_boot_ms=9_990_000, waypoint_distance=5000.0)
            vehicle.say("GLIDER_STATE", time_boot_ms=9_991_000, phase=0)
            vehicle.say("GLIDER_STATE", time_boot_ms=9_992_000, phase=1)
            until(lambda: found.news[1].underway.left_surface)
            before = found.news[1].underway.left_surface
            assert before == pytest.approx(now - 8.0, abs=0.01)
        with station(tmp_path, vehicle.address, start=False) as again:
            assert again.news[1].underway.left_surface == pytest.approx(before, abs=1e-5)


def test_a_slow_line_makes_no_value_stale_that_comes_as_it_can(tmp_path: Path) -> None:
    """Oracle: the vehicle speaks every 8 s by the clock of the line; then a day of silence is no interval."""
    with speaker() as vehicle, station(tmp_path, vehicle.address, start=False) as found:
        ticks = [0.0]
        clock = found.vehicles[1].clock
        real = VehicleClock.link_now
        clock.link_now = lambda: real(clock) + ticks[0]  # type: ignore[method-assign]
        page = found.hub.subscribe("a", 1, ["depth_m"])
        found.start()
        vehicle.connect()

        def told(depth: float, after: float) -> float:
            ticks[0] += after
            vehicle.say("GLIDER_STATE", time_boot_ms=1, depth=depth)
            until(lambda: found.hub.values(1).get("depth_m", (0.0, 0.0))[1] == depth)
            message = page.collect()
            assert message is not None
            return float(message["periods"].get("depth_m", 0.0))

        assert told(1.0, 0.0) == 2.0, "of the table of channels, before anything is learned"
        assert 8.0 <= max(told(2.0 + k, 8.0) for k in range(9)) < 9.0
        client = Client(found)
        latest = client.get("/vehicles/1/latest")["values"]["depth_m"]
        assert 8.0 <= latest["period_s"] < 9.0
        assert not latest["stale"]
        assert told(50.0, DAY) == 0.0, "a silence is no news"
        ticks[0] += 12.0
        assert not client.get("/vehicles/1/latest")["values"]["depth_m"]["stale"]
        ticks[0] += 12.0
        assert client.get("/vehicles/1/latest")["values"]["depth_m"]["stale"]


def test_periods_are_the_usual_intervals_and_never_below_the_table() -> None:
    channel = channel_named("depth_m")
    assert channel is not None
    periods = Periods()
    for t in (0.0, 30.0, 60.0, 4000.0, 4030.0, 4060.0, 4060.0, 4000.0, 4090.0):  # a dive, a doubled and a late one
        periods.take("GLIDER_STATE", t)
    assert periods.of(channel) == 30.0
    for k in range(20):
        periods.take("GLIDER_STATE", 5000.0 + 0.1 * k)
    assert periods.of(channel) == channel.period_s
    assert periods.of_key("no such channel") == 0.0
    replayed = Periods()
    replayed.take_samples([(key, t, 0.0) for t in (0.0, 9.0, 18.0) for key in ("depth_m", "phase", "dive")])
    assert replayed.of(channel) == 9.0
