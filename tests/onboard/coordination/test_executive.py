"""Oracle of the executive: its transitions, one by one, as the guide has them; and what must hold whatever happens."""

from math import inf, isfinite, nan
from typing import Any, NamedTuple

import pytest
from hypothesis import given
from hypothesis import strategies as st

from stommel.control.commands import ABORTED, GOING_ON, Commands
from stommel.control.decision import advance_cycle
from stommel.control.dive_cycle import (
    ABORT_LEAK,
    ASCENT,
    DESCENT,
    DRIFT,
    INFLECTION,
    PHASES,
    RECOVERY,
    SURFACE,
    DivePlan,
)
from stommel.control.memory import new_memory
from stommel.onboard.coordination.executive import (
    CHECK_TIME,
    STATE_WORDS,
    TRANSITIONS,
    Executive,
    ExecutiveState,
    State,
)
from stommel.onboard.coordination.executive_commands import CALLING_AFTER, CALLS_FOR, commands, instruct
from stommel.onboard.coordination.failsafes import Reaction
from stommel.onboard.coordination.safety import ActiveAlarm, SafetyMonitor, SafetyState
from stommel.onboard.coordination.situation import NO_REQUESTS, OperatorRequests
from tests.onboard.coordination.situations import ACTUATORS, LIMITS, situation

CALM = SafetyState((), Reaction.NONE, (), (), "None", (), False)
DOWN = CALM._replace(submerged=True)
DEEP = {"depth": 50.0, "phase": DESCENT}


def alarmed(reaction: Reaction, reason: str = "Leak", **changes: Any) -> SafetyState:
    """Safety with one active alarm."""
    return CALM._replace(active=(ActiveAlarm("made up", 0.0, reaction),), worst=reaction, reason=reason, **changes)


class Step(NamedTuple):
    """What one decision is shown."""

    safety: SafetyState = CALM
    requests: OperatorRequests = NO_REQUESTS
    changes: dict[str, Any] = {}  # noqa: RUF012 - never changed
    after: float = 1.0
    """Seconds since the decision before."""


WAIT = Step(CALM._replace(unproven=("pump",)))
"""Keeps a vehicle in start-up."""
DIVE = Step(DOWN, changes=DEEP)
TO_HOLD = (WAIT, Step())
TO_COMMUNICATE = (*TO_HOLD, Step(requests=OperatorRequests(start=True)))
TO_MISSION = (*TO_COMMUNICATE, DIVE)
WAYS = {
    State.START_UP: (WAIT,),
    State.HOLD: TO_HOLD,
    State.COMMUNICATE: TO_COMMUNICATE,
    State.MISSION: TO_MISSION,
    State.ASCEND: (WAIT, Step(DOWN, changes=DEEP)),
    State.RECOVER: (*TO_COMMUNICATE, Step(changes={"phase": RECOVERY})),
    State.ABORT: (WAIT, Step(alarmed(Reaction.ABORT))),
}
"""How a vehicle comes to each state."""


def led(state: State) -> tuple[Executive, float]:
    """An executive in a state, and the time there."""
    executive, t = Executive(), 0.0
    for step in WAYS[state]:
        told, t = shown(executive, t, step)
    assert told.state is state
    return executive, t


def shown(executive: Executive, t: float, step: Step) -> tuple[ExecutiveState, float]:
    """Show a step to an executive."""
    t += step.after
    return executive.update(situation(t, **step.changes), step.safety, step.requests), t


LAST = Step(alarmed(Reaction.ABORT))
CASES = {
    (State.START_UP, State.ABORT): LAST,
    (State.START_UP, State.ASCEND): Step(DOWN, changes={"depth": 50.0}),
    (State.START_UP, State.HOLD): Step(),
    (State.HOLD, State.ABORT): LAST,
    (State.HOLD, State.ASCEND): Step(DOWN, changes={"depth": 5.0}),
    (State.HOLD, State.START_UP): Step(requests=OperatorRequests(check=True)),
    (State.HOLD, State.RECOVER): Step(changes={"phase": RECOVERY}),
    (State.HOLD, State.COMMUNICATE): Step(requests=OperatorRequests(start=True)),
    (State.COMMUNICATE, State.ABORT): LAST,
    (State.COMMUNICATE, State.RECOVER): Step(changes={"phase": RECOVERY}),
    (State.COMMUNICATE, State.HOLD): Step(alarmed(Reaction.NO_DIVE)),
    (State.COMMUNICATE, State.MISSION): DIVE,
    (State.MISSION, State.ABORT): Step(alarmed(Reaction.ABORT, submerged=True), changes=DEEP),
    (State.MISSION, State.ASCEND): Step(alarmed(Reaction.SURFACE, submerged=True), changes=DEEP),
    (State.MISSION, State.RECOVER): Step(changes={"phase": RECOVERY}),
    (State.MISSION, State.COMMUNICATE): Step(changes={"phase": SURFACE}),
    (State.ASCEND, State.ABORT): Step(alarmed(Reaction.ABORT, submerged=True), changes=DEEP),
    (State.ASCEND, State.START_UP): Step(CALM, changes={"depth": 0.5, "phase": ASCENT}),
    (State.RECOVER, State.ABORT): LAST,
    (State.RECOVER, State.ASCEND): Step(DOWN, changes={"depth": 5.0, "phase": RECOVERY}),
    (State.RECOVER, State.START_UP): Step(changes={"phase": RECOVERY}, requests=OperatorRequests(start=True)),
    (State.ABORT, State.START_UP): Step(requests=OperatorRequests(clear=True)),
}


