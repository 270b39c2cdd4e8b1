"""One decision, three callers: the same commands compiled, as plain Python, and inlined in the mission loop."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from stommel.control.commands import (
    GOING_ON,
    LOAD_CLIMB,
    LOAD_DIVE,
    LOAD_DRIFT,
    LOAD_SURFACE,
    LOAD_UNDERWATER,
    Commands,
)
from stommel.control.decision import decide
from stommel.control.dive_cycle import (
    ASCENT,
    CONDITIONS,
    DESCENT,
    DRIFT,
    INFLECTION,
    PHASES,
    RECOVERY,
    SURFACE,
    TRANSITIONS,
    wanted_loads,
)
from stommel.control.memory import MEMORY
from stommel.control.orders import Orders
from stommel.control.own_laws import LAWS, UnknownLawError, with_laws
from stommel.control.readings import Readings
from stommel.simulation.flight import Flown, fly_mission
from stommel.simulation.simulator import MissionOverError, Simulator
from tests.simulation.conftest import EXACT, column, made, mission_document

Decide = Callable[[np.record, Orders, Readings, float], Commands]
DIVES = {"depth_m": 60.0, "pitch_deg": 35.0, "speed_m_s": 0.35}
SHORT: dict[str, Any] = {"dives": DIVES, "duration_days": 0.08, "output_every_s": 1.0}


@pytest.fixture(scope="module")
def own() -> Flown:
    """The vehicle's own software, inlined in the loop."""
    return fly_mission(made(mission_document(**SHORT)))


def same(one: Flown, other: Flown, rtol: float) -> None:
    assert one.outcome == other.outcome
    for rows in ("record", "samples", "surfacings", "events"):
        for name in getattr(one, rows).dtype.names or ():
            np.testing.assert_allclose(getattr(one, rows)[name], getattr(other, rows)[name], rtol=rtol, atol=1e-9)


def test_called_alone_it_flies_the_same_bytes(own: Flown) -> None:
    simulator = Simulator(made(mission_document(**SHORT)))
    while simulator.running:
        simulator.step(decide(simulator.memory, simulator.orders, simulator.readings, simulator.time))
    same(simulator.flown(), own, rtol=0.0)
    with pytest.raises(MissionOverError, match=r"test\.toml: the mission is over: time over"):
        simulator.step(Commands(0.25, 0.0, 0.0, 1e-3, 0, False, False, GOING_ON))


def test_plain_python_decides_as_compiled_code() -> None:
    """At every decision of a few dives, from the same memory and readings; only rounding differs."""
    simulator, plain = Simulator(made(mission_document(**SHORT))), with_laws()
    while simulator.running:
        memory = np.array([simulator.memory], MEMORY).view(np.recarray)[0]
        told = simulator.orders, simulator.readings, simulator.time
        expected, found = decide(simulator.memory, *told), plain(memory, *told)
        np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-12)
        np.testing.assert_allclose(memory.tolist(), simulator.memory.tolist(), rtol=1e-9, atol=1e-9)
        simulator.step(expected)
    assert simulator.memory.dives >= 3.0


def test_compiled_controller_flies_the_same(own: Flown) -> None:
    """The compiled decision handed in as somebody else's."""
    same(fly_mission(made(mission_document(**SHORT)), controller=decide), own, rtol=1e-9)


def test_one_law_may_be_replaced() -> None:
    """A steering law that holds the rudder still: the heading is not sought any more."""

    def amidships(law: Any, previous: float, error: float, rate: float, pole: float, drive: float, way: float) -> float:
        return 0.0

    found = fly_mission(
        made(mission_document(**SHORT, sensors=EXACT)), controller=with_laws(steering_command=amidships)
    )
    assert np.all(column(found, "rudder") == 0.0)
    own = fly_mission(made(mission_document(**SHORT, sensors=EXACT)))
    assert np.abs(column(own, "rudder")).max() > math.radians(1.0)


def test_unknown_law_is_named() -> None:
    with pytest.raises(UnknownLawError, match=r"steering: is no law of the vehicle; known are .*steering_command"):
        with_laws(steering=lambda: 0.0)


def test_every_law_is_one_of_the_decision() -> None:
    from stommel.control import decision

    assert all(hasattr(decision, name) for name in LAWS)


def held(simulator: Simulator, seconds: int, **changes: Any) -> Flown:
    """The start's ballast and mass held, with other commands changed."""
    quiet = Commands(0.25, simulator.readings.V_b, 0.0, 1e-3, 0, False, False, GOING_ON)
    for _ in range(seconds):
        simulator.step(quiet._replace(**changes))
    return simulator.flown()


