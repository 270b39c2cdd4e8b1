"""Oracle: iron that the samples were made with, by closed forms; the plant's compass is the truth of both."""

import json
from dataclasses import replace
from math import degrees, pi, radians
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from stommel.errors import FileError
from stommel.geometry.attitude import quaternion_from_euler
from stommel.onboard.coordination.compass.calibration import (
    ACTUATORS,
    PITCH_DRIVE,
    PUMP,
    STEERING,
    VALVE,
    CompassCalibration,
)
from stommel.onboard.coordination.compass.calibration_file import calibration_text, read_calibration
from stommel.onboard.coordination.compass.fitting import CompassFitError, fit_iron
from stommel.onboard.coordination.compass.heading import attitude_of, heading_of, inclination_of
from stommel.onboard.coordination.compass.learning import LearningError, learn
from stommel.simulation.plant.sensing import compass
from stommel.simulation.plant.world import new_world
from tests.onboard.coordination.magnetic_vehicle import (
    ALL,
    HARD_IRON,
    SOFT_IRON,
    STRENGTH,
    MagneticVehicle,
    away,
    samples_text,
)
from tests.support.command import Command

QUIET = MagneticVehicle(60.0, tilt_noise=0.0, field_noise=0.0)
NOISY = MagneticVehicle(60.0)
Array = NDArray[np.float64]


@pytest.mark.parametrize("running", [0, PUMP, VALVE, PITCH_DRIVE, STEERING, PUMP | STEERING, ALL])
@pytest.mark.parametrize("inclination", [-40.0, 0.0, 65.0])
def test_heading_is_that_of_the_plant_s_compass(inclination: float, running: int) -> None:
    vehicle, world = replace(QUIET, inclination=inclination), new_world()
    told = vehicle.sensors()
    names = {PUMP: "pumping", VALVE: "valve_open", PITCH_DRIVE: "mass_moving", STEERING: "steering_moving"}
    for bit, name in names.items():
        world[name] = int(bool(running & bit))
    noise = np.random.default_rng(0)
    for phi, theta, psi in [(0.0, 0.0, 0.3), (0.4, -0.6, 2.0), (-0.8, 0.5, -1.7), (0.1, 0.9, -3.0)]:
        acceleration, field = vehicle.felt(phi, theta, psi, running, noise)
        plant = compass(told, world, quaternion_from_euler(phi, theta, psi), noise)
        assert heading_of(acceleration, field) == pytest.approx(plant.psi, abs=1e-12)
        assert attitude_of(acceleration) == pytest.approx((plant.theta, np.arctan2(plant.down_b2, plant.down_b3)))


def test_heading_of_the_four_quarters() -> None:
    """A level vehicle in a field to the north and down: by hand."""
    for quarter, field in enumerate([(20, 0, 40), (0, -20, 40), (-20, 0, 40), (0, 20, 40)]):
        assert away(heading_of((0, 0, 1), field), quarter * pi / 2) < 1e-12
        assert degrees(inclination_of((0, 0, 1), field)) == pytest.approx(63.4349, abs=1e-4)


def test_synthetic_ellipsoid_is_recovered_exactly() -> None:
    """Without noise: hard iron, the whole of the soft iron, which is no symmetric matrix, and the inclination."""
    acceleration, field, _ = QUIET.turned_about(80, np.random.default_rng(1))
    fit = fit_iron(acceleration, field)
    np.testing.assert_allclose(fit.hard_iron, HARD_IRON, atol=1e-8)
    undone = fit.correction @ np.array(SOFT_IRON)  # unit matrix, but for the sensors' scale
    np.testing.assert_allclose(undone / np.cbrt(np.linalg.det(undone)), np.eye(3), atol=1e-9)
    assert fit.strength_ut == pytest.approx(STRENGTH * np.cbrt(np.linalg.det(np.array(SOFT_IRON))), rel=1e-9)
    assert fit.inclination_deg == pytest.approx(60.0, abs=1e-7)
    assert (fit.residual_ut, fit.heading_error_deg) == pytest.approx((0.0, 0.0), abs=1e-6)


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("inclination", [-65.0, 0.0, 65.0])
def test_headings_by_a_calibration_from_noisy_samples(inclination: float, seed: int) -> None:
    """They err by no more than five of the standard errors that the fit tells, and the raw ones by much more."""
    vehicle, noise = replace(NOISY, inclination=inclination), np.random.default_rng(seed)
    fit = fit_iron(*vehicle.turned_about(300, noise)[:2])
    calm = replace(vehicle, tilt_noise=0.0, field_noise=0.0)
    errors, raw = [], []
    for theta in np.radians([-40, 0, 40]):
        for psi in np.radians(np.arange(0, 360, 15)):
            acceleration, field = calm.felt(0.1, theta, psi, 0, noise)
            corrected = fit.correction @ (np.array(field) - fit.hard_iron)
            errors.append(away(heading_of(acceleration, tuple(corrected)), psi))
            raw.append(away(heading_of(acceleration, field), psi))
    assert max(errors) < 5.0 * fit.heading_error_deg
    assert max(errors) < 1.0 < 10.0 < max(raw)


