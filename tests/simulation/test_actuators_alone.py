"""Actuators called alone: limits, stall, speeds and accounts; oracles: the vehicle file's numbers, work by hand."""

from math import pi, radians, tan
from typing import Any

import numpy as np
import pytest

from stommel.control.commands import GOING_ON, Commands
from stommel.machinery.drives.pitch import PitchDrive
from stommel.simulation.plant.actuators import Rates, actuate
from stommel.simulation.plant.building import plant_of
from stommel.simulation.plant.parameters import PITCH_DRIVE, PUMP, STEERING, Plant
from stommel.simulation.plant.world import new_world
from stommel.vehicle import Vehicle, builtin_text, vehicle_from_text

SHALLOW = 1e5
"""Of the sea [Pa]."""
TOO_DEEP = 1.5e6
"""Where the weak pump stalls [Pa]."""


@pytest.fixture(scope="module")
def plant(zju: Vehicle) -> Plant:
    return plant_of(zju)


@pytest.fixture(scope="module")
def weak(plant: Plant) -> Plant:
    """A pump of 8 ml/s at the surface and none at 1.5 MPa, at 5 MJ/m3; a valve of 10 ml/s."""
    engine = plant.engine._replace(
        pressure=np.array([0.0, TOO_DEEP]),
        pump_flow=np.array([8e-6, 0.0]),
        pump_j_m3=np.array([5e6, 5e6]),
        valve_flow=np.array([10e-6, 10e-6]),
        valve_j_m3=np.array([1e6, 1e6]),
    )
    return plant._replace(engine=engine)


class Bench:
    """A plant whose actuators follow one command, in water of one pressure and at one pitch."""

    def __init__(self, plant: Plant, pressure: float = SHALLOW, theta: float = 0.0, step: float = 1.0) -> None:
        self.plant, self.pressure, self.theta, self.step = plant, pressure, theta, step
        self.world = new_world()
        self.r_px, self.V_b, self.t = 0.25, 0.0, 0.0
        self.done: list[Rates] = []

    def follow(self, seconds: float, **wanted: float) -> "Bench":
        told: dict[str, Any] = {"r_px": self.r_px, "V_b": self.V_b, "steering": 0.0, "hold_mass": 5e-4} | wanted
        commands = Commands(**told, loads=0, sampling=False, radio=False, ended=GOING_ON)
        for _ in range(round(seconds / self.step)):
            place = (self.r_px, self.V_b, self.pressure, self.theta, self.t, self.step)
            rates = actuate(self.plant, self.world, commands, *place)
            self.r_px += rates.r_px_dot * self.step
            self.V_b += rates.u_b * self.step
            self.t += self.step
            self.done.append(rates)
        return self


@pytest.mark.parametrize(("wanted", "end"), [(5.0, 0.55), (-5.0, -0.05)])
def test_limit_switches_end_the_travel(plant: Plant, wanted: float, end: float) -> None:
    """travel_mm of the vehicle file; the mass gets there and stays, its drive off."""
    bench = Bench(plant).follow(300.0, r_px=wanted)
    assert bench.r_px == pytest.approx(end, abs=5e-4)
    assert min(bench.plant.mass.high - bench.r_px, bench.r_px - bench.plant.mass.low) >= -1e-12
    assert bench.done[-1].r_px_dot == 0.0
    assert bench.world.mass_moving == 0


@pytest.mark.parametrize(("wanted", "end"), [(2e-3, 250e-6), (-2e-3, -250e-6)])
def test_no_more_oil_moves_than_the_engine_holds(plant: Plant, wanted: float, end: float) -> None:
    bench = Bench(plant).follow(600.0, V_b=wanted)
    assert bench.V_b == pytest.approx(end, abs=1e-7)
    assert bench.done[-1].u_b == 0.0
    assert (bench.world.pumping, bench.world.valve_open) == (0, 0)


@pytest.mark.parametrize("way", [1, -1])
def test_the_engine_s_stroke_limits_the_oil(way: int) -> None:
    """150 mm of a piston of 50 mm about the middle of the 500 ml, and of a lopsided range, that the table states."""
    stroke = pi / 4.0 * 50.0**2 * 150.0 / 1e3
    short = builtin_text("zju").replace("value = [22.5, 277.5]", "value = [75, 225]")
    for stated, middle in (("[-250, 250]", 0.0), ("[-200, 400]", 100.0)):
        vehicle = vehicle_from_text(short.replace("value = [-250, 250]", f"value = {stated}"), "short.toml")
        bench = Bench(plant_of(vehicle)).follow(900.0, V_b=way * 5e-3)
        assert bench.V_b * 1e6 == pytest.approx(middle + way * 0.5 * stroke, abs=0.2)


@pytest.mark.parametrize(("wanted", "middle"), [(radians(200.0), 1.0), (radians(-200.0), -1.0)])
def test_rudder_stops_at_its_travel_and_turns_no_faster_than_its_drive(
    plant: Plant, wanted: float, middle: float
) -> None:
    """60 deg to either side at 20 deg/s: three seconds; the step's own angle is the one at its middle."""
    bench = Bench(plant).follow(10.0, steering=wanted)
    angles = np.degrees([rates.steering for rates in bench.done])
    np.testing.assert_allclose(angles, middle * np.array([10.0, 30.0, 50.0, *[60.0] * 7]), atol=1e-9)
    rates = np.degrees([rates.steering_rate for rates in bench.done])
    np.testing.assert_allclose(rates, middle * np.array([20.0] * 3 + [0.0] * 7), atol=1e-9)
    assert np.degrees(bench.world.steering) == pytest.approx(middle * 60.0)
    assert bench.world.steering_moving == 0
    assert bench.world.energy[STEERING] == pytest.approx(plant.steering.j_rad * radians(60.0))