@pytest.mark.parametrize("ends", CASES, ids=lambda ends: f"{ends[0].value} to {ends[1].value}")
def test_transition(ends: tuple[State, State]) -> None:
    executive, t = led(ends[0])
    told, t = shown(executive, t, CASES[ends])
    assert (told.state, told.since) == (ends[1], t)
    assert told.because


def test_every_transition_has_a_case_and_only_those() -> None:
    assert set(CASES) == {(row.state, row.next) for row in TRANSITIONS}
    assert set(STATE_WORDS) == set(State) == set(WAYS)


@pytest.mark.parametrize("state", State)
def test_state_stays_where_nothing_happens(state: State) -> None:
    executive, t = led(state)
    step = WAYS[state][-1]._replace(requests=NO_REQUESTS)
    for _ in range(5):
        told, t = shown(executive, t, step)
        assert told.state is state


@pytest.mark.parametrize(
    ("state", "step", "then"),
    [
        (State.START_UP, WAIT._replace(after=CHECK_TIME), State.HOLD),
        (State.START_UP, Step(CALM._replace(unproven=("mission",))), State.HOLD),
        (State.START_UP, Step(requests=OperatorRequests(abort=True)), State.ABORT),
        (State.HOLD, Step(alarmed(Reaction.NO_DIVE), OperatorRequests(start=True)), State.HOLD),
        (State.HOLD, Step(CALM._replace(unproven=("GPS",)), OperatorRequests(start=True)), State.HOLD),
        (State.HOLD, Step(requests=OperatorRequests(start=True), changes={"mission_present": False}), State.HOLD),
        (State.COMMUNICATE, Step(requests=OperatorRequests(hold=True)), State.HOLD),
        (State.MISSION, Step(alarmed(Reaction.NO_DIVE, submerged=True), changes=DEEP), State.MISSION),
        (State.MISSION, Step(DOWN, OperatorRequests(hold=True), DEEP), State.MISSION),
        (State.MISSION, Step(DOWN, OperatorRequests(surface=True), DEEP), State.ASCEND),
        (State.MISSION, Step(DOWN, changes={**DEEP, "mission_present": False}), State.ASCEND),
        (State.ABORT, Step(alarmed(Reaction.ABORT), OperatorRequests(clear=True)), State.ABORT),
        (State.ABORT, Step(CALM, OperatorRequests(start=True)), State.ABORT),
    ],
)
def test_other_ways_to_a_state(state: State, step: Step, then: State) -> None:
    executive, t = led(state)
    assert shown(executive, t, step)[0].state is then


def test_blind_vehicle_is_not_at_the_surface_until_it_has_a_position() -> None:
    executive, t = led(State.ASCEND)
    told, t = shown(executive, t, Step(changes={"depth": nan, "pressure_silent": True}))
    assert (told.state, told.surfaced) == (State.ASCEND, False)
    told, t = shown(executive, t, Step(changes={"depth": nan, "pressure_silent": True, "fixed": True}))
    assert told.state is State.START_UP


def test_mission_is_shown_as_control_flies_it() -> None:
    executive, t = led(State.MISSION)
    for phase in (DESCENT, DRIFT, INFLECTION, ASCENT):
        told, t = shown(executive, t, Step(DOWN, changes={"depth": 50.0, "phase": phase}))
        assert told.words == f"mission: {PHASES[phase]}"


def test_abort_names_its_reason_and_asks_for_the_weight_once_for_all() -> None:
    executive, t = led(State.MISSION)
    told, t = shown(executive, t, Step(alarmed(Reaction.ABORT, "SilentNode", submerged=True), changes=DEEP))
    assert (told.reason, told.because, told.drop_weight, told.started) == ("SilentNode", "made up", False, False)
    told, t = shown(executive, t, Step(alarmed(Reaction.DROP_WEIGHT, submerged=True), changes=DEEP))
    told, t = shown(executive, t, Step(alarmed(Reaction.ABORT, submerged=True), changes=DEEP))
    assert told.drop_weight
    told, t = shown(executive, t, Step(requests=OperatorRequests(clear=True)))
    assert (told.state, told.drop_weight, told.reason) == (State.START_UP, False, "None")


