"""The live view: what is drawn is what the vehicle says, it fits the terminal, and it does not slow the loop."""

import io
import math
from types import SimpleNamespace
from typing import Any

import pytest
from rich.console import Console

from stommel.sitl.live_view import SHARE, SHORTEST, LiveView, picture, slider, trace
from stommel.sitl.observer import DEPTHS, LONGEST_INTERVAL, Observer
from stommel.sitl.shown import BAD, Slider, clock, shown
from stommel.sitl.system import System
from tests.sitl.comparison import mission_of


@pytest.fixture(scope="module")
def flight() -> tuple[System, Observer]:
    system, observer = System(mission_of("pool_trial", 400)), Observer()
    while system.plant.time < 150.0:
        system.step()
        observer(system)
    return system, observer


def text_of(flight: tuple[System, Observer], width: int, height: int) -> list[str]:
    console = Console(file=io.StringIO(), width=width, height=height, force_terminal=True, color_system=None)
    console.print(picture(shown(*flight), height=height))
    assert isinstance(console.file, io.StringIO)
    return console.file.getvalue().splitlines()


@pytest.mark.parametrize(("width", "height"), [(80, 24), (100, 30), (140, 50)])
def test_it_fits_the_terminal(flight: tuple[System, Observer], width: int, height: int) -> None:
    lines = text_of(flight, width, height)
    assert len(lines) <= height
    assert max(map(len, lines)) <= width


def test_it_says_what_the_vehicle_says(flight: tuple[System, Observer]) -> None:
    system, _ = flight
    text = "\n".join(text_of(flight, 120, 50))
    readings = system.coordinator.perception
    assert f"{readings.value('Depth', 'depth'):.1f} m" in text
    assert f"{1e6 * readings.value('MotionStatus', 'ballast'):.0f} " in text
    assert f"{readings.value('Battery', 'voltage'):.2f} V" in text
    for word in ("mission: descent", "operational", "compass", "waypoint", "00:02:29", "start-up", "none"):
        assert word in text
    received = system.coordinator.perception.decoder.received.total()
    assert f"{received:,}" in text


def test_an_alarm_is_seen_with_its_time() -> None:
    system, observer = System(mission_of("kuroshio", 900)), Observer()
    node = system.motion
    while system.plant.time < 440.0:
        if system.plant.time == 420.0:
            system.motion = _Dead()
        system.step()
        observer(system)
    assert node is not system.motion
    now = shown(system, observer)
    (alarm,) = [alarm for alarm in now.alarms if alarm[0] == "silent motion node"]
    assert alarm[1] == "since 00:07:13"  # last heard at 419 s, silent after 3.5 s, which must hold for 10 s
    assert alarm[2] == BAD
    assert now.state_how == BAD
    assert {line.name: line.value for line in now.bus}["motion"] == "silent"
    assert ("silent motion node", True) in [(words, grave) for _, words, grave in now.events]


class _Dead:
    def step(self, *_: object) -> object:
        from stommel.onboard.execution.motion_io import AT_REST

        return [], AT_REST


def test_the_trace_is_deepest_where_the_vehicle_was() -> None:
    rows = trace([0.0, 0.0, 30.0, 30.0], columns=2, rows=2, deepest=30.0)
    # by hand: the left letter has the two top dots of its first row, the right one the two lowest of the last row and
    # the line down from the depth before
    assert rows[0][0] == "\u2809"
    assert ord(rows[1][1]) & 0xC0 == 0xC0
    assert rows[1][0] == "\u2800"
    assert trace([math.nan], 1, 1, 1.0) == ["\u2800"]


@pytest.mark.parametrize(
    ("measured", "wanted", "drawn"), [(0, 10, "●───│"), (10, 0, "│───●"), (5, 5, "──●──"), (99, 0, "│───●")]
)
def test_the_slider_shows_both_ends(measured: float, wanted: float, drawn: str) -> None:
    assert slider(Slider("oil", 0.0, 10.0, measured, wanted, "ml", ""), 5).plain == drawn


def test_times_are_read_as_people_write_them() -> None:
    assert clock(59.9) == "00:00:59"
    assert clock(86400.0 * 2 + 3 * 3600 + 4 * 60 + 5) == "2 d 03:04:05"


def test_the_trace_stays_bounded(flight: tuple[System, Observer]) -> None:
    system, _ = flight
    view, observer = system.coordinator.view, Observer()
    assert view is not None
    for t in range(0, 200_000, 5):
        told: Any = SimpleNamespace(coordinator=SimpleNamespace(view=view._replace(t=float(t))))
        observer(told)
    assert len(observer.depths) <= DEPTHS
    assert observer.interval <= LONGEST_INTERVAL


def test_it_draws_at_most_four_times_a_second_and_for_a_small_share(flight: tuple[System, Observer]) -> None:
    system, _ = flight
    now = [0.0]

    def clock_of_the_test() -> float:
        now[0] += 0.0125  # two looks a picture: each takes 12.5 ms
        return now[0]

    console = Console(file=io.StringIO(), width=100, height=40, force_terminal=True)
    with LiveView(console, clock=clock_of_the_test) as view:
        for _ in range(4000):  # 50 s
            view(system)
    assert view.pictures <= now[0] / SHORTEST + 1
    assert view.pictures * 0.0125 <= SHARE * now[0] + 0.0125
    assert view.pictures >= 0.5 * SHARE * now[0] / 0.0125
