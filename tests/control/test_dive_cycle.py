"""Oracle of the dive cycle: its transitions, one by one, as the guide has them."""

from math import inf, nan

import pytest

from stommel.control.dive_cycle import (
    ABORT_BATTERY,
    ABORT_DEPTH,
    ABORT_LEAK,
    ABORT_TIME,
    ASCENT,
    BOTTOM_AHEAD,
    DESCENT,
    DRIFT,
    INFLECTION,
    MISSION_COMPLETE,
    NOTHING,
    RECOVERY,
    SURFACE,
    TARGET_REACHED,
    DivePlan,
    DiveState,
    Situation,
    next_dive_state,
    wanted_ballast,
    wanted_pitch,
)

PLAN = DivePlan(
    depth=100.0,
    turns_early=0.0,
    theta=0.6,
    V_b_dive=-1e-4,
    V_b_climb=2e-4,
    V_b_surface=3e-4,
    V_b_drift=1e-5,
    r_px_drift=0.25,
    r_px_surface=nan,
    surface_time=300.0,
    longest_surface_time=1800.0,
    drift_time=0.0,
    surfacing_interval=inf,
    least_altitude=10.0,
    shallow_depth=1.0,
    dives_per_surfacing=1.0,
    turn_depth=10.0,
    abort_depth=110.0,
    abort_time=43200.0,
)
NOW = Situation(depth=50.0, altitude=inf, ballast=-1e-4, wanted=True, fixed=True, alarm=NOTHING)


def state(phase: int, since: float = 0.0, **changes: float) -> DiveState:
    return DiveState(float(phase), since, 0.0, 1.0, 1.0, float(NOTHING))._replace(**changes)


T = 1000.0
STEPS = [
    # phase, plan, readings, then, why
    (SURFACE, {}, {}, DESCENT, NOTHING),
    (SURFACE, {"surface_time": 1001.0}, {}, SURFACE, NOTHING),
    (SURFACE, {}, {"fixed": False}, SURFACE, NOTHING),
    (SURFACE, {"longest_surface_time": 1000.0}, {"fixed": False}, DESCENT, NOTHING),
    (SURFACE, {}, {"wanted": False}, RECOVERY, MISSION_COMPLETE),
    (SURFACE, {}, {"alarm": ABORT_LEAK}, RECOVERY, ABORT_LEAK),
    (SURFACE, {}, {"alarm": ABORT_LEAK, "wanted": False}, RECOVERY, ABORT_LEAK),
    (DESCENT, {}, {}, DESCENT, NOTHING),
    (DESCENT, {}, {"depth": 100.0}, INFLECTION, TARGET_REACHED),
    (DESCENT, {"drift_time": 60.0}, {"depth": 100.0}, DRIFT, TARGET_REACHED),
    (DESCENT, {}, {"depth": 110.5}, INFLECTION, ABORT_DEPTH),
    (DESCENT, {}, {"altitude": 10.0}, INFLECTION, BOTTOM_AHEAD),
    (DESCENT, {"abort_time": 999.0}, {}, INFLECTION, ABORT_TIME),
    (DESCENT, {}, {"alarm": ABORT_BATTERY}, INFLECTION, ABORT_BATTERY),
    (DRIFT, {"drift_time": 1001.0}, {"depth": 100.0}, DRIFT, NOTHING),
    (DRIFT, {"drift_time": 1000.0}, {"depth": 100.0}, INFLECTION, TARGET_REACHED),
    (DRIFT, {"drift_time": 9000.0}, {"depth": 111.0}, INFLECTION, ABORT_DEPTH),
    (DRIFT, {"drift_time": 9000.0}, {"alarm": ABORT_LEAK}, INFLECTION, ABORT_LEAK),
    (INFLECTION, {}, {"ballast": -1e-9}, INFLECTION, NOTHING),
    (INFLECTION, {}, {"ballast": 0.0}, ASCENT, NOTHING),
    (ASCENT, {}, {"depth": 10.0}, ASCENT, NOTHING),
    (ASCENT, {}, {"depth": 1.0}, SURFACE, NOTHING),
    (ASCENT, {"dives_per_surfacing": 2.0}, {"depth": 10.0}, DESCENT, NOTHING),
    (ASCENT, {"dives_per_surfacing": 2.0}, {"depth": 10.0, "alarm": ABORT_LEAK}, ASCENT, NOTHING),
    (ASCENT, {"dives_per_surfacing": 2.0}, {"depth": 10.0, "wanted": False}, ASCENT, NOTHING),
    (ASCENT, {"dives_per_surfacing": 2.0, "surfacing_interval": 999.0}, {"depth": 10.0}, ASCENT, NOTHING),
    (RECOVERY, {}, {"depth": 0.0}, RECOVERY, NOTHING),
]


@pytest.mark.parametrize(("phase", "plan", "readings", "then", "why"), STEPS)
def test_transition(phase: int, plan: dict[str, float], readings: dict[str, float], then: int, why: int) -> None:
    found = next_dive_state(state(phase), PLAN._replace(**plan), T, NOW._replace(**readings))
    assert int(found.phase) == then
    assert int(found.event) == why
    assert found.since == (T if then != phase else 0.0)


def test_a_dive_that_took_too_long_surfaces() -> None:
    plan = PLAN._replace(dives_per_surfacing=5.0)
    before = state(ASCENT, event=float(ABORT_TIME))
    assert int(next_dive_state(before, plan, T, NOW._replace(depth=5.0)).phase) == ASCENT
    assert int(next_dive_state(before, plan, T, NOW._replace(depth=0.9)).phase) == SURFACE


def test_counts_of_dives() -> None:
    plan = PLAN._replace(dives_per_surfacing=3.0)
    again = next_dive_state(state(ASCENT, dives=4.0, dives_here=2.0), plan, T, NOW._replace(depth=5.0))
    assert (again.dives, again.dives_here, again.submerged_since) == (5.0, 3.0, 0.0)
    fresh = next_dive_state(state(SURFACE, dives=5.0, dives_here=3.0), plan, T, NOW)
    assert (fresh.dives, fresh.dives_here, fresh.submerged_since) == (6.0, 1.0, T)


def test_what_each_phase_asks_for() -> None:
    asked = {phase: (wanted_ballast(state(phase), PLAN), wanted_pitch(state(phase), PLAN)) for phase in range(6)}
    assert asked == {
        SURFACE: (3e-4, 0.6),
        DESCENT: (-1e-4, -0.6),
        INFLECTION: (2e-4, 0.6),
        ASCENT: (2e-4, 0.6),
        RECOVERY: (3e-4, 0.6),
        DRIFT: (1e-5, 0.0),
    }


@pytest.mark.parametrize(("depth", "phase"), [(10.001, ASCENT), (10.0, DESCENT), (9.0, DESCENT)])
def test_upper_turn_is_at_its_depth_and_no_deeper(depth: float, phase: int) -> None:
    """Of dives that do not surface: by `turn_depth`, to the millimetre."""
    plan = PLAN._replace(dives_per_surfacing=3.0)
    found = next_dive_state(state(ASCENT), plan, T, NOW._replace(depth=depth, ballast=2e-4))
    assert int(found.phase) == phase


@pytest.mark.parametrize("early", [0.0, 4.0])
def test_lower_turn_is_above_the_depth_by_the_way_of_the_turn(early: float) -> None:
    plan = PLAN._replace(turns_early=early)
    for depth, phase in ((100.0 - early - 1e-3, DESCENT), (100.0 - early, INFLECTION)):
        assert int(next_dive_state(state(DESCENT), plan, T, NOW._replace(depth=depth)).phase) == phase
