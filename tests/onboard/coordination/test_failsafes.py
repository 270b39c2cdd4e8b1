"""Oracle of the failsafes: issue's list of what must be detected and how strongly it is answered, row by row.

Each row is raised by its cause, not one tick before its debounce is over, and is over again as its column says.
"""

from collections.abc import Callable
from math import nan
from typing import Any, NamedTuple

import pytest

from stommel.control.dive_cycle import (
    ABORT_BATTERY,
    ABORT_DEPTH,
    ABORT_LEAK,
    ABORT_PRESSURE,
    ABORT_TIME,
    BOTTOM_AHEAD,
    DESCENT,
    INFLECTION,
)
from stommel.messages.database import value_named
from stommel.onboard.coordination.failsafes import FAILSAFES, REACTION_WORDS, Cleared, Failsafe, Reaction
from stommel.onboard.coordination.safety import (
    SafetyMonitor,
    SafetyState,
    UnknownFailsafeError,
    standing_alarms,
)
from tests.onboard.coordination.situations import LIMITS, situation

Changes = Callable[[float], dict[str, Any]]
"""What differs from a sound vehicle, by the seconds since it began."""


class Case(NamedTuple):
    """How a row's cause comes about."""

    reaction: Reaction
    cause: Changes
    before: Changes = lambda _: {}
    """In the 200 seconds before, and whenever the cause pauses."""


def _down(**changes: Any) -> Changes:
    return lambda _: {"phase": DESCENT, "depth": 50.0} | changes


def _sinking(start: float = 50.0, **changes: Any) -> Changes:
    return lambda s: {"depth": start + s + 1.0, **changes}


def _flag(reaction: Reaction, **changes: Any) -> Case:
    return Case(reaction, lambda _: changes)


def _sinks_on(**changes: Any) -> Case:
    """Sinking already in the descent; then control asks for the climb, and it sinks on."""
    return Case(
        Reaction.ABORT,
        _sinking(phase=INFLECTION, **changes),
        lambda s: {"phase": DESCENT, "depth": -150.0 + s},
    )


def _no_longer_rising(reaction: Reaction, **changes: Any) -> Case:
    return Case(
        reaction,
        lambda _: {"phase": INFLECTION, "depth": 21.0, **changes},
        lambda s: {"phase": INFLECTION, "depth": 220.0 - s, **changes},
    )