def test_error_that_the_fit_tells_is_that_of_many_fits() -> None:
    """Oracle: the spread of 60 fits to samples of their own, at the worst attitude."""
    calm, told, spread = replace(QUIET), [], []
    psi = np.radians(np.arange(0, 360, 30))
    for seed in range(60):
        noise = np.random.default_rng(100 + seed)
        fit = fit_iron(*NOISY.turned_about(120, noise)[:2])
        told.append(fit.heading_error_deg)
        row = []
        for theta in np.radians([-40, 0, 40]):
            for phi in np.radians([-10, 0, 10]):
                for heading in psi:
                    acceleration, field = calm.felt(phi, theta, heading, 0, noise)
                    corrected = fit.correction @ (np.array(field) - fit.hard_iron)
                    row.append(away(heading_of(acceleration, tuple(corrected)), heading))
        spread.append(row)
    worst = float(np.sqrt((np.array(spread) ** 2).mean(axis=0)).max())
    assert worst == pytest.approx(np.mean(told), rel=0.3)


def test_hard_iron_alone_needs_no_roll() -> None:
    acceleration, field, _ = QUIET.turned_about(60, np.random.default_rng(2), pitch=15.0, roll=5.0)
    magnets = np.array(field) @ np.linalg.inv(np.array(SOFT_IRON)).T  # as if there were no soft iron
    with pytest.raises(CompassFitError, match=r"coverage of roll: .* at least 20 deg are needed for soft iron"):
        fit_iron(acceleration, magnets)
    fit = fit_iron(acceleration, magnets, soft_iron=False)
    np.testing.assert_allclose(fit.hard_iron, np.linalg.solve(np.array(SOFT_IRON), HARD_IRON), atol=1e-7)
    np.testing.assert_allclose(fit.correction, np.eye(3), atol=1e-9)


def few(acceleration: Array, field: Array, angles: Array) -> tuple[Array, Array]:
    return acceleration[:10], field[:10]


def a_quarter(acceleration: Array, field: Array, angles: Array) -> tuple[Array, Array]:
    kept = np.abs(angles[:, 2]) < radians(50)
    return acceleration[kept], field[kept]


def little_pitch(acceleration: Array, field: Array, angles: Array) -> tuple[Array, Array]:
    kept = np.abs(angles[:, 1]) < radians(8)
    return acceleration[kept], field[kept]


def stuck(acceleration: Array, field: Array, angles: Array) -> tuple[Array, Array]:
    return acceleration, np.tile(field[:1], (len(field), 1))


def iron_nearby(acceleration: Array, field: Array, angles: Array) -> tuple[Array, Array]:
    return acceleration, field + 12.0 * np.sin(np.arange(len(field)))[:, None]


def shaken(acceleration: Array, field: Array, angles: Array) -> tuple[Array, Array]:
    return 1.5 * acceleration, field


def empty(acceleration: Array, field: Array, angles: Array) -> tuple[Array, Array]:
    return acceleration, np.full_like(field, np.nan)


@pytest.mark.parametrize(
    ("made", "words"),
    [
        (few, "10 usable samples: at least 24"),
        (a_quarter, "coverage of heading: a gap of 2"),
        (little_pitch, "coverage of pitch: 16 deg"),
        (stuck, "the field is the same in all samples"),
        (iron_nearby, "% of the field is left over, at most 3 %"),
        (shaken, "the acceleration goes from 1.49 to 1.5"),
        (empty, "0 usable samples"),
    ],
)
def test_poor_samples_are_refused_by_name(made: object, words: str) -> None:
    assert callable(made)
    acceleration, field, angles = NOISY.turned_about(400, np.random.default_rng(3))
    with pytest.raises(CompassFitError, match=words):
        fit_iron(*made(acceleration, field, angles))