def test_self_test_is_asked_for_at_the_surface_only() -> None:
    executive = Executive()
    assert executive.update(situation(0.0), WAIT.safety).self_test
    assert not executive.update(situation(1.0), CALM._replace(unproven=("GPS",))).self_test
    blind = situation(2.0, depth=nan, pressure_silent=True)
    assert not executive.update(blind, WAIT.safety).self_test


CONTROL = Commands(0.26, -1e-4, 0.3, 1e-3, 3, True, False, GOING_ON)


def commanded(state: State, control: Commands | None = CONTROL, **changes: Any) -> Commands:
    executive, t = led(state)
    step = WAYS[state][-1]._replace(requests=NO_REQUESTS)
    told, _ = shown(executive, t, step)
    return commands(told._replace(**changes), control, ACTUATORS)


@pytest.mark.parametrize("state", [State.COMMUNICATE, State.MISSION, State.RECOVER])
def test_control_is_obeyed_within_the_limits(state: State) -> None:
    assert commanded(state) == CONTROL
    wild = CONTROL._replace(r_px=0.5, V_b=-1.0, steering=-4.0)
    assert commanded(state, wild) == CONTROL._replace(r_px=0.30, V_b=-2.5e-4, steering=-1.0)


@pytest.mark.parametrize("state", State)
@pytest.mark.parametrize("control", [None, CONTROL._replace(r_px=nan), CONTROL._replace(V_b=-inf)])
def test_without_control_every_state_asks_for_the_greatest_ballast(state: State, control: Commands | None) -> None:
    wanted = commanded(state, control, surfaced=False, surfaced_since=inf)
    assert (wanted.V_b, wanted.r_px, wanted.steering) == (2.5e-4, 0.21, 0.0)


def test_hold_raises_the_antenna_and_calls() -> None:
    wanted = commanded(State.HOLD)
    assert (wanted.V_b, wanted.r_px, wanted.radio, wanted.sampling) == (2.5e-4, 0.29, True, False)


def test_aborted_vehicle_calls_at_the_surface_and_then_counts_as_ended() -> None:
    antenna = ACTUATORS._replace(r_px_calling=0.28)
    executive, t = led(State.ABORT)
    told, t = shown(executive, t, Step(alarmed(Reaction.ABORT, submerged=True), changes=DEEP))
    assert not commands(told, None, antenna).radio
    came_up = t + 1.0
    for _ in range(int(CALLS_FOR) + 1):
        told, t = shown(executive, t, LAST)
        wanted = commands(told, None, antenna)
        assert (wanted.radio, wanted.V_b) == (True, 2.5e-4)
        assert wanted.r_px == (0.28 if t - came_up >= CALLING_AFTER else 0.21)
        assert wanted.ended == (ABORTED if t - came_up >= CALLS_FOR else GOING_ON)


FLAGS = (
    "motion_silent", "acquisition_silent", "compass_silent", "pressure_silent", "leak_fore", "leak_aft", "pump_stuck",
    "valve_stuck", "mission_expired", "over_current", "leak_proven", "mission_present", "log_writable", "fixed",
    "battery_silent", "coming_up",
)  # fmt: skip
STEPS = st.lists(
    st.tuples(
        st.fixed_dictionaries(
            {
                "phase": st.integers(0, 5),
                "depth": st.one_of(st.just(nan), st.floats(-1.0, 300.0)),
                "voltage": st.sampled_from([25.0, 20.0, 10.0, nan]),
                "exceptions": st.integers(0, 5),
            },
            optional={name: st.booleans() for name in FLAGS},
        ),
        st.sampled_from([NO_REQUESTS, *(OperatorRequests(**{word: True}) for word in ("start", "abort", "hold"))]),
        st.tuples(*[st.floats(-1.0, 1.0, width=32) | st.just(nan)] * 3),
        st.sampled_from([0.0, 1.0, 10.0, 1e5]),
    ),
    max_size=60,
)  # fmt: skip


WELL_STEP = ({}, NO_REQUESTS, (0.25, -1e-4, 0.1), 1.0)


