"""Oracle: energy balances, an independent integration in time, and the published trim positions."""

import re
from math import atan, degrees, radians, sin, tan

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from stommel.design.drives import DriveStudy, drive_study
from stommel.machinery.drives import DriveError, PitchDrive
from stommel.machinery.drives.limit_switches import LimitSwitches, over_run
from stommel.vehicle import Vehicle, builtin_text, load_vehicle, vehicle_from_text

ZJU = load_vehicle("zju")
PITCHES = [radians(angle) for angle in range(-50, 51, 5)]


@pytest.fixture(scope="module")
def study() -> DriveStudy:
    return drive_study(ZJU)


def names(vehicle: Vehicle) -> set[str]:
    return {warning.name for warning in drive_study(vehicle).warnings}


@pytest.mark.parametrize("direction", [-1, 1])
def test_power_goes_into_heat_lift_and_friction(direction: int) -> None:
    """Electrical power = winding's heat + no-load loss + shaft; the shaft gives at least the lift and the guide."""
    drive = PitchDrive.of(ZJU)
    for theta in PITCHES:
        point = drive.point(theta, direction)  # type: ignore[arg-type]  # -1 or 1
        m, run = drive.motor, point.motor
        shaft = run.torque * run.speed
        assert run.power == pytest.approx(m.R * run.current**2 + m.K_t * m.I_0 * run.speed + shaft, rel=1e-12)
        assert shaft >= point.load * point.speed
        if point.load > 0.0:
            assert point.load * point.speed == pytest.approx(drive.efficiency * shaft, rel=1e-12)


def test_lift_is_the_weight_times_the_height() -> None:
    """Without any friction the shaft's work is m g dh."""
    text = builtin_text("zju")
    for name in ("guide_friction = { value = 0.1", "friction = { value = 0.1,", "friction = { value = 0.12,"):
        assert name in text
        text = text.replace(name, name.split("value")[0] + "value = 0.0" + ("," if name.endswith(",") else ""), 1)
    text = re.sub(r", range = \[[^]]*\]", "", text)  # frictionless lies outside them
    drive = PitchDrive.of(vehicle_from_text(text, "smooth.toml"))
    point = drive.point(radians(30.0), 1)
    work_per_metre = point.motor.torque * point.motor.speed / point.speed
    assert work_per_metre == pytest.approx(10.0 * 9.81 * sin(radians(30.0)), rel=1e-12)


def test_trim_change_is_between_the_published_positions(study: DriveStudy) -> None:
    assert study.pitch is not None
    change = study.pitch.dive_to_climb
    assert change is not None
    assert change.start.r_px * 1e3 == pytest.approx(408.2, abs=0.05)  # Table 2 of the paper
    assert change.end.r_px * 1e3 == pytest.approx(91.8, abs=0.05)
    assert change.travel / max(p.speed for p in study.pitch.points) < change.time < change.longest_time


def test_trim_change_by_integration_in_time(study: DriveStudy) -> None:
    """dr/dt = -v(theta(r)), dE/dt = P: another integrator, another variable."""
    assert study.pitch is not None
    change, drive = study.pitch.dive_to_climb, study.pitch.drive
    assert change is not None
    start, end = change.start, change.end

    def rates(_t: float, y: np.ndarray) -> list[float]:
        share = (y[0] - start.r_px) / (end.r_px - start.r_px)
        point = drive.point(atan(tan(start.theta) + share * (tan(end.theta) - tan(start.theta))), -1)
        return [-point.speed, point.motor.power]

    def arrives(_t: float, y: np.ndarray) -> float:
        return float(y[0] - end.r_px)

    arrives.terminal = True  # type: ignore[attr-defined]
    found = solve_ivp(rates, (0.0, 200.0), [start.r_px, 0.0], events=arrives, rtol=1e-8, atol=1e-9)
    assert change.time == pytest.approx(found.t_events[0][0], rel=1e-4)
    assert change.energy == pytest.approx(found.y_events[0][0][1], rel=1e-4)


def test_zju_drive_agrees_with_its_actuators(study: DriveStudy) -> None:
    """The speeds that the vehicle file assumes are those of the drives that it describes."""
    assert study.pitch is not None
    assert study.rudder is not None
    assert study.pitch.speed is not None
    assert study.rudder.speed is not None
    assert study.pitch.speed * 1e3 == pytest.approx(ZJU.value("actuators.moving_mass.speed_mm_s"), rel=0.02)
    assert degrees(study.rudder.speed) == pytest.approx(ZJU.value("actuators.rudder.speed_deg_s"), rel=0.02)
    assert study.warnings == ()


def test_zju_starts_at_its_steepest_pitch_and_holds_without_power(study: DriveStudy) -> None:
    assert study.pitch is not None
    drive, worst = study.pitch.drive, study.pitch.worst_start
    assert abs(degrees(worst.theta)) == pytest.approx(50.0)
    assert worst.starts
    assert worst.uphill
    assert worst.starting_torque > drive.point(worst.theta, worst.direction).motor.torque
    assert drive.self_locking
    assert drive.screw.self_locking
    assert drive.worm is not None
    assert drive.worm.self_locking


