"""Oracle: Joessel's rule at its ends, closed forms without friction, and what a normally closed brake promises."""

from math import degrees, pi, radians

import pytest

from stommel.design.drives import DriveStudy, drive_study
from stommel.machinery.drives import RudderDrive
from stommel.machinery.drives.rudder import centre_of_pressure
from stommel.vehicle import builtin_text, load_vehicle, vehicle_from_text

ZJU = load_vehicle("zju")


@pytest.fixture(scope="module")
def study() -> DriveStudy:
    return drive_study(ZJU, rudder_deg=30.0, hold_s=100.0)


def test_centre_of_pressure_goes_to_the_middle_of_a_plate_abeam() -> None:
    assert centre_of_pressure(0.0) == pytest.approx(0.195)
    assert centre_of_pressure(pi / 2) == pytest.approx(0.5)
    assert centre_of_pressure(-0.4) == centre_of_pressure(0.4)


def test_hinge_moment_is_force_times_arm() -> None:
    drive = RudderDrive.of(ZJU)
    delta_r = radians(20.0)
    force = 5.0 * delta_r * 0.6**2  # side-force slope of the file, as in the equations of motion
    arm = 0.08 * (centre_of_pressure(delta_r) - 0.2)
    assert drive.hinge_moment(delta_r, 0.6) == pytest.approx(force * arm, rel=1e-12)
    assert drive.hinge_moment(delta_r, 1.2) == pytest.approx(4 * drive.hinge_moment(delta_r, 0.6), rel=1e-12)


def test_step_in_still_water_without_friction_runs_at_no_load_speed() -> None:
    drive = RudderDrive.of(ZJU.with_value("drives.rudder.seal_friction_mn_m", 0.0))
    step = drive.step(0.0, radians(60.0), 0.0)
    assert step is not None
    expected = radians(60.0) * drive.gearbox.ratio / drive.motor.no_load_speed
    assert step.time == pytest.approx(expected, rel=1e-12)
    assert step.energy == pytest.approx(expected * drive.motor.U * drive.motor.I_0, rel=1e-12)


def test_water_hinders_the_way_out_and_helps_the_way_back() -> None:
    drive = RudderDrive.of(ZJU)
    out, back = drive.step(0.0, radians(60.0), 3.0), drive.step(radians(60.0), 0.0, 3.0)
    across = drive.step(radians(-60.0), radians(60.0), 3.0)
    assert out is not None
    assert back is not None
    assert across is not None
    assert out.time > back.time
    assert out.greatest_torque > back.greatest_torque
    assert across.time == pytest.approx(out.time + back.time, rel=1e-3)
    assert across.energy == pytest.approx(out.energy + back.energy, rel=1e-2)


def test_energy_of_a_turn_is_the_sum_of_its_parts(study: DriveStudy) -> None:
    assert study.rudder is not None
    turn, brake = study.rudder.turn, study.rudder.drive.brake
    assert turn is not None
    assert brake is not None
    fed = 2 * brake.release_ms / 1e3 + turn.out.time + turn.back.time
    assert turn.brake_energy == pytest.approx(brake.power_w * fed, rel=1e-12)
    assert turn.hold_energy == 0.0
    assert turn.energy == pytest.approx(turn.out.energy + turn.back.energy + turn.brake_energy, rel=1e-12)
    assert degrees(turn.angle) == pytest.approx(30.0)


def test_a_normally_open_brake_pays_for_holding() -> None:
    text = builtin_text("zju").replace("release_ms = 30\n", "release_ms = 30\nnormally_closed = false\n", 1)
    study = drive_study(vehicle_from_text(text, "open.toml"), hold_s=100.0)
    assert study.rudder is not None
    assert study.rudder.turn is not None
    assert study.rudder.turn.hold_energy == pytest.approx(500.0)
    assert "brake_needs_power" in {warning.name for warning in study.warnings}


def test_without_a_brake_the_motor_holds() -> None:
    text = builtin_text("zju")
    start = text.index("[drives.rudder.brake]")
    end = text.index("[hull]")
    study = drive_study(vehicle_from_text(text[:start] + text[end:], "free.toml"), hold_s=100.0)
    assert study.rudder is not None
    turn, drive = study.rudder.turn, study.rudder.drive
    assert turn is not None
    assert turn.brake_energy == 0.0
    current = drive.hinge_moment(turn.angle, study.rudder.V) / drive.gearbox.ratio / drive.motor.K_t
    assert turn.hold_energy == pytest.approx(drive.motor.R * current**2 * 100.0)
    assert "no_brake" in {warning.name for warning in study.warnings}
