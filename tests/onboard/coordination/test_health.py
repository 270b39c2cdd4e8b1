"""Oracle of health: "one lost frame is a count, not an alarm", and the words of its conditions."""

from math import isnan

import pytest

from stommel.onboard.coordination.health import (
    CONDITION_WORDS,
    Condition,
    HealthMonitor,
    Source,
    SourceHealth,
    UnknownSourceError,
)

NODE = Source("node", 1.0, 5)


def listening() -> HealthMonitor:
    monitor = HealthMonitor((NODE, Source("GPS", 1.0, 10)))
    monitor.switch("node", True, 0.0)
    return monitor


def of(monitor: HealthMonitor, t: float) -> SourceHealth:
    return monitor.snapshot(t).sources[0]


def test_one_lost_frame_is_a_count_and_no_silence() -> None:
    monitor = listening()
    monitor.hear("node", 1.0)
    assert of(monitor, 2.0).condition is Condition.WELL
    assert (of(monitor, 2.9).condition, monitor.silent("node", 2.9)) == (Condition.LATE, False)
    monitor.hear("node", 3.0, lost=1)
    now = of(monitor, 3.2)
    assert (now.condition, now.heard, now.lost, now.silences) == (Condition.WELL, 2, 1, 0)
    assert now.age == pytest.approx(0.2)


def test_silent_after_so_many_missed_periods_and_counted_once() -> None:
    monitor = listening()
    monitor.hear("node", 1.0)
    assert not monitor.silent("node", 6.0)
    assert [monitor.silent("node", t) for t in (6.1, 7.0, 8.0)] == [True, True, True]
    assert (of(monitor, 9.0).condition, of(monitor, 9.0).silences) == (Condition.SILENT, 1)
    monitor.hear("node", 9.0)
    assert of(monitor, 9.5).condition is Condition.WELL
    assert (monitor.silent("node", 15.0), of(monitor, 15.0).silences) == (True, 2)


def test_source_that_is_off_is_not_silent_and_its_age_counts_from_switching_on() -> None:
    monitor = listening()
    assert (monitor.silent("GPS", 1e6), monitor.snapshot(1e6).sources[1].condition) == (False, Condition.OFF)
    monitor.switch("GPS", True, 100.0)
    waiting = monitor.snapshot(105.0).sources[1]
    assert waiting.condition is Condition.WAITING
    assert isnan(waiting.age)
    assert monitor.silent("GPS", 110.1)
    monitor.hear("GPS", 111.0)
    monitor.switch("GPS", False, 112.0)
    monitor.switch("GPS", True, 5000.0)
    assert not monitor.silent("GPS", 5005.0)
    assert monitor.snapshot(5005.0).sources[1].condition is Condition.WAITING


def test_refused_node_is_named_so_although_it_speaks() -> None:
    monitor = listening()
    monitor.hear("node", 1.0)
    monitor.refuse("node", True)
    monitor.restarted("node")
    monitor.reject("node")
    now = of(monitor, 1.0)
    assert (now.condition, now.restarts, now.rejected) == (Condition.REFUSED, 1, 1)
    monitor.refuse("node", False)
    assert of(monitor, 1.0).condition is Condition.WELL


def test_snapshot_keeps_still_and_names_strangers_alarms_and_what_is_unproven() -> None:
    monitor = listening()
    monitor.meet_stranger(0x123)
    monitor.meet_stranger(0x044)
    monitor.meet_stranger(0x123)
    before = monitor.snapshot(1.0, ("leak",), ("GPS",))
    monitor.hear("node", 2.0)
    assert (before.unknown, before.alarms, before.unproven) == ((0x044, 0x123), ("leak",), ("GPS",))
    assert before.sources[0].heard == 0
    assert monitor.unknown == 2


def test_unknown_source_is_refused_by_name() -> None:
    with pytest.raises(UnknownSourceError, match=r"^sonar: is no source; known are node, GPS$"):
        listening().hear("sonar", 0.0)


def test_every_condition_has_words() -> None:
    assert set(CONDITION_WORDS) == set(Condition)