def test_meagre_samples_are_warned_of_by_name() -> None:
    acceleration, field, angles = NOISY.turned_about(4000, np.random.default_rng(4), pitch=50.0, roll=14.0)
    kept = np.abs(angles[:, 2]) < radians(150)
    said = " / ".join(fit_iron(acceleration[kept], field[kept]).warnings)
    assert "coverage of heading: a gap of 60 deg" in said
    assert "coverage of roll: only 28 deg" in said
    assert "coverage of pitch" not in said


# the fields of the actuators


def at_the_surface(vehicle: MagneticVehicle, runs: list[int], noise: np.random.Generator) -> tuple[Array, list[int]]:
    """Samples of a vehicle at rest: 20 before, 20 while, 20 after each run."""
    running = [bits for run in runs for bits in [0] * 20 + [run] * 20] + [0] * 20
    return np.array([vehicle.felt(0.05, -0.3, 1.0, bits, noise)[1] for bits in running]), running


def test_fields_of_actuators_are_learnt() -> None:
    """Each alone, the valve by the sum with the pump: within five standard errors."""
    field, running = at_the_surface(NOISY, [PUMP, PUMP | VALVE, PITCH_DRIVE, STEERING], np.random.default_rng(5))
    found = learn(field, running)
    assert list(found) == list(ACTUATORS)
    for name, true in NOISY.fields().items():
        assert 0.01 < found[name].sigma < 0.1
        np.testing.assert_allclose(found[name].field, true, atol=5 * found[name].sigma)
    assert (found["pump"].runs, found["valve"].runs) == (2, 1)


def test_what_cannot_be_learnt_is_named() -> None:
    noise = np.random.default_rng(6)
    field, running = at_the_surface(NOISY, [PUMP | VALVE], noise)
    with pytest.raises(LearningError, match="pump, valve: only ran together"):
        learn(field, running)
    field, running = at_the_surface(NOISY, [PUMP], noise)
    with pytest.raises(LearningError, match="pump, samples 21 to 40: needs samples before and after it"):
        learn(field[:40], running[:40])
    with pytest.raises(LearningError, match="pump, samples 3 to 22: 2 samples before it runs"):
        learn(field[18:], running[18:])
    with pytest.raises(LearningError, match=r"pump: its field is uncertain by 1\.\d uT"):
        learn(field + 7.0 * noise.standard_normal(field.shape) * (np.array(running) > 0)[:, None], running)
    field[40:] += 3.0
    with pytest.raises(LearningError, match=r"differs by 5.2 uT.*has turned"):
        learn(field, running)
    assert learn(field[:20], running[:20]) == {}


# files


def test_command_writes_what_the_vehicle_reads(stommel: Command, tmp_path: Path) -> None:
    samples, output = tmp_path / "samples.csv", tmp_path / "compass.toml"
    samples.write_text(samples_text(NOISY, np.random.default_rng(7)))
    done = stommel("vehicle", "calibrate-compass", str(samples), "--output", str(output), "--name", "zju", "--json")
    assert done.status == 0, done.err
    answer = json.loads(done.out)
    assert answer["written"] == [str(output)]
    calibration = read_calibration(output)
    assert calibration.hard_iron == pytest.approx(HARD_IRON, abs=0.2)
    assert calibration.steering is None
    for name in ("pump", "valve", "pitch_drive"):
        assert getattr(calibration, name) == pytest.approx(NOISY.fields()[name], abs=0.25)
    assert [one["actuator"] for one in answer["actuators"]] == ["pump", "valve", "pitch_drive"]
    shown = stommel("vehicle", "calibrate-compass", str(samples))
    assert shown.status == 0
    assert "hard iron" in shown.out
    again = stommel("vehicle", "calibrate-compass", str(samples), "--output", str(output))
    assert (again.status, again.err) == (2, f"error: {output}: already exists; --force replaces it\n")


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("field_x_ut", "field_x", "column 'field_x_ut': missing"),
        (",pump\n", ",pmup\n", "running = 'pmup': must be of pump, valve, pitch_drive, steering, with + between them"),
        (",pump+valve\n", ",pump+pump\n", "running = 'pump+pump': must be of"),
        ("\n0.", "\nx0.", "must be a number between -16 and 16"),
        ("\n0.", "\n90.", "must be a number between -16 and 16"),
        ("\n0.", "\nnan0.", "must be a number"),
    ],
)
def test_wrong_samples_are_refused_by_line(stommel: Command, tmp_path: Path, old: str, new: str, words: str) -> None:
    samples, text = tmp_path / "samples.csv", samples_text(NOISY, np.random.default_rng(7))
    assert old in text
    samples.write_text(text.replace(old, new))
    done = stommel("vehicle", "calibrate-compass", str(samples))
    assert (done.status, done.out) == (2, "")
    assert all(line.startswith(f"error: {samples}: ") for line in done.err.splitlines())
    assert words in done.err
    assert len(done.err.splitlines()) <= 21


