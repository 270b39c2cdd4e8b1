"""Errors of the sensors, each alone; oracles: closed forms of a compass's deviation, scipy's rotations, statistics."""

from collections.abc import Callable
from math import asin, atan2, cos, degrees, inf, radians, sin
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

from stommel.geometry.attitude import quaternion_from_euler
from stommel.simulation.plant.sensing import (
    altimeter,
    compass,
    depth_sensor,
    disturbing_field,
    feel_temperature,
    fix,
    late,
    listen,
)
from stommel.simulation.plant.sensors import Sensors, sensors_of
from stommel.simulation.plant.world import new_world
from stommel.simulation.results.ctd import samples_of
from stommel.simulation.scenario.scenario_file import LONGEST_LATENCY
from tests.simulation.conftest import EXACT, Document, flown, made, mission_document

Array = np.ndarray
MANY = 20_000
HEADINGS = np.radians(np.arange(0.0, 360.0, 15.0))
DIP = radians(60.0)


def sensors(**keys: Any) -> Sensors:
    """As the keys of [sensors] say; exact otherwise."""
    return sensors_of(made(mission_document(sensors=EXACT | keys)).scenario)


def heading(told: Sensors, psi: float, theta: float = 0.0, phi: float = 0.0, running: str | None = None) -> float:
    """Heading that the compass tells [rad]."""
    world = new_world()
    if running is not None:
        world[running] = 1
    Q = quaternion_from_euler(phi, theta, psi)
    return compass(told, world, Q, np.random.default_rng(0)).psi


def turned(angle: float) -> float:
    return atan2(sin(angle), cos(angle))


def spread_is(errors: Array, sigma: float) -> None:
    """No bias and this standard deviation, within 4.9 standard errors each; both are drawn from a fixed seed."""
    n = len(errors)
    assert abs(np.mean(errors)) < 4.9 * sigma / np.sqrt(n)
    low, high = (float(chi2.ppf(share, n - 1)) for share in (1e-6, 1.0 - 1e-6))
    assert low < np.sum((errors - np.mean(errors)) ** 2) / sigma**2 < high


def by_hand(psi: float, theta: float, phi: float, hard: Array, soft: Array, declination: float) -> float:
    """Magnetic heading of a distorted field by scipy's rotations: its horizontal part in the vehicle's own axes."""
    north = np.array([cos(DIP) * cos(declination), cos(DIP) * sin(declination), sin(DIP)])
    to_earth = Rotation.from_euler("ZYX", [psi, theta, phi])
    felt = soft @ to_earth.inv().apply(north) + hard
    levelled = Rotation.from_euler("YX", [theta, phi]).apply(felt)
    return atan2(-levelled[1], levelled[0])


@pytest.mark.parametrize("iron", [(0.1, 0.0, 0.0), (0.0, 0.1, 0.0), (-0.05, 0.08, 0.3)])
def test_hard_iron_turns_a_level_compass_by_a_semicircle(iron: tuple[float, float, float]) -> None:
    """tan(magnetic heading) = (H sin(psi) - h_y) / (H cos(psi) + h_x): once round in a full turn, none of h_z."""
    told = sensors(hard_iron=list(iron), magnetic_inclination_deg=degrees(DIP))
    H = cos(DIP)
    for psi in HEADINGS:
        expected = atan2(H * sin(psi) - iron[1], H * cos(psi) + iron[0])
        assert turned(heading(told, psi) - expected) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(("stretch", "turn"), [(0.1, 0.0), (-0.06, 0.0), (0.0, 0.04)])
def test_soft_iron_turns_a_level_compass_by_a_quadrant(stretch: float, turn: float) -> None:
    """Twice round in a full turn: S of the field alone, [[1 + e, f], [g, 1 - e]] on (cos(psi), -sin(psi))."""
    told = sensors(
        soft_iron=[[1.0 + stretch, turn, 0.0], [2.0 * turn, 1.0 - stretch, 0.0], [0.0, 0.0, 1.0]],
        magnetic_inclination_deg=degrees(DIP),
    )
    for psi in HEADINGS:
        ahead = (1.0 + stretch) * cos(psi) - turn * sin(psi)
        right = 2.0 * turn * cos(psi) - (1.0 - stretch) * sin(psi)
        assert turned(heading(told, psi) - atan2(-right, ahead)) == pytest.approx(0.0, abs=1e-12)


