"""Oracles: round trips between wanted flights and settings, closed forms, and long integration from the equilibrium."""

from math import atan, degrees, pi, radians, sqrt

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import stommel
from stommel.analysis import RequestError, SteadyFlight
from stommel.analysis.limits import Reason
from stommel.dynamics.acceleration import state_of, velocities_of
from stommel.dynamics.equations import state_from_array
from stommel.dynamics.integration import integrate
from stommel.dynamics.packing import pack, reference_water
from stommel.dynamics.state import STATE_SIZE, Actuation
from stommel.geometry.attitude import quaternion_from_euler
from stommel.vehicle import LateralPlaneUnknownError, builtin_text, vehicle_from_text


def fly(vehicle: stommel.Vehicle, flight: SteadyFlight, seconds: float) -> tuple[np.ndarray, np.ndarray]:
    """Velocities at the start and after `seconds` of flight with the settings of `flight`."""
    record, water = pack(vehicle, stommel.PAPER), reference_water(vehicle)
    actuation = Actuation(delta_r=flight.delta_r, mu=flight.mu)
    Q = quaternion_from_euler(flight.phi, flight.theta, 0.0)
    e0, e1, e2, e3 = Q
    zeta = np.array([2 * (e1 * e3 - e0 * e2), 2 * (e2 * e3 + e0 * e1), 1 - 2 * (e1 * e1 + e2 * e2)])
    omega = tuple(float(w) for w in flight.turn_rate * zeta)
    v = tuple(float(w) for w in flight.velocity)
    start = state_of(record, v, omega, (0.0, 0.0, 0.0), Q, flight.r_px, flight.V_b, actuation, water)
    x = np.array([*start.X, *start.Q, *start.p, *start.h, start.r_px, start.p_px, start.V_b])
    integrate(record, x, actuation, water, False, 0.05, round(seconds / 0.05), np.empty((0, STATE_SIZE)))
    eta = velocities_of(record, state_from_array(x), actuation, water, False)
    return np.array([*v, *omega]), np.array([*eta.v, *eta.omega])


@pytest.mark.parametrize("pitch", [-60.0, -35.0, -10.0, 20.0, 50.0])
def test_wings_level_flight_stays_where_it_is_for_1000_s(pitch: float) -> None:
    zju = stommel.load_vehicle("zju")
    flight = stommel.trim(zju, speed_m_s=0.4, pitch_deg=pitch, within_limits=False)
    before, after = fly(zju, flight, 1000.0)
    assert np.abs(after - before).max() < 1e-6


@pytest.mark.parametrize(
    ("name", "request_"),
    [
        ("zju", {"moving_mass_mm": 408.2, "ballast_ml": -55.8, "rudder_deg": 5.0}),
        ("zju", {"moving_mass_mm": 92.0, "ballast_ml": 120.0, "rudder_deg": -8.0}),
        ("seawing", {"moving_mass_mm": 421.67, "ballast_ml": -292.7, "roll_mass_deg": 45.0}),
        ("seawing", {"moving_mass_mm": 421.67, "ballast_ml": -292.7, "roll_mass_deg": -90.0}),
    ],
)
def test_turning_flight_stays_where_it_is_for_1000_s(name: str, request_: dict[str, float]) -> None:
    vehicle = stommel.load_vehicle(name)
    flight = stommel.steady_flight(vehicle, **request_)
    assert flight.residual < 1e-10
    assert flight.turn_rate != 0.0
    before, after = fly(vehicle, flight, 1000.0)
    assert np.abs(after - before).max() < 1e-6


def test_sea_wing_spiral() -> None:
    """Zhang et al. (2013): 20 mm forward, 0.3 kg and 45 deg of battery roll give a spiral of about 100 m radius.

    The sign convention of the source turns to starboard for a positive battery angle with negative (port) roll.
    """
    flight = stommel.steady_flight(
        stommel.load_vehicle("seawing"), moving_mass_mm=421.67, ballast_ml=-292.7, roll_mass_deg=45.0
    )
    assert flight.radius == pytest.approx(100.0, rel=0.05)
    assert flight.turn_rate > 0.0
    assert flight.phi < 0.0


