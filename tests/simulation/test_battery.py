"""Voltage, current and charge; oracles: V^2 - E V + R P = 0, conservation of energy, the vehicle file's numbers."""

import numpy as np
import pytest

from stommel.simulation.flight import Flown
from stommel.simulation.plant.parameters import CONSUMERS
from tests.simulation.conftest import EXACT, column, events, flown

SMALL = {"battery.capacity_ah": 0.5}
"""12 Wh at 25 deg C; the zju glider takes some 3 W."""

WHOLE = 0.5 * 3600.0 * 24.0 * np.interp(15.0, [10.0, 25.0], [0.95, 1.0])
"""By the vehicle file's derating, in the water of 15 deg C of its water table [J]."""
USABLE = 0.9 * WHOLE


@pytest.fixture(scope="module")
def drained() -> Flown:
    """Until the battery is empty."""
    return flown(changes=SMALL, sensors=EXACT, output_every_s=1.0, abort={"battery_share": 0.0}, duration_days=0.3)


def spent(found: Flown) -> np.ndarray:
    """Out of the store, with the heat of the battery's own resistance."""
    return np.sum([column(found, f"energy_{name}") for name in CONSUMERS], axis=0)


def delivered(found: Flown) -> np.ndarray:
    """At the terminals."""
    return spent(found) - column(found, "energy_battery")


def test_energy_out_of_the_battery_is_what_the_consumers_got(drained: Flown) -> None:
    power = column(drained, "voltage") * column(drained, "current")
    np.testing.assert_allclose(np.cumsum(power), delivered(drained), rtol=1e-9)
    assert power.max() > 10.0 * np.median(power)  # the pump


def test_the_store_pays_for_the_heat_of_its_own_resistance(drained: Flown) -> None:
    """R I2, of 0.15 ohm."""
    heat = np.cumsum(0.15 * np.square(column(drained, "current")))
    np.testing.assert_allclose(column(drained, "energy_battery"), heat, rtol=1e-9)


def test_voltage_solves_the_circuit(drained: Flown) -> None:
    battery, t = drained.plant.battery, column(drained, "time")
    assert battery.resistance == 0.15
    heat_of_this_second = np.diff(column(drained, "energy_battery"), prepend=0.0)
    used = spent(drained) - heat_of_this_second + battery.self_discharge * t
    left = 1.0 - used / battery.whole_energy
    E = np.interp(left, battery.charge, battery.open_voltage)
    V = column(drained, "voltage")
    P = np.diff(delivered(drained), prepend=0.0)
    np.testing.assert_allclose(V**2 - E * V + battery.resistance * P, 0.0, atol=1e-6)
    assert (V > 0.5 * E).all()  # the branch that a battery is on


def test_voltage_falls_with_charge_and_under_load(drained: Flown) -> None:
    battery, V = drained.plant.battery, column(drained, "voltage")
    assert np.trapezoid(battery.open_voltage, battery.charge) == pytest.approx(24.0)
    assert battery.whole_energy == pytest.approx(WHOLE, rel=1e-4)  # the water of the dives is at 15.02 deg C, not 15
    quiet = column(drained, "current") < np.median(column(drained, "current")) * 1.05
    tenths = np.array_split(V[quiet], 10)
    assert (np.diff([part.mean() for part in tenths]) < 0.0).all()
    assert V.min() < V[quiet].min() < V[quiet].max() - 2.0


def test_an_empty_battery_ends_the_mission(drained: Flown) -> None:
    assert drained.outcome == "battery empty"
    assert spent(drained)[-1] == pytest.approx(USABLE, rel=2e-3)


@pytest.mark.parametrize("share", [0.3, 0.6])
def test_a_low_battery_brings_the_vehicle_up(share: float) -> None:
    found = flown(changes=SMALL, sensors=EXACT, abort={"battery_share": share}, duration_days=0.3)
    assert found.outcome == "aborted, waiting at the surface"
    low = [event for event in events(found) if event[2] == "abort: battery low"]
    assert low[-1][1] == "recovery"
    # from the share on it dives no more, and from a dive it comes up at once
    crossed = float(np.interp((1.0 - share) * USABLE, spent(found), column(found, "time")))
    assert crossed < low[0][0]
    if low[0][1] == "inflection":
        assert low[0][0] < crossed + 21.0
    assert not [event for event in events(found) if event[1] == "descent" and event[0] > crossed + 21.0]
