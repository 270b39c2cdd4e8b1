"""Oracles: python-control, central differences of nonlinear flight, and the trends of Figs. 3 and 4 of the paper."""

from math import degrees, radians

import control
import numpy as np
import pytest

import stommel
from stommel.analysis import linearise
from stommel.analysis.batch import trims_with_modes
from stommel.analysis.linearization import is_stable
from stommel.analysis.steady_equations import ALPHA, BETA, DELTA_R, MU, PHI, R_PX, THETA, V_B, V
from stommel.dynamics.acceleration import accelerations, state_of
from stommel.dynamics.packing import pack, reference_water
from stommel.dynamics.state import Actuation
from stommel.errors import FileError
from stommel.geometry.attitude import euler_rates, quaternion_from_euler


def nonlinear_rates(vehicle: stommel.Vehicle, s: np.ndarray, inputs: np.ndarray) -> np.ndarray:
    """Rates of (u, w, q, theta, v, p, r, phi) from the accelerations of the equations of motion."""
    u, w, q, theta, v, p, r, phi = (float(value) for value in s)
    record, water = pack(vehicle, stommel.PAPER), reference_water(vehicle)
    actuation = Actuation(delta_r=float(inputs[2]), mu=float(inputs[3]))
    Q = quaternion_from_euler(phi, theta, 0.0)
    x = state_of(record, (u, v, w), (p, q, r), (0.0, 0.0, 0.0), Q, float(inputs[0]), float(inputs[1]), actuation, water)
    a = accelerations(record, x, actuation, water, False)
    rates = euler_rates(phi, theta, (p, q, r))
    assert rates is not None
    return np.array(
        [a.v_dot[0], a.v_dot[2], a.omega_dot[1], rates[1], a.v_dot[1], a.omega_dot[0], a.omega_dot[2], rates[0]]
    )


@pytest.mark.parametrize("turning", [False, True])
def test_linear_model_against_central_differences(zju: stommel.Vehicle, turning: bool) -> None:
    """1e-6 relative to the largest entry of each column: the differences' own truncation and rounding."""
    flight = stommel.steady_flight(zju, moving_mass_mm=408.2, ballast_ml=-55.8, rudder_deg=6.0 if turning else 0.0)
    whole = linearise(zju, flight).whole
    z = flight.quantities()
    e0, e1, e2, e3 = quaternion_from_euler(z[PHI], z[THETA], 0.0)
    zeta = [2 * (e1 * e3 - e0 * e2), 2 * (e2 * e3 + e0 * e1), 1 - 2 * (e1 * e1 + e2 * e2)]
    p, q, r = (flight.turn_rate * component for component in zeta)
    s = np.array(
        [
            z[V] * np.cos(z[ALPHA]) * np.cos(z[BETA]),
            z[V] * np.sin(z[ALPHA]) * np.cos(z[BETA]),
            q,
            z[THETA],
            z[V] * np.sin(z[BETA]),
            p,
            r,
            z[PHI],
        ]
    )
    inputs = z[[R_PX, V_B, DELTA_R, MU]]
    assert np.abs(nonlinear_rates(zju, s, inputs)).max() < 1e-12
    for exact, base, step in ((whole.A, s, 1e-5), (whole.B, inputs, None)):
        for j in range(len(base)):
            h = step or (1e-5, 1e-9, 1e-5, 1e-5)[j]
            up, down = base.copy(), base.copy()
            up[j] += h
            down[j] -= h
            if exact is whole.A:
                difference = nonlinear_rates(zju, up, inputs) - nonlinear_rates(zju, down, inputs)
            else:
                difference = nonlinear_rates(zju, s, up) - nonlinear_rates(zju, s, down)
            column = difference / (2 * h)
            assert exact[:, j] == pytest.approx(column, abs=1e-6 * max(np.abs(column).max(), 1e-3))


def test_eigenvalues_against_python_control(zju: stommel.Vehicle) -> None:
    flight = stommel.trim(zju, speed_m_s=0.4, pitch_deg=-35.0)
    linear = linearise(zju, flight)
    assert linear.lateral is not None
    found = stommel.modes(linear)
    assert found.lateral is not None
    for model, named in ((linear.longitudinal, found.longitudinal), (linear.lateral, found.lateral)):
        space = model.to_control()
        assert isinstance(space, control.StateSpace)
        poles = np.sort_complex(space.poles())
        ours = np.sort_complex(np.array([mode.eigenvalue for mode in named]))
        assert ours == pytest.approx(poles, rel=1e-6)
        _, zeta, _ = control.damp(space, doprint=False)
        assert sorted(mode.damping_ratio for mode in named) == pytest.approx(sorted(zeta), rel=1e-6)