def test_port_and_starboard_spirals_mirror() -> None:
    seawing = stommel.load_vehicle("seawing")
    one, other = (
        stommel.steady_flight(seawing, moving_mass_mm=421.67, ballast_ml=-292.7, roll_mass_deg=sign * 45.0)
        for sign in (1, -1)
    )
    assert (other.phi, other.beta, other.turn_rate) == pytest.approx((-one.phi, -one.beta, -one.turn_rate), rel=1e-12)
    assert (other.V, other.alpha, other.theta) == pytest.approx((one.V, one.alpha, one.theta), rel=1e-12)


@settings(deadline=None, max_examples=60)
@given(
    speed=st.floats(0.1, 0.9),
    pitch=st.one_of(st.floats(-60.0, -5.0), st.floats(5.0, 60.0)),
)
def test_settings_give_back_the_flight(speed: float, pitch: float) -> None:
    zju = stommel.load_vehicle("zju")
    wanted = stommel.trim(zju, speed_m_s=speed, pitch_deg=pitch, within_limits=False)
    found = stommel.steady_flight(
        zju, moving_mass_mm=wanted.r_px * 1e3, ballast_ml=wanted.V_b * 1e6, within_limits=False
    )
    assert pytest.approx(speed, rel=1e-9) == found.V
    assert degrees(found.theta) == pytest.approx(pitch, rel=1e-9)


@settings(deadline=None, max_examples=40)
@given(rudder=st.floats(-12.0, 12.0), pitch=st.floats(-36.0, -25.0), ballast=st.floats(-240.0, -40.0))
def test_turns_both_ways(rudder: float, pitch: float, ballast: float) -> None:
    """Settings -> turn -> the same settings, by turn rate and by radius.

    Pitches where the vehicle answers its rudder as one expects: steeper than about -39 deg the spiral diverges and the
    steady turn of a given rudder is the other, unstable one (see test_modes.py).
    """
    assume(abs(rudder) > 0.1)
    zju = stommel.load_vehicle("zju")
    speed = 0.4 * sqrt(abs(ballast) / 56.0)
    level = stommel.trim(zju, speed_m_s=speed, pitch_deg=pitch, within_limits=False)
    flown = stommel.steady_flight(
        zju,
        moving_mass_mm=level.r_px * 1e3,
        ballast_ml=level.V_b * 1e6,
        rudder_deg=rudder,
        within_limits=False,
    )
    assert np.sign(flown.turn_rate) == np.sign(rudder)
    for wish in ({"turn_rate_rad_s": flown.turn_rate}, {"radius_m": flown.radius * np.sign(flown.turn_rate)}):
        again = stommel.turn(zju, speed_m_s=flown.V, pitch_deg=degrees(flown.theta), within_limits=False, **wish)
        assert degrees(again.delta_r) == pytest.approx(rudder, rel=1e-6)
        assert again.r_px == pytest.approx(level.r_px, rel=1e-8)
        assert again.V_b == pytest.approx(level.V_b, rel=1e-8)
        assert again.residual < 1e-10


def test_glide_path_closed_form() -> None:
    """In the paper's model D(alpha) + L(alpha) tan(gamma) = 0, and the net weight balances both."""
    zju = stommel.load_vehicle("zju")
    flight = stommel.trim(zju, speed_m_s=0.4, glide_path_deg=-30.0)
    D, L = 2 + 45 * flight.alpha**2, 135 * flight.alpha
    assert D + L * np.tan(radians(-30.0)) == pytest.approx(0.0, abs=1e-12)
    assert -1000 * 9.81 * flight.V_b == pytest.approx(np.hypot(D, L) * 0.4**2, rel=1e-12)