def test_a_poor_calibration_is_refused_by_the_command(stommel: Command, tmp_path: Path) -> None:
    samples, output = tmp_path / "samples.csv", tmp_path / "compass.toml"
    samples.write_text("\n".join(samples_text(NOISY, np.random.default_rng(7)).split("\n")[:15]) + "\n")
    done = stommel("vehicle", "calibrate-compass", str(samples), "--output", str(output))
    assert done.status == 2
    assert done.err == f"error: {samples}: 14 usable samples: at least 24 are needed\n"
    assert not output.exists()


def calibration_file(tmp_path: Path) -> Path:
    fit = fit_iron(*NOISY.turned_about(200, np.random.default_rng(8))[:2])
    field, running = at_the_surface(NOISY, [PUMP], np.random.default_rng(8))
    path = tmp_path / "compass.toml"
    path.write_text(calibration_text(fit, learn(field, running), "zju", "2026-07-01"))
    return path


def test_what_is_written_is_read_back(tmp_path: Path) -> None:
    fit = fit_iron(*NOISY.turned_about(200, np.random.default_rng(8))[:2])
    found = read_calibration(calibration_file(tmp_path))
    np.testing.assert_allclose(found.hard_iron, fit.hard_iron, atol=1e-4)
    np.testing.assert_allclose(found.correction, fit.correction, atol=1e-7)
    assert found.strength == pytest.approx((0.75 * fit.strength_ut, 1.25 * fit.strength_ut), abs=0.1)
    assert found.pump is not None
    assert (found.valve, found.steering) == (None, None)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('kind = "compass calibration"', 'kind = "compass"', "kind = 'compass': must be 'compass calibration'"),
        ("hard_iron_ut = [", "hard_iron_ut = [1e9, ", "hard_iron_ut"),
        ("hard_iron_ut = [", "hard_iron = [", "hard_iron: unknown key"),
        ("strength_ut = ", "strength_ut = 1e4 #", "strength_ut = 10000.0: must be between 5 and 200"),
        ("pump = [", "pumps = [", "pumps: unknown key in [actuator_ut]; did you mean pump"),
        ("believed_ut = [", "believed_ut = [99.0, 1.0] #", "first number must be less"),
    ],
)
def test_damaged_calibrations_are_refused(tmp_path: Path, old: str, new: str, words: str) -> None:
    path = calibration_file(tmp_path)
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))
    with pytest.raises(FileError, match=r"compass\.toml: ") as refused:
        read_calibration(path)
    assert words in str(refused.value)


def test_a_correction_that_flattens_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "compass.toml"
    lines = 'format = 1\nkind = "compass calibration"\nhard_iron_ut = [1.0, 2.0, 3.0]\n'
    path.write_text(lines)
    assert read_calibration(path).hard_iron == (1.0, 2.0, 3.0)
    path.write_text(lines + "correction = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]\n")
    with pytest.raises(FileError, match=r"correction: its determinant is 0; must be between 0.05 and 20"):
        read_calibration(path)


def test_no_calibration_changes_nothing() -> None:
    assert CompassCalibration().field_of(0) == ((0.0, 0.0, 0.0), 0)
    assert CompassCalibration().field_of(PUMP | VALVE) == ((0.0, 0.0, 0.0), PUMP | VALVE)