R = Reaction
CASES = {
    "leak": _flag(R.NO_DIVE, alarm=ABORT_LEAK),
    "leak, sinking on": _sinks_on(alarm=ABORT_LEAK),
    "leak in both bays": _flag(R.ABORT, leak_fore=True, leak_aft=True),
    "too deep": _flag(R.REPORT, event=ABORT_DEPTH),
    "too deep, sinking on": _sinks_on(event=ABORT_DEPTH),
    "deeper than the hull rating": Case(R.DROP_WEIGHT, _down(depth=250.1), _down(depth=249.9)),
    "sinking on": Case(
        R.ABORT,
        _sinking(phase=INFLECTION),
        lambda _: {"phase": INFLECTION, "depth": 50.0},
    ),
    "bottom": _flag(R.REPORT, event=BOTTOM_AHEAD),
    "bottom, sinking on": _sinks_on(event=BOTTOM_AHEAD),
    "no rise": _no_longer_rising(R.ABORT),
    "no rise, last resort": _no_longer_rising(R.DROP_WEIGHT, coming_up=True),
    "does not sink": _flag(R.SURFACE, phase=DESCENT),
    "no surfacing": _flag(R.REPORT, event=ABORT_TIME),
    "no surfacing, still under water": Case(R.ABORT, _down(time_submerged=20001.0), _down(time_submerged=20000.0)),
    "mission expired": _flag(R.SURFACE, mission_expired=True),
    "low battery": _flag(R.NO_DIVE, alarm=ABORT_BATTERY),
    "low voltage": _flag(R.SURFACE, voltage=20.9),
    "voltage nearly gone": Case(R.ABORT, lambda _: {"voltage": 18.9}, lambda _: {"voltage": 19.1}),
    "over-current of the battery": _flag(R.SURFACE, current=20.1),
    "over-current of a motor": _flag(R.SURFACE, over_current=True),
    "pump stuck": _flag(R.ABORT, pump_stuck=True),
    "valve stuck": _flag(R.SURFACE, valve_stuck=True),
    "moving mass stuck": _flag(R.SURFACE, mass_stuck=True),
    "steering stuck": _flag(R.NO_DIVE, steering_stuck=True),
    "limit switch": _flag(R.NO_DIVE, limit_fault=True),
    "weight released": _flag(R.NO_DIVE, weight_released=True),
    "silent motion node": Case(R.ABORT, _down(motion_silent=True), _down()),
    "silent acquisition node": Case(R.ABORT, _down(acquisition_silent=True), _down()),
    "node of another version": _flag(R.NO_DIVE, motion_refused=True),
    "unknown node": _flag(R.REPORT, unknown_nodes=1),
    "silent pressure sensor": Case(R.ABORT, _down(depth=nan, pressure_silent=True), _down()),
    "pressure sensor stuck": Case(R.ABORT, _down(depth=209.0), lambda s: {"phase": DESCENT, "depth": 10.0 + s}),
    "blind, last resort": Case(
        R.DROP_WEIGHT,
        lambda _: {"phase": INFLECTION, "depth": nan, "pressure_silent": True, "coming_up": True},
        lambda s: {"phase": INFLECTION, "depth": 220.0 - s, "coming_up": True},
    ),
    "silent compass": _flag(R.SURFACE, compass_silent=True),
    "silent GPS": _flag(R.NO_DIVE, gps_silent=True),
    "silent CTD": _flag(R.REPORT, ctd_silent=True),
    "silent altimeter": _flag(R.SURFACE, altimeter_silent=True),
    "silent leak detector": _flag(R.SURFACE, leak_silent=True),
    "silent hull pressure": _flag(R.NO_DIVE, vacuum_silent=True, internal_pressure=nan),
    "silent battery gauge": _flag(R.SURFACE, battery_silent=True, voltage=nan, current=nan),
    "silent displacement sensor": _flag(R.SURFACE, ballast_silent=True),
    "silent mass position": _flag(R.SURFACE, mass_silent=True),
    "silent steering angle": _flag(R.NO_DIVE, steering_silent=True),
    "hull pressure of the mission": _flag(R.NO_DIVE, alarm=ABORT_PRESSURE),
    "vacuum loss": _flag(R.SURFACE, internal_pressure=95.1e3),
    "hull flooding": _flag(R.ABORT, internal_pressure=120.1e3),
    "software exception": _flag(R.REPORT, exceptions=1),
    "software exceptions in a row": Case(R.ABORT, lambda _: {"exceptions": 4}, lambda _: {"exceptions": 3}),
    "node restarted": Case(R.REPORT, lambda s: {"restarts": 1 + int(s)}),
    "log not written": _flag(R.REPORT, log_writable=False),
    "radio key": _flag(R.REPORT, key_alarm=True),
    "unproven safety input": _flag(R.NO_DIVE, leak_proven=False),
}
ROWS = pytest.mark.parametrize("row", FAILSAFES, ids=lambda row: row.name)


class Watch:
    """A monitor that is shown one second after the other."""

    def __init__(self, row: Failsafe, *, has_drop_weight: bool = True, standing: tuple[str, ...] = ()) -> None:
        self.row, self.case, self.t = row, CASES[row.name], 0.0
        self.monitor = SafetyMonitor(LIMITS, has_drop_weight, standing)
        self.see({})
        for second in range(200):
            self.see(self.case.before(float(second)))
        self.began = self.t

    def see(self, changes: dict[str, Any], *, tick: float = 1.0, clear: bool = False) -> SafetyState:
        self.t += tick
        return self.monitor.update(situation(self.t, **changes), clear=clear)

    def cause(self, *, clear: bool = False) -> SafetyState:
        return self.see(self.case.cause(self.t - self.began), clear=clear)

    def raise_it(self) -> SafetyState:
        for _ in range(int(self.row.debounce)):
            assert self.row.name not in self.cause().raised
        return self.cause()

    def is_active(self, state: SafetyState) -> bool:
        return any(alarm.name == self.row.name for alarm in state.active)


def test_every_row_has_a_case_and_only_those() -> None:
    assert sorted(CASES) == sorted(row.name for row in FAILSAFES)


def test_a_sound_vehicle_raises_nothing() -> None:
    monitor = SafetyMonitor(LIMITS, has_drop_weight=True)
    for t in range(100):
        state = monitor.update(situation(float(t)))
        assert (state.active, state.worst, state.unproven) == ((), Reaction.NONE, ())


@ROWS
def test_row_is_raised_when_its_debounce_is_over_and_not_a_tick_before(row: Failsafe) -> None:
    watch = Watch(row)
    state = watch.raise_it()
    assert row.name in state.raised
    alarm = next(alarm for alarm in state.active if alarm.name == row.name)
    assert (alarm.since, alarm.reaction) == (watch.t, watch.case.reaction)
    assert state.worst >= watch.case.reaction
    assert row.name not in watch.cause().raised  # once