def test_plant_obeys_commands_not_phases() -> None:
    """Afloat in the phase of the start: what is commanded is on, whatever the software's memory says."""
    document = mission_document(**SHORT, sensors=EXACT)
    dark = held(Simulator(made(document)), 100)
    assert len(dark.samples) == 0
    lit = held(Simulator(made(document)), 100, loads=LOAD_SURFACE, sampling=True, radio=True)
    assert len(lit.samples) == 10
    assert column(lit, "energy_communication")[-1] > column(dark, "energy_communication")[-1]
    assert column(lit, "energy_sensors")[-1] > column(dark, "energy_sensors")[-1]


def test_gps_is_heard_only_when_it_is_told_to_listen() -> None:
    document = mission_document(**SHORT, sensors=EXACT | {"first_fix_s": 40.0})
    for radio in (False, True):
        simulator, fixes = Simulator(made(document)), []
        for _ in range(60):
            readings = simulator.step(Commands(0.25, 2e-4, 0.0, 1e-3, 0, False, radio, GOING_ON))
            fixes += [readings.fix_time] if readings.fixed else []
        assert (len(fixes) > 0) == radio
        assert all(t >= 39.0 for t in fixes)


def test_hull_floats_by_itself() -> None:
    """A vehicle whose software believes itself in a descent, but keeps its oil outside, lies on the water."""
    simulator = Simulator(made(mission_document(**SHORT, sensors=EXACT)))
    simulator.memory.phase = float(DESCENT)
    found = held(simulator, 300)
    assert np.abs(column(found, "depth")).max() == 0.0


def test_pitch_drive_bears_the_true_slope() -> None:
    """Late attitude changes what the software knows, not the load of a drive whose feedback is off."""
    late, prompt = (
        fly_mission(made(mission_document(
            **SHORT, sensors=EXACT | {"attitude_latency_s": wait}, pitch_control={"gain_mm_per_deg": 0.0},
            heading_control={"limit_deg": 0.0}, ocean={"name": "still"},
        )))
        for wait in (15.0, 0.0)
    )  # fmt: skip
    spent = [column(found, "energy_pitch_drive")[-1] for found in (late, prompt)]
    assert spent[0] == pytest.approx(spent[1], rel=1e-9)
    assert spent[0] > 0.0


def test_bias_of_the_pressure_sensor_is_believed() -> None:
    """It says 5 m too much: the vehicle turns 5 m too high."""
    deepest = [
        column(fly_mission(made(mission_document(**SHORT, sensors=EXACT | {"pressure_bias_m": bias}))), "depth").max()
        for bias in (0.0, 5.0)
    ]
    assert deepest[0] - deepest[1] == pytest.approx(5.0, abs=0.3)


def test_table_of_transitions_is_whole() -> None:
    assert {row.phase for row in TRANSITIONS} == set(range(len(PHASES))) - {RECOVERY}
    assert {row.condition for row in TRANSITIONS} == set(range(len(CONDITIONS)))
    assert {row.next for row in TRANSITIONS} == set(range(len(PHASES)))
    assert [row.phase for row in TRANSITIONS] == sorted(row.phase for row in TRANSITIONS)


def test_loads_of_each_phase() -> None:
    assert {phase: wanted_loads(phase) for phase in range(len(PHASES))} == {
        SURFACE: LOAD_SURFACE,
        RECOVERY: LOAD_SURFACE,
        DESCENT: LOAD_UNDERWATER | LOAD_DIVE,
        DRIFT: LOAD_UNDERWATER | LOAD_DRIFT,
        INFLECTION: LOAD_UNDERWATER | LOAD_CLIMB,
        ASCENT: LOAD_UNDERWATER | LOAD_CLIMB,
    }


def test_memory_is_plain_numbers() -> None:
    assert MEMORY.names is not None
    assert {MEMORY[name].kind for name in MEMORY.names} <= {"f", "i"}


def test_roll_is_read_when_it_is_asked_for() -> None:
    """Told to turn, the vehicle banks; without noise its reading is the true roll of the same moment."""
    simulator = Simulator(made(mission_document(**SHORT, sensors=EXACT)))
    rolls = []
    while simulator.running:
        rolls.append(simulator.readings.phi)
        simulator.step(decide(simulator.memory, simulator.orders, simulator.readings, simulator.time))
    true = column(simulator.flown(), "roll")
    np.testing.assert_allclose(rolls, true, atol=1e-9)
    assert np.abs(true).max() > math.radians(1.0)
