"""Cases that a pencil solves: one consumer, one pump, one sampling plan."""

from dataclasses import replace

import numpy as np
import pytest

from stommel.design.endurance import endurance
from stommel.design.endurance.dive_cycle import INFLATE
from stommel.design.endurance.endurance import Wanted, balance, flights_of
from stommel.machinery.power import EnergyModel, energy_model
from stommel.machinery.power.actuator_models import ActuatorWorks
from stommel.machinery.power.actuator_work import PitchDriveWork, PumpWork, RudderWork
from stommel.vehicle import PAPER, Vehicle
from stommel.vehicle.schema import Consumer

WANTED = Wanted(speed_m_s=0.4, pitch_deg=-35.0, depth_m=200.0)
ETA = 0.4


def free_works(eta: float = np.inf) -> ActuatorWorks:
    """Actuators that move in no time, and cost nothing but pressure work over `eta`."""
    P = np.array([0.0, 1e7])
    none, fast = np.zeros(2), np.full(2, 1e9)
    return ActuatorWorks(
        PumpWork(P, P / eta, fast, none, fast, "pencil", starting_j=none),
        PitchDriveWork(np.array([-50.0, 50.0]), none, none, "pencil"),
        RudderWork(np.array([0.0]), np.array([0.0]), 0.0, "pencil"),
    )


def pencil_model(vehicle: Vehicle, *consumers: Consumer, eta: float = np.inf, **plan: float) -> EnergyModel:
    model = energy_model(vehicle)
    plan = {"surface_session_s": 0.0, "rudder_turns_per_dive": 0.0, "pitch_corrections_per_dive": 0.0, **plan}
    return replace(model, works=free_works(eta), consumers=consumers, plan=model.plan.model_copy(update=plan))


def test_one_lamp_empties_the_battery(zju: Vehicle) -> None:
    lamp = Consumer(name="lamp", part="hotel", power_w=2.0, supply="battery")
    model = pencil_model(zju, lamp)
    found = balance(model, WANTED, *flights_of(zju, WANTED, PAPER))
    rated = 45 * 3600 * 24.0
    # 15 deg C lies between 10 deg C (0.95) and 25 deg C (1.0); 3 % a month of self-discharge
    usable, lost = rated * 0.9 * (0.95 + 0.05 / 3.0), 0.03 * rated / (30 * 86400)
    assert found.endurance_s == pytest.approx(usable / (2.0 + lost), rel=1e-12)


def test_a_regulator_asks_for_more(zju: Vehicle) -> None:
    lamp = Consumer(name="lamp", part="hotel", power_w=2.0, supply="regulated")
    found = balance(pencil_model(zju, lamp), WANTED, *flights_of(zju, WANTED, PAPER))
    assert found.mean_power_w == pytest.approx(2.0 / 0.85, rel=1e-12)


def test_times_of_a_dive_are_depth_over_vertical_speed(zju: Vehicle) -> None:
    dive, climb = flights_of(zju, WANTED, PAPER)
    cycle = balance(pencil_model(zju), WANTED, dive, climb).cycle
    down = 200.0 / (0.4 * np.sin(-dive.gamma))
    assert float(cycle.dive_s) == pytest.approx(down, rel=1e-9)
    assert float(cycle.climb_s) == pytest.approx(down, rel=1e-9)
    assert float(cycle.distance_m) == pytest.approx(2 * 200.0 / np.tan(-dive.gamma), rel=1e-9)


def test_inflating_at_depth_is_pressure_times_swing_over_efficiency(zju: Vehicle) -> None:
    dive, climb = flights_of(zju, WANTED, PAPER)
    found = balance(pencil_model(zju, eta=ETA), WANTED, dive, climb)
    swing = 2 * 55.788e-6  # Table 1 at -35 deg, both ways
    assert found.energy_per_dive_j[INFLATE] == pytest.approx(1000 * 9.81 * 200 * swing / ETA, rel=1e-4)


@pytest.mark.parametrize(
    ("plan", "share", "phase"),
    [
        ({"duty": 0.25, "on": "always"}, 0.25, "duration_s"),
        ({"sample_s": 2.0, "sample_every_s": 20.0, "on": "dive"}, 0.1, "dive_s"),
        ({"duty": 0.5, "on": "climb"}, 0.5, "climb_s"),
    ],
)
def test_sampling_plans(zju: Vehicle, plan: dict[str, object], share: float, phase: str) -> None:
    sensor = Consumer(name="s", part="sensors", power_w=1.0, standby_w=0.1, supply="battery", **plan)
    found = balance(pencil_model(zju, sensor, surface_session_s=100.0), WANTED, *flights_of(zju, WANTED, PAPER))
    on = share * float(getattr(found.cycle, phase))
    off = float(found.cycle.duration_s) - on
    assert found.energy_per_dive_j["s"] == pytest.approx(on + 0.1 * off, rel=1e-12)


def test_surfacing_every_third_dive_shares_its_cost(zju: Vehicle) -> None:
    radio = Consumer(
        name="r", part="communication", power_w=6.0, on="surface", seconds_per_surfacing=60.0, supply="battery"
    )
    flights = flights_of(zju, WANTED, PAPER)
    every = balance(pencil_model(zju, radio, surface_session_s=90.0), WANTED, *flights)
    third = balance(
        pencil_model(zju, radio, surface_session_s=90.0, dives_per_surfacing=3, upper_turn_m=20.0), WANTED, *flights
    )
    assert every.energy_per_dive_j["r"] == pytest.approx(360.0)
    assert third.energy_per_dive_j["r"] == pytest.approx(120.0)
    # two of three legs end 20 m below the surface
    assert float(third.cycle.dive_s) == pytest.approx(float(every.cycle.dive_s) * (200 - 40 / 3) / 200, rel=1e-12)


@pytest.mark.parametrize(("temperature", "derating"), [(-30, 0.7), (-20, 0.7), (5, 0.915), (25, 1.0), (60, 1.0)])
def test_derating_follows_its_table(zju: Vehicle, temperature: float, derating: float) -> None:
    assert energy_model(zju, temperature_c=temperature).stored.derating == pytest.approx(derating)


def test_defaults_are_the_specification(zju: Vehicle) -> None:
    spelled = endurance(zju, speed_m_s=0.4, pitch_deg=-35.0, depth_m=200.0)
    assert endurance(zju).endurance_s == spelled.endurance_s
