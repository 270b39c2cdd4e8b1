"""Oracle of what no pilot survives: the volumes by hand, from an engine of simple numbers."""

from math import inf

import numpy as np
import pytest

from stommel.simulation.plant.parameters import Engine
from stommel.sitl.campaign.survival import Means, Struck, unsurvivable
from stommel.sitl.faults.fault import Fault

FLAT = np.array([0.0, 1e8])
ENGINE = Engine(FLAT, np.full(2, 5e-6), np.full(2, 1e4), np.full(2, 1e-5), np.full(2, 1e4), -250e-6, 250e-6)
"""Pump of 5 ml/s, valve of 10 ml/s, 250 ml to either side."""
MEANS = Means(ENGINE, drop_volume=0.0, lost_below=400.0, ends=7200.0, sink_speed=0.25, speed_volume=130e-6)
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
