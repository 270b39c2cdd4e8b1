"""What goes by the phase of the dive: the CTD's interval, and a compass that rests. Oracle: the schedule itself.

The vehicle still flies its dive; that it flies the same one with the schedule left out is the affair of the equality
tests.
"""

from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from typing import TypeVar

import numpy as np
import pytest

from stommel.control.dive_cycle import ASCENT, DESCENT, PHASES
from stommel.instruments.tcm.driver import CompassSettings
from stommel.onboard.coordination.health import Condition
from stommel.onboard.coordination.power import PowerSchedule
from stommel.onboard.coordination.settings import CoordinatorSettings
from stommel.sitl import system as loop
from stommel.sitl.system import System
from tests.sitl.comparison import mission_of

SECONDS = 1500
CTD_FIELDS = ("pressure", "temperature", "conductivity")
T = TypeVar("T")
Change = Callable[[CoordinatorSettings], CoordinatorSettings]


def by_phase(usual: T, **others: T) -> tuple[T, ...]:
    return tuple(others.get(phase, usual) for phase in PHASES)


@pytest.fixture
def system(monkeypatch: pytest.MonkeyPatch) -> Callable[[Change], System]:
    usual = loop.coordinator_settings

    def with_settings(change: Change) -> System:
        monkeypatch.setattr(loop, "coordinator_settings", lambda *a: change(usual(*a)))
        return System(mission_of("kuroshio", SECONDS))

    return with_settings


def test_the_ctd_samples_at_the_interval_of_the_phase(system: Callable[[Change], System]) -> None:
    flying = system(lambda s: replace(s, schedule=PowerSchedule(ctd=by_phase(5.0, descent=20.0, ascent=2.0))))
    samples: dict[int, list[float]] = {DESCENT: [], ASCENT: []}
    water: dict[int, list[tuple[object, ...]]] = {DESCENT: [], ASCENT: []}
    assert 2.0 < flying.mission.scenario.sampling.every_s < 20.0
    since, before = 0.0, -1
    silent: set[str] = set()
    counted: Counter[str] = flying.coordinator.perception.decoder.received
    while flying.running:
        had = counted["CtdSample"]
        flying.step()
        view, phase, t = flying.coordinator.view, flying.coordinator.pilot.phase, flying.plant.time
        assert view is not None
        if phase != before:
            since, before = t, phase
        if counted["CtdSample"] > had and phase in samples and t - since > 30.0:
            samples[phase].append(t)
            water[phase].append(tuple(flying.coordinator.perception.value("CtdSample", name) for name in CTD_FIELDS))
        silent |= {source.name for source in view.health.sources if source.condition is Condition.SILENT}
        silent |= {alarm.name for alarm in view.safety.active if alarm.name == "silent CTD"}
        assert not flying.coordinator.perception.watch.reports(3, "CtdSilent")
    assert silent == set()
    assert set(np.diff(samples[DESCENT])) == {20.0}
    assert set(np.diff(samples[ASCENT])) == {2.0}
    for found in water.values():
        assert len(set(found)) == len(found) > 10, "a sample tells the water of the one before again"


def test_a_compass_that_rests_measures_just_before_each_decision(system: Callable[[Change], System]) -> None:
    schedule = PowerSchedule(decide=by_phase(1.0, descent=10.0), compass_rests=by_phase(False, descent=True))
    flying = system(lambda s: replace(s, schedule=schedule, compass=CompassSettings(polled=True)))
    seen, ages, readings, decisions = flying.coordinator.perception, [], [], []
    alarms: set[str] = set()
    phase, decided_at = -1, -1.0
    since = 0.0
    while flying.running:
        phase_before, at_before = phase, seen.attitude.at
        t = flying.plant.time
        flying.step()
        view, phase = flying.coordinator.view, flying.coordinator.pilot.phase
        assert view is not None
        alarms |= {alarm.name for alarm in view.safety.active}
        if phase != phase_before:
            since = t
        if phase == phase_before == DESCENT and t - since > 20.0:
            if seen.attitude.at > at_before:
                readings.append(t)
            if view.t > decided_at:
                decisions.append(t)
                ages.append(t - seen.attitude.at)
        decided_at = view.t
        assert not view.situation.compass_silent or t < 30.0
    assert len(decisions) > 10
    assert set(np.diff(decisions)) == {10.0}
    assert readings == decisions
    assert set(ages) == {0.0}
    assert "silent compass" not in alarms


def test_a_slow_compass_is_not_called_silent(system: Callable[[Change], System]) -> None:
    flying = system(lambda s: replace(s, compass=CompassSettings(interval=10.0, polled=False, silence=25.0)))
    readings: list[float] = []
    while flying.plant.time < 400.0:
        before = flying.coordinator.perception.attitude.at
        flying.step()
        view = flying.coordinator.view
        assert view is not None
        if flying.coordinator.perception.attitude.at > before:
            readings.append(view.t)
        assert not view.situation.compass_silent or len(readings) < 1
    assert set(np.diff(readings)) == {10.0}


def test_a_dead_compass_is_found_although_it_rests(system: Callable[[Change], System]) -> None:
    """Oracle: its failsafe, after 60 s of silence, which begins when two decisions have had no reading."""
    schedule = PowerSchedule(decide=by_phase(1.0, descent=10.0), compass_rests=by_phase(False, descent=True))
    flying = system(lambda s: replace(s, schedule=schedule, compass=CompassSettings(polled=True)))
    died = None
    while flying.running:
        if died is None and flying.coordinator.pilot.phase == DESCENT and flying.plant.depth > 20.0:
            died = flying.plant.time
            flying.ports.compass.exchange = lambda *_: b""  # type: ignore[method-assign]
        flying.step()
        view = flying.coordinator.view
        assert view is not None
        if died is not None and any(alarm.name == "silent compass" for alarm in view.safety.active):
            assert 60.0 < flying.plant.time - died < 100.0
            return
    raise AssertionError("it was never found")