def test_a_stalled_pump_moves_no_oil_and_the_valve_still_works(weak: Plant) -> None:
    bench = Bench(weak, pressure=TOO_DEEP).follow(60.0, V_b=2e-4)
    assert bench.V_b == 0.0
    assert bench.world.pumping == 0
    assert bench.world.energy[PUMP] == 0.0
    deeper = Bench(weak, pressure=2.0 * TOO_DEEP).follow(60.0, V_b=2e-4)
    assert deeper.V_b == 0.0
    bench.follow(60.0, V_b=-2e-4)
    assert bench.V_b == pytest.approx(-2e-4, abs=1e-7)


@pytest.mark.parametrize("share", [0.25, 0.5, 0.9])
def test_a_pump_too_weak_loses_flow_with_depth(weak: Plant, share: float) -> None:
    """Straight from 8 ml/s to none: 100 ml take 12.5 s at the surface and 12.5 / (1 - share) s deeper."""
    bench = Bench(weak, pressure=share * TOO_DEEP, step=0.5).follow(400.0, V_b=1e-4)
    took = sum(rates.u_b > 0.0 for rates in bench.done) * 0.5
    assert took == pytest.approx(12.5 / (1.0 - share), abs=0.5)
    assert bench.V_b == pytest.approx(1e-4, abs=1e-7)
    assert bench.world.energy[PUMP] == pytest.approx(5e6 * 1e-4, rel=2e-3)


def test_oil_takes_its_time_and_energy_both_ways(weak: Plant) -> None:
    bench = Bench(weak, pressure=0.0).follow(5.0, V_b=1e-4)
    assert bench.V_b == pytest.approx(5.0 * 8e-6)
    assert (bench.world.pumping, bench.world.valve_open) == (1, 0)
    bench.follow(1.0, V_b=-1e-4)
    assert (bench.world.pumping, bench.world.valve_open) == (0, 1)
    assert bench.V_b == pytest.approx(30e-6)
    assert bench.world.energy[PUMP] == pytest.approx(40e-6 * 5e6 + 10e-6 * 1e6)


def test_oil_stops_at_its_command_and_not_beyond(weak: Plant) -> None:
    """A last step of 3 ml where the pump would move 8."""
    bench = Bench(weak, pressure=0.0).follow(2.0, V_b=11e-6)
    assert bench.V_b == pytest.approx(11e-6, abs=1e-12)


def test_a_pump_too_weak_for_a_depth_has_no_flow_there() -> None:
    """The engine's own motor with a quarter of its current: it stalls between the surface and 2 MPa."""
    text = builtin_text("zju").replace("current_limit_a = { value = 6,", "current_limit_a = { value = 1.5,")
    engine = plant_of(vehicle_from_text(text, "weak.toml")).engine
    strong = plant_of(vehicle_from_text(builtin_text("zju"), "own.toml")).engine
    assert (strong.pump_flow > 0.0).all()
    stalled = engine.pump_flow == 0.0
    assert not stalled[0]
    assert stalled[-1]
    assert (np.diff(stalled.astype(int)) >= 0).all()
    assert (engine.pump_j_m3[stalled] == 0.0).all()
    assert np.isfinite(engine.pump_j_m3).all()


def test_mass_stays_within_its_tolerance_and_then_goes_to_a_quarter_of_it(plant: Plant) -> None:
    hold = 2e-3
    resting = Bench(plant).follow(20.0, r_px=0.25 + 0.9 * hold, hold_mass=hold)
    assert resting.r_px == 0.25
    moved = Bench(plant, step=0.1).follow(20.0, r_px=0.25 + 1.5 * hold, hold_mass=hold)
    assert abs(moved.r_px - (0.25 + 1.5 * hold)) <= 0.25 * hold
    assert moved.world.mass_moving == 0


@pytest.mark.parametrize("theta", [radians(-35.0), 0.0, radians(35.0)])
@pytest.mark.parametrize("way", [1, -1])
def test_the_mass_s_drive_bears_the_slope(zju: Vehicle, plant: Plant, theta: float, way: int) -> None:
    """Speed and energy per metre of the drive itself, uphill and downhill: nose up, forward is uphill."""
    point = PitchDrive.of(zju).point(theta, 1 if way > 0 else -1)
    bench = Bench(plant, theta=theta).follow(8.0, r_px=0.25 + way * 0.2)
    assert np.sign(bench.done[0].r_px_dot) == way
    assert abs(bench.done[0].r_px_dot) == pytest.approx(point.speed, rel=0.01)
    per_metre = bench.world.energy[PITCH_DRIVE] / abs(bench.r_px - 0.25)
    assert point.energy_per_metre is not None
    assert per_metre == pytest.approx(point.energy_per_metre, rel=0.03)
    assert bench.world.mass_moving == 1


def test_the_steepest_slope_is_85_9_deg(plant: Plant) -> None:
    """Beyond 1.5 rad the tangent would run away: the drive counts as at the end of its table, either way."""
    for theta in (radians(89.9), radians(-89.9)):
        speed = Bench(plant, theta=theta).follow(1.0, r_px=0.5).done[0].r_px_dot
        at_the_end = np.interp(np.copysign(tan(1.5), theta), plant.mass.slope, plant.mass.speed)
        assert speed == pytest.approx(float(at_the_end))


def test_new_orders_of_oil_are_remembered_with_their_time(plant: Plant) -> None:
    """From then on the vehicle answers: finer steps of integration."""
    bench = Bench(plant)
    bench.t = 100.0
    bench.follow(3.0, V_b=5e-5)
    assert (bench.world.moved_at, bench.world.V_b_wanted) == (100.0, 5e-5)
    bench.follow(3.0, V_b=5e-5)
    assert bench.world.moved_at == 100.0