def test_run_on_is_the_rotors(study: DriveStudy) -> None:
    """Coasting integrated in time from the rotor's equation of motion."""
    assert study.pitch is not None
    drive, limits = study.pitch.drive, study.pitch.limits
    assert limits is not None
    run = over_run(drive, limits, 1, radians(50.0))
    worst = 0.0
    for theta in (-radians(50.0), 0.0, radians(50.0)):
        point = drive.point(theta, 1)
        slowing = (point.motor.torque + drive.motor.K_t * drive.motor.I_0) / drive.motor.J
        time = point.motor.speed / slowing
        angle = np.trapezoid(point.motor.speed - slowing * np.linspace(0, time, 2001), np.linspace(0, time, 2001))
        worst = max(worst, point.speed * limits.delay + angle * drive.travel_per_radian)
    assert run.run_on == pytest.approx(worst, rel=1e-6)
    assert run.caught


def test_limit_switches_let_the_mass_only_back() -> None:
    limits = LimitSwitches.of(ZJU)
    assert limits is not None
    for r_px, zone, aft, forward in (
        (0.25, "within travel", True, True),
        (0.55, "within travel", True, True),
        (0.5515, "beyond software limit", True, False),
        (0.554, "on the switch", True, False),
        (0.56, "at the end stop", True, False),
        (-0.0515, "beyond software limit", False, True),
        (-0.054, "on the switch", False, True),
        (-0.061, "at the end stop", False, True),
    ):
        assert limits.zone(r_px) == zone
        assert limits.may_move(r_px, -1) is aft
        assert limits.may_move(r_px, 1) is forward


@pytest.mark.parametrize(
    ("changes", "name"),
    [
        ({"drives.pitch.worm.friction": 0.01, "drives.pitch.screw.friction": 0.01}, "mass_not_held"),
        ({"drives.pitch.worm.friction": 0.01}, "worm_back_drives"),
        ({"drives.pitch.motor.resistance_ohm": 120.0}, "cannot_start"),
        ({"drives.pitch.motor.continuous_current_a": 0.1}, "motor_overloaded"),
        ({"drives.pitch.switch_delay_ms": 2000.0}, "over_run"),
        ({"actuators.moving_mass.speed_mm_s": 6.0}, "moving_mass_speed_differs"),
        ({"actuators.rudder.speed_deg_s": 30.0}, "rudder_speed_differs"),
        ({"drives.rudder.stock_chord_fraction": 0.4}, "rudder_overbalanced"),
        ({"drives.rudder.brake.holding_torque_mn_m": 0.01}, "brake_slips"),
        ({"drives.rudder.seal_friction_mn_m": 1e5}, "rudder_stalls"),
        ({"actuators.moving_mass.travel_mm.1": 400.0}, "no_trim_change"),
    ],
)
def test_every_weakness_has_its_name(changes: dict[str, float], name: str) -> None:
    vehicle = ZJU
    for key, value in changes.items():
        vehicle = vehicle.with_value(key, value)
    assert name in names(vehicle)


def test_a_screw_that_slips_without_a_worm_is_pushed_back() -> None:
    """The same verdict from the force: without power the load turns the motor if the thread lets it."""
    slippery = ZJU.with_value("drives.pitch.worm.friction", 0.0).with_value("drives.pitch.screw.friction", 0.0)
    drive = PitchDrive.of(slippery)
    assert not drive.self_locking
    downhill = drive.point(radians(-50.0), 1)
    assert downhill.load < 0.0
    assert downhill.motor.torque < 0.0
    assert PitchDrive.of(ZJU).point(radians(-50.0), 1).motor.torque > 0.0


def test_impossible_questions_are_refused() -> None:
    with pytest.raises(DriveError, match=r"slocum\.toml: has neither a table \[drives\.pitch\]"):
        drive_study(load_vehicle("slocum"))
    with pytest.raises(DriveError, match="steepest pitch = 95 deg"):
        drive_study(ZJU, steepest_deg=95.0)
    with pytest.raises(DriveError, match="rudder angle = 61 deg"):
        drive_study(ZJU, rudder_deg=61.0)
    with pytest.raises(DriveError, match="hold = nan s"):
        drive_study(ZJU, hold_s=float("nan"))
    narrow = ZJU.with_value("drives.pitch.switches_mm.0", -40.0)
    with pytest.raises(DriveError, match=r"switches_mm = \[-40, 553\]: must enclose actuators\.moving_mass\.travel_mm"):
        drive_study(narrow)


@pytest.mark.parametrize("pitch", [0.0, 35.0, 60.0, -80.0])
def test_guide_bears_what_stands_across_it(pitch: float) -> None:
    """A block on an incline: m g sin along it either way, and friction of the part of the weight across it, m g cos."""
    drive = PitchDrive.of(load_vehicle("zju"))
    theta, weight = np.radians(pitch), 10.0 * 9.81
    forward, aft = drive.load(theta, 1), drive.load(theta, -1)
    assert 0.5 * (forward - aft) == pytest.approx(weight * np.sin(theta), abs=1e-9)
    assert 0.5 * (forward + aft) == pytest.approx(0.1 * weight * np.cos(theta))