def test_soft_iron_does_not_distort_the_hard_iron() -> None:
    """Iron that doubles the field ahead: a magnet ahead turns half of what it would turn alone, not the same."""
    H = cos(DIP)
    told = sensors(
        hard_iron=[0.1, 0.0, 0.0],
        soft_iron=[[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]],
        magnetic_inclination_deg=degrees(DIP),
    )
    for psi in HEADINGS:
        expected = atan2(2.0 * H * sin(psi), 2.0 * H * cos(psi) + 0.1)
        assert turned(heading(told, psi) - expected) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("theta", [radians(-35.0), radians(20.0)])
@pytest.mark.parametrize("phi", [0.0, radians(-12.0)])
def test_iron_of_a_tilted_vehicle(theta: float, phi: float) -> None:
    hard, soft = np.array([0.05, -0.03, 0.08]), np.array([[1.02, 0.01, -0.03], [0.0, 0.97, 0.02], [0.04, 0.0, 1.05]])
    told = sensors(
        hard_iron=hard.tolist(), soft_iron=soft.tolist(), magnetic_inclination_deg=degrees(DIP),
        magnetic_declination_deg=7.0,
    )  # fmt: skip
    for psi in HEADINGS:
        expected = by_hand(psi, theta, phi, hard, soft, radians(7.0)) + radians(7.0)
        assert turned(heading(told, psi, theta, phi) - expected) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("theta", [0.0, radians(-35.0)])
@pytest.mark.parametrize(("true", "known", "error"), [(8.0, None, 0.0), (8.0, 5.0, -3.0), (-12.0, 0.0, 12.0)])
def test_declination_that_is_not_known_is_an_error_of_heading(
    theta: float, true: float, known: float | None, error: float
) -> None:
    """East positive: a needle that points 8 deg east of north, corrected by 5, tells 3 deg too little."""
    keys: Document = {"magnetic_declination_deg": true} | ({} if known is None else {"known_declination_deg": known})
    told = sensors(**keys)
    for psi in HEADINGS:
        assert degrees(turned(heading(told, psi, theta) - psi)) == pytest.approx(error, abs=1e-9)


@pytest.mark.parametrize(
    ("key", "running"),
    [("pump_field", "pumping"), ("valve_field", "valve_open"), ("pitch_drive_field", "mass_moving"),
     ("steering_field", "steering_moving")],
)  # fmt: skip
def test_each_motor_disturbs_while_it_runs_and_shielding_takes_its_share(key: str, running: str) -> None:
    told = sensors(**{key: [0.0, 0.2, 0.0]}, shielding=0.75)
    H = cos(radians(45.0))
    assert degrees(heading(told, 0.0, running=running)) == pytest.approx(degrees(atan2(-0.05, H)), abs=1e-9)
    for other in {"pumping", "valve_open", "mass_moving", "steering_moving"} - {running}:
        assert heading(told, 0.0, running=other) == pytest.approx(0.0, abs=1e-12)


def test_fields_of_motors_that_run_together_add_up() -> None:
    told, world = sensors(pump_field=[0.1, 0.0, 0.0], steering_field=[0.0, 0.2, 0.0], shielding=0.5), new_world()
    world.pumping = world.steering_moving = 1
    assert disturbing_field(told, world) == pytest.approx((0.05, 0.1, 0.0))


def felt(told: Sensors, theta: float, phi: float) -> Array:
    """Pitch, heading, down along b2 and b3, many times."""
    noise, world, Q = np.random.default_rng(1), new_world(), quaternion_from_euler(phi, theta, 0.7)
    found = [compass(told, world, Q, noise) for _ in range(MANY)]
    return np.array([[one.theta, one.psi, one.down_b2, one.down_b3] for one in found])


def test_heading_noise_is_its_own() -> None:
    found = felt(sensors(heading_noise_deg=0.8), radians(-30.0), 0.0)
    spread_is(found[:, 1] - 0.7, radians(0.8))
    assert np.ptp(found[:, 0]) < 1e-12


def test_attitude_noise_is_of_the_direction_down() -> None:
    """Each axis alike: pitch errs by it, roll by it over cos(pitch), and the heading follows."""
    found = felt(sensors(attitude_noise_deg=0.1), radians(-40.0), 0.0)
    spread_is(found[:, 0] - radians(-40.0), radians(0.1))
    spread_is(np.arctan2(found[:, 2], found[:, 3]), radians(0.1) / cos(radians(40.0)))
    assert np.std(found[:, 1]) > radians(0.05)