@ROWS
def test_a_cause_that_pauses_begins_anew(row: Failsafe) -> None:
    if row.debounce == 0.0:
        pytest.skip("raised at once")
    watch = Watch(row)
    for _ in range(3):
        for _ in range(int(row.debounce)):
            assert row.name not in watch.cause().raised
        watch.see({})


@ROWS
def test_row_is_over_as_its_column_says(row: Failsafe) -> None:
    watch = Watch(row)
    watch.raise_it()
    assert watch.is_active(watch.cause(clear=True)), "not while its cause holds"
    watch.cause()
    if row.cleared_by is Cleared.SELF:
        for _ in range(int(row.clear_after)):
            assert watch.is_active(watch.see({}))
        assert row.name in watch.see({}).cleared
        return
    for _ in range(500):
        state = watch.see({}, tick=10.0)
        assert watch.is_active(state)
    kept = standing_alarms(state)
    state = watch.see({}, clear=True)
    assert watch.is_active(state) == (row.cleared_by is not Cleared.OPERATOR)
    after_restart = Watch(row, standing=kept).see({})
    assert watch.is_active(after_restart) == (row.cleared_by is not Cleared.RESTART)


@ROWS
def test_reason_is_a_word_of_the_can_database(row: Failsafe) -> None:
    assert value_named("Abort", "reason", row.reason) > 0
    assert all((row.words, row.what_to_do, row.reaction in REACTION_WORDS))


def test_control_is_not_decided_again() -> None:
    rows = {row.detected_by for row in FAILSAFES if row.detected_by.startswith("control: ")}
    assert rows == {
        "control: abort: leak",
        "control: abort: too deep",
        "control: bottom ahead",
        "control: abort: dive too long",
        "control: abort: battery low",
        "control: abort: pressure inside the hull",
    }


@pytest.mark.parametrize("name", ["deeper than the hull rating", "no rise, last resort", "blind, last resort"])
def test_without_a_drop_weight_the_last_resort_is_the_last_reaction(name: str) -> None:
    row = next(row for row in FAILSAFES if row.name == name)
    assert Watch(row).raise_it().worst == Reaction.DROP_WEIGHT
    assert Watch(row, has_drop_weight=False).raise_it().worst == Reaction.ABORT


def test_a_clock_that_jumps_raises_nothing() -> None:
    row = next(row for row in FAILSAFES if row.name == "silent compass")
    watch = Watch(row)
    watch.cause()
    assert not watch.is_active(watch.see(CASES[row.name].cause(0.0), tick=1e6))
    assert not watch.is_active(watch.see(CASES[row.name].cause(0.0), tick=-2e6))


def test_two_alarms_give_the_stronger_reaction_and_its_reason() -> None:
    monitor = SafetyMonitor(LIMITS, has_drop_weight=True)
    for t in range(10):
        state = monitor.update(situation(float(t), steering_stuck=True, pump_stuck=True, ctd_silent=True))
    assert (state.worst, state.reason) == (Reaction.ABORT, "StuckActuator")


def test_a_normal_dive_raises_nothing() -> None:
    """Down to 100 m at 0.2 m/s, 60 s of sinking on while the pump runs, up again, with the depth in millimetres."""
    monitor = SafetyMonitor(LIMITS, has_drop_weight=True)
    monitor.update(situation(-1.0))
    depth = 0.0
    for t in range(1200):
        phase = DESCENT if t < 500 else INFLECTION if t < 560 else 3
        speed = 0.2 if t < 500 else 0.2 - 0.2 * (t - 500) / 55.0 if t < 600 else -0.18
        depth += speed
        state = monitor.update(
            situation(float(t), phase=phase, depth=round(max(depth, 0.0), 3), time_submerged=float(t))
        )
        assert state.active == (), (t, state.active)


def test_silent_pressure_sensor_at_the_surface_is_unproven_and_no_abort() -> None:
    monitor = SafetyMonitor(LIMITS, has_drop_weight=True)
    for t in range(100):
        state = monitor.update(situation(float(t), depth=nan, pressure_silent=True, fixed=True))
    assert (state.worst, state.unproven) == (Reaction.NO_DIVE, ("pressure sensor",))


def test_pressure_sensor_that_falls_silent_as_the_descent_begins_is_blind() -> None:
    monitor = SafetyMonitor(LIMITS, has_drop_weight=True)
    for t in range(12):
        state = monitor.update(situation(float(t), phase=DESCENT, depth=nan, pressure_silent=True))
    assert state.worst == Reaction.ABORT


def test_unknown_standing_alarm_is_refused_by_name() -> None:
    with pytest.raises(UnknownFailsafeError, match=r"^tired crew: is no failsafe; known are leak, "):
        SafetyMonitor(LIMITS, has_drop_weight=True, standing=("tired crew",))