def test_names_and_times(zju: stommel.Vehicle) -> None:
    found = stommel.modes(linearise(zju, stommel.trim(zju, speed_m_s=0.4, pitch_deg=-35.0)))
    assert [mode.name for mode in found.longitudinal] == [
        "short period",
        "short period",
        "heave subsidence",
        "surge subsidence",
    ]
    assert found.lateral is not None
    assert [mode.name for mode in found.lateral] == [
        "roll oscillation",
        "roll oscillation",
        "yaw subsidence",
        "spiral",
    ]
    assert found.stable
    for mode in (*found.longitudinal, *found.lateral):
        # e^(Re t) is one half after the time to half
        assert np.exp(mode.eigenvalue.real * mode.time_to_half) == pytest.approx(0.5, rel=1e-12)
        assert sum(mode.participation.values()) == pytest.approx(1.0, rel=1e-12)


def test_wings_level_planes_separate(zju: stommel.Vehicle) -> None:
    """Section 3.2: the linearised equations decompose into longitudinal and lateral-directional components."""
    level = linearise(zju, stommel.trim(zju, speed_m_s=0.4, pitch_deg=-35.0))
    turn = linearise(zju, stommel.steady_flight(zju, moving_mass_mm=408.2, ballast_ml=-55.8, rudder_deg=6.0))
    assert level.coupling < 1e-15
    assert turn.coupling > 1e-3


def test_fig_3_wing_aft_damps_longitudinal_oscillations(zju: stommel.Vehicle) -> None:
    locus = stommel.root_locus(zju, "wing_position", 0.0, 0.2, points=41)
    oscillatory = np.abs(locus.longitudinal[0].imag) > 0
    assert oscillatory.any()
    damping = -locus.longitudinal[:, oscillatory].real
    ratio = damping / np.abs(locus.longitudinal[:, oscillatory])
    assert (np.diff(damping, axis=0) > 0).all()
    assert (np.diff(ratio, axis=0) > 0).all()
    assert (locus.longitudinal.real < 0).all()


def test_fig_4_rudder_aft_stabilises_every_lateral_mode(zju: stommel.Vehicle) -> None:
    locus = stommel.root_locus(zju, "rudder_position", 0.5, 1.0, points=41)
    assert locus.lateral is not None
    assert (locus.lateral.real < 0).all()
    # from end to end every mode gains; on the way the oscillation and the slowest mode gain at every step
    assert (locus.lateral.real[-1] < locus.lateral.real[0]).all()
    oscillatory = np.abs(locus.lateral[0].imag) > 0
    slowest = np.abs(locus.lateral[0]).argmin()
    assert (np.diff(locus.lateral[:, oscillatory].real, axis=0) < 0).all()
    assert (np.diff(locus.lateral[:, slowest].real) < 0).all()
    # the exception: the yaw subsidence first gives away less than a hundredth of itself to the spiral
    assert locus.lateral.real.max(axis=0) == pytest.approx(locus.lateral.real[0], rel=0.01)


def test_section_3_2_authority_falls_as_stability_grows(zju: stommel.Vehicle) -> None:
    """A rudder farther aft turns the vehicle less per unit of its moment: yaw stiffness and damping grow faster."""
    locus = stommel.root_locus(zju, "rudder_position", 0.5, 1.0, points=11)
    rates = np.array([able.turn_rate_deg_s_per_rudder_deg for able in locus.authorities], dtype=float)
    per_moment = rates / locus.values
    assert (np.diff(per_moment) < 0).all()


def test_root_locus_passes_through_the_design(zju: stommel.Vehicle) -> None:
    locus = stommel.root_locus(zju, "wing_position", 0.1, 0.2, points=3)
    assert locus.design_value == pytest.approx(0.15)
    assert locus.design_longitudinal is not None
    assert np.sort_complex(locus.longitudinal[1]) == pytest.approx(
        np.sort_complex(locus.design_longitudinal), rel=1e-12
    )


def test_build_up_leaves_the_reference_alone(zju: stommel.Vehicle) -> None:
    """At the reference positions the vehicle has its published totals, to the bit."""
    record = pack(zju, stommel.PAPER)
    assert record.M_alpha == -50.0
    assert record.N_beta == 100.0
    assert list(record.D_omega_V) == [0.0, 0.0, 0.0]
    assert record.Z_q == record.Y_r == 0.0
    aft = pack(zju.with_value("wing.aerodynamic_centre_aft_m", 0.3), stommel.PAPER)
    assert aft.M_alpha == pytest.approx(-50 - 67 * (0.3 - 0.225))
    assert aft.D_omega_V[1] == pytest.approx(-67 * (0.3**2 - 0.225**2))
    assert aft.Z_q == pytest.approx(-67 * (0.3 - 0.225))


@pytest.mark.parametrize(
    ("over", "start", "stop"),
    [
        ("rigid_body.centre_of_mass_m.2", 0.02, 0.08),
        ("moving_mass.mass_kg", 8.0, 12.0),
        ("hydrodynamics.lift_per_rad_kg_m", 100.0, 150.0),
        ("rigid_body.inertia_kg_m2.1", 8.0, 16.0),
    ],
)
def test_root_locus_over_any_number(zju: stommel.Vehicle, over: str, start: float, stop: float) -> None:
    locus = stommel.root_locus(zju, over, start, stop, points=7)
    assert locus.lateral is not None
    ends = zju.with_value(over, start), zju.with_value(over, stop)
    for k, vehicle in zip((0, -1), ends, strict=True):
        flight = stommel.trim(vehicle, speed_m_s=0.4, pitch_deg=-35.0, within_limits=False)
        expected = np.sort_complex(linearise(vehicle, flight).longitudinal.eigenvalues())
        assert np.sort_complex(locus.longitudinal[k]) == pytest.approx(expected, rel=1e-12)