def test_pressure_sensor_has_its_noise_and_bias() -> None:
    told, noise = sensors(pressure_noise_m=0.3, pressure_bias_m=-2.5), np.random.default_rng(2)
    spread_is(np.array([depth_sensor(told, 40.0, noise) for _ in range(MANY)]) - 37.5, 0.3)


def test_altimeter_has_its_noise_within_its_range_and_hears_nothing_beyond() -> None:
    told, noise = sensors(altimeter_noise_m=0.4, altimeter_range_m=30.0), np.random.default_rng(3)
    spread_is(np.array([altimeter(told, 12.0, noise) for _ in range(MANY)]) - 12.0, 0.4)
    assert altimeter(told, 29.999, noise) < inf
    assert altimeter(told, 30.0, noise) == inf
    assert altimeter(sensors(altimeter_range_m=0.0), 0.0, noise) == inf


@pytest.mark.parametrize("latitude", [0.0, 60.0, -75.0])
def test_positions_err_alike_north_and_east(latitude: float) -> None:
    """Metres by WGS 84's radii of curvature: at 60 deg north a degree of longitude is half as long."""
    told, noise, world = sensors(gps_noise_m=4.0, first_fix_s=1.0), np.random.default_rng(4), new_world()
    world.latitude, world.longitude = radians(latitude), radians(20.0)
    places = []
    for t in range(MANY):
        listen(told, world, True, True, float(t), 1.0, noise)
        assert (world.fixed, world.fix_time) == (1, float(t))
        places.append((world.fix_latitude, world.fix_longitude))
    a, e2 = 6378137.0, 6.69437999014e-3
    W = np.sqrt(1.0 - e2 * sin(radians(latitude)) ** 2)
    north, east = a * (1.0 - e2) / W**3, a / W * cos(radians(latitude))
    errors = (np.array(places) - [radians(latitude), radians(20.0)]) * [north, east]
    spread_is(errors[:, 0], 4.0)
    spread_is(errors[:, 1], 4.0)
    assert abs(np.corrcoef(errors.T)[0, 1]) < 4.9 / np.sqrt(MANY)


def test_noise_of_a_position_over_metres_per_radian() -> None:
    found = fix(sensors(gps_noise_m=2.0), 0.5, -1.0, (100.0, 50.0), np.random.default_rng(9))
    draws = np.random.default_rng(9).standard_normal(2)
    assert found == pytest.approx((0.5 + 0.02 * draws[0], -1.0 + 0.04 * draws[1]))


def test_receiver_needs_its_time_with_a_dry_antenna() -> None:
    """20 s wet in between do not count, nor do they begin it anew; switched off it begins anew."""
    told, noise, world = sensors(first_fix_s=30.0), np.random.default_rng(5), new_world()

    def fixes(first: int, last: int, radio: bool = True, dry: bool = True) -> list[int]:
        heard = []
        for t in range(first, last):
            world.fixed = 0
            listen(told, world, radio, dry, float(t), 1.0, noise)
            heard += [t] * int(world.fixed)
        return heard

    assert fixes(0, 20) == []
    assert fixes(20, 40, dry=False) == []
    assert fixes(40, 60) == list(range(49, 60))
    assert fixes(60, 61, radio=False) == []
    assert fixes(61, 100) == list(range(90, 100))


def test_latency_is_of_each_sensor_s_own() -> None:
    """What went in two steps ago comes out as attitude, five steps ago as depth; the ring of memory comes round."""
    told, world = sensors(attitude_latency_s=2.0, pressure_latency_s=5.0), new_world()
    noise = np.random.default_rng(0)
    for tick in range(3 * LONGEST_LATENCY):
        now = compass(told, world, quaternion_from_euler(0.0, -1e-4 * tick, 2e-4 * tick), noise)
        heard, depth = late(told, world, tick, now, float(tick))
        if tick >= 5:
            assert heard.theta == pytest.approx(-1e-4 * (tick - 2), abs=1e-12)
            assert heard.psi == pytest.approx(2e-4 * (tick - 2), abs=1e-9)
            assert heard.down_b3 == pytest.approx(cos(1e-4 * (tick - 2)), abs=1e-12)
            assert depth == tick - 5.0


