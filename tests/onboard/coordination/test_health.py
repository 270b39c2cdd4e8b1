"""Oracle of health: "one lost frame is a count, not an alarm", and the words of its conditions."""

from math import inf, isnan

import pytest

from stommel.onboard.coordination.health import (
    CONDITION_WORDS,
    Condition,
    HealthMonitor,
    SourceHealth,
    Told,
    UnknownSourceError,
)

NOTHING = Told(period=1.0, heard_at=-inf, heard=0, lost=0, rejected=0, silent=False)


def listening() -> HealthMonitor:
    monitor = HealthMonitor(("node", "GPS"))
    monitor.switch("node", True, 0.0)
    return monitor


def node(monitor: HealthMonitor, t: float, heard_at: float, *, silent: bool = False, **counts: int) -> SourceHealth:
    told = NOTHING._replace(heard_at=heard_at, silent=silent, **counts)
    return monitor.snapshot(t, (told, NOTHING)).sources[0]


def gps(monitor: HealthMonitor, t: float, heard_at: float, *, silent: bool = False) -> SourceHealth:
    return monitor.snapshot(t, (NOTHING, NOTHING._replace(heard_at=heard_at, silent=silent))).sources[1]


def test_one_lost_frame_is_a_count_and_no_silence() -> None:
    monitor = listening()
    assert node(monitor, 2.0, 1.0).condition is Condition.WELL
    assert node(monitor, 2.9, 1.0).condition is Condition.LATE
    now = node(monitor, 3.2, 3.0, heard=2, lost=1)
    assert (now.condition, now.heard, now.lost, now.silences) == (Condition.WELL, 2, 1, 0)
    assert now.age == pytest.approx(0.2)


def test_a_silence_is_counted_once() -> None:
    monitor = listening()
    assert node(monitor, 6.0, 1.0).silences == 0
    for t in (6.1, 7.0, 8.0):
        now = node(monitor, t, 1.0, silent=True)
        assert (now.condition, now.silences) == (Condition.SILENT, 1)
    assert node(monitor, 9.5, 9.0).condition is Condition.WELL
    assert node(monitor, 15.0, 9.0, silent=True).silences == 2


def test_source_that_is_off_is_not_silent_and_waits_from_switching_on() -> None:
    monitor = listening()
    off = gps(monitor, 1e6, -inf, silent=True)
    assert (off.condition, off.silences, monitor.since("GPS")) == (Condition.OFF, 0, inf)
    monitor.switch("GPS", True, 100.0)
    monitor.switch("GPS", True, 101.0)
    assert monitor.since("GPS") == 100.0
    waiting = gps(monitor, 105.0, -inf)
    assert waiting.condition is Condition.WAITING
    assert isnan(waiting.age)
    assert gps(monitor, 110.1, -inf, silent=True).condition is Condition.SILENT
    assert gps(monitor, 111.0, 111.0).condition is Condition.WELL
    monitor.switch("GPS", False, 112.0)
    monitor.switch("GPS", True, 5000.0)
    assert gps(monitor, 5005.0, 111.0).condition is Condition.WAITING


def test_refused_node_is_named_so_although_it_speaks() -> None:
    monitor = listening()
    told = NOTHING._replace(heard_at=1.0, refused=True, restarts=1, rejected=1)
    now = monitor.snapshot(1.0, (told, NOTHING)).sources[0]
    assert (now.condition, now.restarts, now.rejected) == (Condition.REFUSED, 1, 1)
    assert node(monitor, 1.0, 1.0).condition is Condition.WELL


def test_snapshot_keeps_still_and_names_strangers_in_order() -> None:
    monitor, strangers = listening(), {0x123: 1, 0x044: 2}
    before = monitor.snapshot(1.0, (NOTHING, NOTHING), strangers.keys())
    strangers[0x100] = 1
    assert before.unknown == (0x044, 0x123)
    assert monitor.snapshot(2.0, (NOTHING, NOTHING), strangers.keys()).unknown == (0x044, 0x100, 0x123)


def test_unknown_source_is_refused_by_name() -> None:
    with pytest.raises(UnknownSourceError, match=r"^sonar: is no source; known are node, GPS$"):
        listening().switch("sonar", True, 0.0)


def test_every_condition_has_words() -> None:
    assert set(CONDITION_WORDS) == set(Condition)