@given(steps=STEPS, well=st.integers(0, 3))
def test_whatever_happens_an_abort_stays_positive_and_nose_up_and_no_dive_begins_unproven(
    steps: list[Any], well: int
) -> None:
    monitor, executive = SafetyMonitor(LIMITS, has_drop_weight=True), Executive(started=True)
    t, before, aborted = 0.0, State.START_UP, False
    steps = [WELL_STEP, WELL_STEP, ({"phase": DESCENT}, *WELL_STEP[1:])][:well] + steps
    for changes, requests, (r_px, V_b, steering), tick in steps:
        t += tick
        now = situation(t, **changes)
        safety = monitor.update(now)
        told = executive.update(now, safety, requests)
        wanted = commands(told, CONTROL._replace(r_px=r_px, V_b=V_b, steering=steering), ACTUATORS)
        aborted = aborted or safety.worst >= Reaction.ABORT or requests.abort
        assert all(isfinite(value) for value in wanted[:3])
        assert abs(wanted.V_b) <= 2.5e-4
        if aborted:
            assert told.state is State.ABORT
            assert (wanted.V_b, wanted.r_px, wanted.steering) == (2.5e-4, 0.21, 0.0)
        if told.state is State.MISSION and before is not State.MISSION:
            assert safety.unproven == ()
        if told.state not in (State.MISSION, State.COMMUNICATE, State.RECOVER):
            assert wanted.V_b == 2.5e-4
        before = told.state


PLAN = DivePlan(
    depth=100.0,
    turns_early=0.0,
    theta=0.6,
    V_b_dive=-1e-4,
    V_b_climb=2e-4,
    V_b_surface=2e-4,
    V_b_drift=1e-5,
    r_px_drift=0.25,
    r_px_surface=nan,
    surface_time=0.0,
    longest_surface_time=0.0,
    drift_time=0.0,
    surfacing_interval=inf,
    least_altitude=10.0,
    shallow_depth=1.0,
    dives_per_surfacing=3.0,
    turn_depth=10.0,
    abort_depth=110.0,
    abort_time=43200.0,
)


class Flight:
    """Control's dive cycle under the executive, with a vehicle that sinks and rises at 1 m/s."""

    def __init__(self, phase: int, depth: float) -> None:
        self.memory = new_memory(0.0, 0.0, 0.0)
        self.memory.phase, self.memory.under_way = phase, 1
        self.memory.dives_here = 1.0
        self.memory.metres_north = self.memory.metres_east = 1.0
        self.depth, self.t = depth, 0.0

    def second(self, state: State, *, no_dive: bool) -> int:
        self.t += 1.0
        surfaced = self.depth <= 1.0
        told = ExecutiveState(
            state, 0.0, "", int(self.memory.phase), surfaced, 0.0 if surfaced else inf, False, no_dive, False, "None",
            True, False, self.t,
        )  # fmt: skip
        instruct(self.memory, told, 1.0)
        readings = situation(self.t, depth=self.depth, V_b=2e-4).readings
        advance_cycle(self.memory, PLAN, readings, self.t)
        phase = int(self.memory.phase)
        self.depth = max(0.0, self.depth + (1.0 if phase == DESCENT else -1.0))
        return phase


def test_control_dives_from_the_surface_where_it_may_and_never_where_it_may_not() -> None:
    flight = Flight(SURFACE, 0.0)
    assert {flight.second(State.HOLD, no_dive=True) for _ in range(500)} == {SURFACE}
    assert {flight.second(State.START_UP, no_dive=True) for _ in range(500)} == {SURFACE}
    assert flight.second(State.COMMUNICATE, no_dive=False) in (SURFACE, DESCENT)
    assert flight.second(State.COMMUNICATE, no_dive=False) == DESCENT


def test_alarm_of_control_ends_in_its_recovery_although_the_executive_holds() -> None:
    flight = Flight(SURFACE, 0.0)
    flight.second(State.HOLD, no_dive=True)
    flight.memory.alarm = ABORT_LEAK
    assert [flight.second(State.HOLD, no_dive=True) for _ in range(3)][-1] == RECOVERY


@pytest.mark.parametrize("phase", [DESCENT, DRIFT])
def test_dive_that_ends_early_goes_to_the_surface_without_another_turn(phase: int) -> None:
    flight = Flight(phase, 60.0)
    seen = [flight.second(State.ASCEND, no_dive=True) for _ in range(70)]
    assert (seen[0], seen[1], seen[-1]) in ((INFLECTION, ASCENT, SURFACE), (ASCENT, ASCENT, SURFACE))
    assert set(seen) <= {INFLECTION, ASCENT, SURFACE}


def test_mission_turns_under_water_but_not_where_no_dive_may_begin() -> None:
    flight = Flight(ASCENT, 15.0)
    assert DESCENT in {flight.second(State.MISSION, no_dive=False) for _ in range(20)}
    flight = Flight(ASCENT, 15.0)
    assert {flight.second(State.MISSION, no_dive=True) for _ in range(10)} == {ASCENT}


def test_software_that_wakes_up_under_water_ascends() -> None:
    """Its memory is new and says surface, with nothing else known."""
    flight = Flight(SURFACE, 60.0)
    assert {flight.second(State.ASCEND, no_dive=True) for _ in range(50)} == {ASCENT}