def test_best_glide_closed_form() -> None:
    """The greatest lift-to-drag ratio is K_L / (2 sqrt(K_D0 K_D)), at alpha = sqrt(K_D0 / K_D)."""
    best = stommel.best_conditions(stommel.load_vehicle("zju"), ballast_ml=-250.0).best_glide
    assert best.glide_ratio == pytest.approx(135 / (2 * sqrt(2 * 45)), rel=1e-9)
    assert best.alpha == pytest.approx(sqrt(2 / 45), rel=1e-4)  # flat optimum
    assert best.gamma == pytest.approx(-atan(2 * sqrt(2 * 45) / 135), rel=1e-9)


def test_fastest_flight_against_a_dense_table() -> None:
    """Greatest horizontal speed near -35 deg, as the paper takes from Graver (2005), against 20 001 flights."""
    zju = stommel.load_vehicle("zju")
    fastest = stommel.best_conditions(zju, ballast_ml=-250.0).fastest
    assert degrees(fastest.theta) == pytest.approx(-35.0, abs=1.0)
    speeds = []
    for alpha in np.linspace(0.002, 0.2, 20001):
        D, L = 2 + 45 * alpha**2, 135 * alpha
        V = sqrt(1000 * 9.81 * 250e-6 / np.hypot(D, L))
        speeds.append(V * L / np.hypot(D, L))
    assert fastest.horizontal_speed == pytest.approx(max(speeds), rel=1e-8)


class TestUnreachable:
    """A flight out of reach says why, and names a flight that can be had."""

    @pytest.mark.parametrize(
        ("request_", "reason"),
        [
            ({"speed_m_s": 1.5, "pitch_deg": -35.0}, Reason.VOLUME),
            ({"speed_m_s": 0.4, "pitch_deg": -60.0}, Reason.TRAVEL),
            ({"speed_m_s": 0.4, "glide_path_deg": -3.0}, Reason.SHALLOW),
            ({"speed_m_s": 0.05, "pitch_deg": 12.0, "glide_path_deg": None}, None),
        ],
    )
    def test_reason_and_nearest(self, request_: dict[str, float], reason: Reason | None) -> None:
        zju = stommel.load_vehicle("zju")
        if reason is None:
            stommel.trim(zju, **request_)  # reachable: nothing is refused for its own sake
            return
        with pytest.raises(stommel.UnreachableFlightError) as caught:
            stommel.trim(zju, **request_)
        assert reason in caught.value.reasons
        nearest = caught.value.nearest
        assert nearest is not None
        again = stommel.trim(zju, speed_m_s=nearest.V, pitch_deg=degrees(nearest.theta))
        assert again.V_b == pytest.approx(nearest.V_b, rel=1e-9)

    def test_stall(self) -> None:
        """Without actuator limits only the stall remains; a path this shallow needs 15.6 deg of incidence."""
        text = builtin_text("slocum").replace("drag_per_rad2_kg_m = 25", "drag_per_rad2_kg_m = 5")
        with pytest.raises(stommel.UnreachableFlightError) as caught:
            stommel.trim(vehicle_from_text(text, "stall.toml"), speed_m_s=0.1, glide_path_deg=-4.0)
        assert caught.value.reasons == (Reason.STALL,)

    def test_nearest_is_nearest(self) -> None:
        """No reachable flight of a fine independent grid is nearer (0.1 m/s counts as 5 deg)."""
        zju = stommel.load_vehicle("zju")
        with pytest.raises(stommel.UnreachableFlightError) as caught:
            stommel.trim(zju, speed_m_s=1.2, pitch_deg=-30.0)
        nearest = caught.value.nearest
        assert nearest is not None

        def distance(V: float, theta_deg: float) -> float:
            return float(np.hypot((V - 1.2) / 0.1, (theta_deg + 30.0) / 5.0))

        best = distance(nearest.V, degrees(nearest.theta))
        for row in stommel.flight_envelope(zju, pitches_deg=np.arange(-60.0, -5.0, 0.25)):
            if row.fastest is not None:
                assert distance(row.fastest.V, row.pitch_deg) > best - 1e-3

    def test_tighter_than_any_turn(self) -> None:
        with pytest.raises(stommel.UnreachableFlightError, match="nearest reachable: turn rate"):
            stommel.turn(stommel.load_vehicle("zju"), speed_m_s=0.4, pitch_deg=-35.0, radius_m=1.0)