@pytest.mark.parametrize(("lag", "share", "cell_lag"), [(3.0, 0.04, 8.0), (0.0, 0.1, 1.0)])
def test_thermistor_and_cell_follow_a_step(lag: float, share: float, cell_lag: float) -> None:
    """A change of 10 deg C within one second: what is left of it then falls as exp(-t / tau), exactly."""
    ctd = {"temperature_lag_s": lag, "cell_share": share, "cell_lag_s": cell_lag}
    told, world = sensors_of(made(mission_document(ctd=ctd)).scenario), new_world()
    world.thermistor = world.water_before = 20.0
    behind = lag * (1.0 - np.exp(-1.0 / lag)) * 10.0 if lag > 0.0 else 0.0
    walls = share * cell_lag * (1.0 - np.exp(-1.0 / cell_lag)) * 10.0
    for second in range(12):
        feel_temperature(told, world, 30.0)
        left = np.exp(-second / lag) if lag > 0.0 else 0.0
        assert 30.0 - world.thermistor == pytest.approx(behind * left, abs=1e-12)
        assert world.cell_error == pytest.approx(walls * np.exp(-second / cell_lag))


NOISY: Document = {"temperature_noise_c": 0.02, "conductivity_noise_s_m": 0.003, "pressure_noise_dbar": 0.5}


def test_noise_of_the_ctd_comes_from_the_mission_s_seed() -> None:
    """Twice the same from one seed, another from another, whatever was drawn before; the water is the same."""
    short: dict[str, Any] = {"sensors": EXACT, "duration_days": 0.03, "sampling": {"every_s": 2.0}}
    np.random.seed(1)
    one = samples_of(flown(ctd=NOISY, seed=5, **short))
    np.random.seed(2)
    again, other = (samples_of(flown(ctd=NOISY, seed=seed, **short)) for seed in (5, 6))
    quiet = samples_of(flown(ctd=dict.fromkeys(NOISY, 0.0), seed=5, **short))
    n = len(quiet.pressure)
    assert n > 500
    keys = (("pressure", 0.5), ("temperature", 0.02), ("conductivity", 0.003))
    errors = {name: getattr(one, name) - getattr(quiet, name) for name, _ in keys}
    for name, sigma in keys:
        np.testing.assert_array_equal(getattr(again, name), getattr(one, name))
        theirs = getattr(other, name) - getattr(quiet, name)
        spread_is(errors[name], sigma)
        spread_is(theirs, sigma)
        assert abs(np.corrcoef(errors[name], theirs)[0, 1]) < 4.9 / np.sqrt(n)
    pairs = np.corrcoef(np.array(list(errors.values())))
    assert np.abs(pairs - np.eye(3)).max() < 4.9 / np.sqrt(n)


@pytest.mark.parametrize(
    ("column", "noise", "bias", "sigma", "offset"),
    [
        ("voltage", "voltage_noise_v", "voltage_bias_v", 0.05, -0.3),
        ("current", "current_noise_a", "current_bias_a", 0.02, 0.1),
        ("internal_pressure", "internal_pressure_noise_pa", "internal_pressure_bias_pa", 35.0, 500.0),
    ],
)
def test_what_the_vehicle_measures_of_itself_errs(
    column: str, noise: str, bias: str, sigma: float, offset: float
) -> None:
    """Against the same mission without; none of them changes how it flies."""
    fly: Callable[..., Any] = lambda **keys: flown(sensors=EXACT | keys, duration_days=0.05, output_every_s=1.0)  # noqa: E731
    errors = fly(**{noise: sigma, bias: offset}).record[column] - fly().record[column]
    spread_is(np.asarray(errors) - offset, sigma)


def test_pitch_that_is_told_is_the_one_of_gravity() -> None:
    """By the components of down in the body: asin(-down_1), whatever the roll and heading."""
    told, noise = sensors(), np.random.default_rng(0)
    for theta in np.radians([-60.0, -20.0, 0.0, 35.0]):
        for phi in np.radians([-25.0, 0.0, 10.0]):
            found = compass(told, new_world(), quaternion_from_euler(phi, theta, 1.0), noise)
            down = Rotation.from_euler("ZYX", [1.0, theta, phi]).inv().apply([0.0, 0.0, 1.0])
            assert found.theta == pytest.approx(asin(-down[0]), abs=1e-12)
            assert (found.down_b2, found.down_b3) == pytest.approx((down[1], down[2]), abs=1e-12)
