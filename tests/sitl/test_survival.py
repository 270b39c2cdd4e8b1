"""Oracle of what no pilot survives: the volumes by hand, from an engine of simple numbers."""

from math import inf

import numpy as np
import pytest

from stommel.simulation.plant.parameters import Engine
from stommel.simulation.scenario.mission import Mission
from stommel.sitl.campaign.flight import FaultFlight, means_of
from stommel.sitl.campaign.survival import Means, Profile, Struck, followed, is_hidden, unsurvivable
from stommel.sitl.faults.fault import Fault

FLAT = np.array([0.0, 1e8])
ENGINE = Engine(FLAT, np.full(2, 5e-6), np.full(2, 1e4), np.full(2, 1e-5), np.full(2, 1e4), -250e-6, 250e-6)
"""Pump of 5 ml/s, valve of 10 ml/s, 250 ml to either side."""
MEANS = Means(
    ENGINE, drop_volume=0.0, lost_below=400.0, ends=7200.0, sink_speed=0.25, speed_volume=130e-6, settling_way=10.0
)
DIVING = Struck(1000.0, 50.0, -130e-6, -150e-6)
"""In a descent: neutral at the surface with 20 ml outside."""
AFLOAT = Struck(1000.0, 0.0, 250e-6, 230e-6)


def broken(kind: str, value: float = 0.0, at: float = 1000.0, lasts: float = inf, target: str = "") -> Fault:
    return Fault(kind, target, at, lasts, value)


@pytest.mark.parametrize(
    ("faults", "struck", "name"),
    [
        ([broken("pump_dead")], DIVING, "pump_dead"),
        ([broken("pump_dead")], AFLOAT, ""),
        # sinks 0.27 m/s for 600 s: 160 m deeper, and comes up
        ([broken("pump_dead", lasts=600.0)], DIVING, ""),
        # 0.27 m/s for 1800 s is 480 m
        ([broken("pump_dead", lasts=1800.0)], DIVING, "pump_dead"),
        # of 10 ml/s runs back half: exactly what the pump delivers
        ([broken("valve_stuck_open", 0.4)], DIVING, ""),
        ([broken("valve_stuck_open", 0.6)], DIVING, "valve_stuck_open"),
        # afloat with 230 ml to spare, 6200 s to go: 2.2 ml/min are 227 ml, 2.3 are 238 ml
        ([broken("hull_leak", 2.2)], AFLOAT, ""),
        ([broken("hull_leak", 2.3)], AFLOAT, "hull_leak"),
        ([broken("hull_leak", 2.2), broken("pump_dead")], AFLOAT, ""),
        ([broken("hull_leak", 2.2), broken("pump_weak", 0.5), broken("valve_stuck_open", 0.3)], AFLOAT,
         "hull_leak + pump_weak + valve_stuck_open"),
        ([broken("brown_out", 1.0, target="motion")], DIVING, "brown_out"),
        ([broken("brown_out", 1.0, target="coordinator")], DIVING, ""),
        ([broken("supply_drop", 14.0)], DIVING, "supply_drop"),
        ([broken("supply_drop", 16.0)], DIVING, ""),
        ([broken("oil_creeps", 270.0)], DIVING, ""),
        ([broken("oil_creeps", 301.0)], DIVING, "oil_creeps"),
        ([broken("sensor_stuck", target="pressure"), broken("mass_jammed")], DIVING, ""),
    ],
)  # fmt: skip
def test_volumes_by_hand(faults: list[Fault], struck: Struck, name: str) -> None:
    assert unsurvivable(faults, [struck], MEANS) == name


def test_a_drop_weight_lifts_what_the_engine_does_not() -> None:
    assert unsurvivable([broken("pump_dead")], [DIVING], MEANS._replace(drop_volume=200e-6)) == ""
    assert unsurvivable([broken("pump_dead")], [DIVING], MEANS._replace(drop_volume=140e-6)) == "pump_dead"


def test_without_a_strike_nothing_is_excused() -> None:
    assert unsurvivable([broken("pump_dead")], [], MEANS) == ""


# a pilot who is no prophet

FLOATING = Struck(1000.0, 0.0, 65e-6, 30e-6)
"""As the climb's ballast is left outside: 35 ml less, and it sinks."""
UNSEEN = FLOATING._replace(runs_in_to=-66e-6)
"""The same, with the valve open until a dive's ballast is left."""