class TestRefused:
    """Impossible questions are refused before anything is computed."""

    @pytest.mark.parametrize("pitch", [90.0, -90.0, 120.0, float("nan")])
    def test_straight_up_or_down(self, pitch: float) -> None:
        with pytest.raises(RequestError, match="between -90 and 90"):
            stommel.trim(stommel.load_vehicle("zju"), speed_m_s=0.4, pitch_deg=pitch)

    @pytest.mark.parametrize("speed", [0.0, -0.4, 11.0, float("nan"), float("inf")])
    def test_speed(self, speed: float) -> None:
        with pytest.raises(RequestError, match="greater than 0"):
            stommel.trim(stommel.load_vehicle("zju"), speed_m_s=speed, pitch_deg=-35.0)

    def test_unknown_lateral_plane(self) -> None:
        rogue = stommel.load_vehicle("rogue")
        with pytest.raises(LateralPlaneUnknownError, match="sway_kg"):
            stommel.turn(rogue, speed_m_s=0.3, pitch_deg=-25.0, turn_rate_rad_s=0.01)
        with pytest.raises(LateralPlaneUnknownError, match="yaw_damping"):
            stommel.steady_flight(rogue, moving_mass_mm=4.1, ballast_ml=-354.0, rudder_deg=2.0)

    def test_no_such_actuator(self) -> None:
        with pytest.raises(RequestError, match="no rudder"):
            stommel.steady_flight(
                stommel.load_vehicle("seawing"), moving_mass_mm=420.0, ballast_ml=-300.0, rudder_deg=5.0
            )
        with pytest.raises(RequestError, match="offset_m is 0"):
            stommel.steady_flight(
                stommel.load_vehicle("zju"), moving_mass_mm=408.0, ballast_ml=-55.0, roll_mass_deg=5.0
            )

    def test_neutral_vehicle_drifts(self) -> None:
        with pytest.raises(stommel.UnreachableFlightError, match="drifts"):
            stommel.steady_flight(stommel.load_vehicle("zju"), moving_mass_mm=408.0, ballast_ml=0.0)


def test_full_turn_closes_on_itself() -> None:
    """Flown for 2 pi / turn rate the vehicle is back over its start: the radius is that of the circle on the ground."""
    zju = stommel.load_vehicle("zju")
    flight = stommel.steady_flight(zju, moving_mass_mm=408.2, ballast_ml=-55.8, rudder_deg=8.0)
    record, water = pack(zju, stommel.PAPER), reference_water(zju)
    actuation = Actuation(delta_r=flight.delta_r)
    Q = quaternion_from_euler(flight.phi, flight.theta, 0.0)
    e0, e1, e2, e3 = Q
    zeta = np.array([2 * (e1 * e3 - e0 * e2), 2 * (e2 * e3 + e0 * e1), 1 - 2 * (e1 * e1 + e2 * e2)])
    omega = tuple(float(w) for w in flight.turn_rate * zeta)
    start = state_of(record, flight.velocity, omega, (0.0, 0.0, 0.0), Q, flight.r_px, flight.V_b, actuation, water)
    x = np.array([*start.X, *start.Q, *start.p, *start.h, start.r_px, start.p_px, start.V_b])
    period, steps = 2 * pi / flight.turn_rate, 4000
    track = np.empty((steps // 2, STATE_SIZE))
    integrate(record, x, actuation, water, False, period / steps, steps, track)
    assert np.abs(x[:2]).max() < 1e-6
    assert x[2] == pytest.approx(flight.sinking_speed * period, rel=1e-8)
    centre = track[:, :2].mean(axis=0)
    assert np.hypot(*(track[:, :2] - centre).T) == pytest.approx(flight.radius, rel=1e-6)