def test_root_locus_refuses_what_it_cannot_vary(zju: stommel.Vehicle) -> None:
    with pytest.raises(FileError, match=r"no number of .* has this key"):
        stommel.root_locus(zju, "wing.colour", 0.0, 1.0)
    with pytest.raises(FileError, match=r"at moving_mass\.mass_kg = -1 kg: .*between 0\.02 and 1000 kg"):
        stommel.root_locus(zju, "moving_mass.mass_kg", -1.0, 1.0)
    with pytest.raises(stommel.StommelError, match=r"no table \[hull\], which it needs; \[hull\] needs length_m"):
        stommel.root_locus(stommel.load_vehicle("slocum"), "wing_position", 0.0, 0.2)


def test_pitch_authority_against_two_trims(zju: stommel.Vehicle) -> None:
    flight = stommel.trim(zju, speed_m_s=0.4, pitch_deg=-35.0)
    able = stommel.authority(linearise(zju, flight))
    near = [
        stommel.steady_flight(zju, moving_mass_mm=flight.r_px * 1e3 + d, ballast_ml=flight.V_b * 1e6)
        for d in (-0.1, 0.1)
    ]
    assert able.pitch_deg_per_mm == pytest.approx(degrees(near[1].theta - near[0].theta) / 0.2, rel=1e-6)
    near = [
        stommel.steady_flight(zju, moving_mass_mm=flight.r_px * 1e3, ballast_ml=flight.V_b * 1e6 + d)
        for d in (-0.1, 0.1)
    ]
    assert able.speed_m_s_per_ml == pytest.approx((near[1].V - near[0].V) / 0.2, rel=1e-5)


def test_fig_3_wing_aft_limits_pitch_authority(zju: stommel.Vehicle) -> None:
    """Section 3.2: a wing farther aft may limit pitch control authority, by the longer arm of its forces."""
    locus = stommel.root_locus(zju, "wing_position", 0.0, 0.2, points=11)
    peaks = [able.peak_pitch_rate_deg_s_per_mm for able in locus.authorities]
    assert (np.diff(peaks) < 0).all()


def test_peak_pitch_rate_against_a_simulated_step(zju: stommel.Vehicle) -> None:
    linear = linearise(zju, stommel.trim(zju, speed_m_s=0.4, pitch_deg=-35.0))
    times = np.linspace(0.0, 20.0, 4001)
    response = control.step_response(linear.longitudinal.to_control(), times, input_indices=0, output_indices=2)
    peak = degrees(float(np.abs(response.outputs).max())) * 1e-3
    assert stommel.authority(linear).peak_pitch_rate_deg_s_per_mm == pytest.approx(peak, rel=1e-3)


def test_turn_authority_against_a_steady_turn(zju: stommel.Vehicle) -> None:
    flight = stommel.trim(zju, speed_m_s=0.4, pitch_deg=-35.0)
    able = stommel.authority(linearise(zju, flight)).turn_rate_deg_s_per_rudder_deg
    gentle = stommel.steady_flight(zju, moving_mass_mm=flight.r_px * 1e3, ballast_ml=flight.V_b * 1e6, rudder_deg=1e-3)
    assert able == pytest.approx(degrees(gentle.turn_rate) / 1e-3, rel=1e-6)


def test_spiral_diverges_in_steep_dives(zju: stommel.Vehicle) -> None:
    """A finding, not a wish: with the cited lateral coefficients the spiral is unstable beyond about -39 deg."""
    assert is_stable(zju, stommel.trim(zju, speed_m_s=0.4, pitch_deg=-35.0))
    assert not is_stable(zju, stommel.trim(zju, speed_m_s=0.4, pitch_deg=-45.0))


def test_batch_agrees_with_single_trims(zju: stommel.Vehicle) -> None:
    speeds, pitches = np.array([0.3, 0.4, 0.4]), np.radians([-20.0, -35.0, 45.0])
    flights, longitudinal, lateral, codes = trims_with_modes(
        pack(zju, stommel.PAPER), speeds, pitches, reference_water(zju)
    )
    assert (codes == 0).all()
    for k in range(3):
        flight = stommel.trim(zju, speed_m_s=speeds[k], pitch_deg=degrees(pitches[k]))
        linear = linearise(zju, flight)
        assert linear.lateral is not None
        assert flights[k][V_B] == pytest.approx(flight.V_b, rel=1e-12)
        for ours, model in ((longitudinal[k], linear.longitudinal), (lateral[k], linear.lateral)):
            # by their characteristic polynomials: the order of a conjugate pair is a matter of rounding
            assert np.poly(ours) == pytest.approx(np.poly(model.eigenvalues()), rel=1e-9)
    assert radians(-35.0) == pytest.approx(flights[1][THETA])