@pytest.mark.parametrize(
    ("faults", "name"),
    [
        ([broken("pump_dead")], "pump_dead"),
        # 131 ml run in within 13 s and come back at 5 ml/s before 20 m are gone
        ([broken("pump_weak", 0.5)], ""),
        # of 10 ml/s half are what the pump delivers; what runs in while it is open runs at the valve's own share
        ([broken("valve_stuck_open", 0.45)], ""),
        ([broken("valve_stuck_open", 0.55)], "valve_stuck_open"),
        # dead for 600 s: sinks 0.21 m/s by 101 ml, less than 150 m
        ([broken("pump_dead", lasts=600.0)], ""),
    ],
)
def test_what_breaks_unseen_is_known_when_the_valve_is_to_be_shut(faults: list[Fault], name: str) -> None:
    assert unsurvivable(faults, [UNSEEN], MEANS) == name


def test_the_same_faults_before_the_proof_are_survivable() -> None:
    """Oracle: a pilot who knows stays afloat with what he has; but a valve that passes more than the pump brings."""
    for fault in (broken("pump_dead"), broken("pump_weak", 0.5), broken("valve_stuck_open", 0.45)):
        assert unsurvivable([fault], [FLOATING], MEANS) == ""
    assert unsurvivable([broken("valve_stuck_open", 0.55)], [FLOATING], MEANS) == "valve_stuck_open"


def test_the_oil_runs_in_no_farther_than_the_dive_wants() -> None:
    path = list(followed([broken("pump_dead")], UNSEEN, MEANS))
    assert path[12].spare > path[13].spare == path[-1].spare
    assert path[-1].spare == pytest.approx(30e-6 - 131e-6)


def test_a_valve_stuck_half_open_lets_half_in() -> None:
    path = list(followed([broken("valve_stuck_open", 0.5)], UNSEEN, MEANS))
    assert path[9].spare == pytest.approx(30e-6 - 50e-6)


def test_what_tells_itself_is_not_hidden() -> None:
    assert is_hidden([broken("pump_dead"), broken("valve_stuck_open", 1.0)], 1000.0)
    assert not is_hidden([broken("pump_dead"), broken("hull_leak", 5.0)], 1000.0)
    assert is_hidden([broken("pump_dead"), broken("hull_leak", 5.0, at=1001.0)], 1000.0)
    assert not is_hidden([broken("brown_out", 1.0, target="motion")], 1000.0)


def test_denser_water_carries_what_is_too_heavy_for_the_surface() -> None:
    """Oracle: too heavy by 150 ml at the surface and by none at 100 m, it stays there, and is not home."""
    water = Profile(np.array([0.0, 200.0]), np.array([0.0, 300e-6]))
    start = DIVING._replace(lighter=water)
    path = list(followed([broken("pump_dead")], start, MEANS))
    assert path[-1].depth == pytest.approx(100.0, abs=1.0)
    assert unsurvivable([broken("pump_dead")], [start], MEANS) == "pump_dead"


def test_a_vehicle_does_not_sink_at_once() -> None:
    """Oracle: v = v_end tanh(v_end t / way) from rest, with v_end = 0.25 m/s by 130 ml, way 10 m."""
    start = Struck(0.0, 0.0, -130e-6, -130e-6)
    path = list(followed([broken("pump_dead", at=0.0)], start, MEANS))
    for seconds in (20, 60, 200):
        found = path[seconds - 1].depth - path[seconds - 2].depth
        assert found == pytest.approx(0.25 * np.tanh(0.25 * seconds / 10.0), rel=0.03)


def test_the_pilot_sinks_as_the_plant_does(trial: Mission) -> None:
    """Oracle: the plant itself, whose pump dies in a descent that goes on until it would turn."""
    fault = broken("pump_dead", at=320.0)
    flight, depths = FaultFlight(trial, (fault,)), {}
    while flight.system.plant.time < 570.0:
        flight.step()
        depths[flight.system.plant.time] = flight.system.plant.depth
    path = {step.t: step.depth for step in followed([fault], flight.struck[0], means_of(flight.system.plant.setup))}
    assert depths[570.0] > 70.0
    for t in (340.0, 400.0, 480.0, 570.0):
        assert path[t] == pytest.approx(depths[t], rel=0.04)
