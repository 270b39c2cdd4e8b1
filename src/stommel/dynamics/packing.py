"""From a vehicle's description to the parameters of its equations of motion."""

from functools import lru_cache
from math import pi, radians

import numpy as np
from numpy.typing import NDArray

from stommel.dynamics.parameters import parameter_record
from stommel.seawater.water import Water
from stommel.vehicle import Physics, Vehicle, VehicleFile
from stommel.vehicle.checks import rigid_body_inertia_about_origin, skew

UNKNOWN = 0.0
"""Stands for a lateral coefficient that no source gives: in wings-level flight it multiplies zero, and
`Vehicle.require_lateral` refuses every other use."""


def pack(vehicle: Vehicle, physics: Physics) -> np.record:
    """Return the parameter record of a vehicle under the given physics."""
    return _pack(vehicle.description, physics, vehicle.neutral_density_kg_m3)


def reference_water(vehicle: Vehicle) -> Water:
    """Still water in which the vehicle is neutral."""
    return Water(rho=vehicle.neutral_density_kg_m3, P=0.0, T=vehicle.description.water.temperature_c)


@lru_cache(maxsize=64)
def _pack(description: VehicleFile, physics: Physics, neutral_density: float) -> np.record:
    return parameter_record(
        **_masses(description),
        **_inertia(description),
        **_buoyancy(description, physics, neutral_density),
        **_coefficients(description),
        **_beyond_stall(description, physics),
    )


def _known(value: float | None) -> float:
    return UNKNOWN if value is None else value


def _masses(d: VehicleFile) -> dict[str, object]:
    body, ballast = d.rigid_body, d.ballast
    s_0 = body.mass_kg * np.array(body.centre_of_mass_m) + ballast.mass_kg * np.array(ballast.position_m)
    return {
        "m": d.mass_kg,
        "m_p": d.moving_mass.mass_kg,
        "R_p": d.moving_mass.offset_m,
        "J_p": _six(np.array(d.moving_mass.inertia_kg_m2)),
        "s_0": s_0,
        "g": d.water.gravity_m_s2,
    }


def _inertia(d: VehicleFile) -> dict[str, object]:
    body, ballast, added = d.rigid_body, d.ballast, d.added_inertia
    r_b = skew(ballast.position_m)
    # sway of the water is zero in a vehicle that has only a vertical plane: it never moves that way
    M_f = np.diag([added.surge_kg, added.sway_kg or 0.0, added.heave_kg])
    C_f = np.array(added.coupling_kg_m)
    M_0 = (body.mass_kg + ballast.mass_kg) * np.eye(3) + M_f
    C_0 = body.mass_kg * skew(body.centre_of_mass_m) + ballast.mass_kg * r_b + C_f
    J_0 = rigid_body_inertia_about_origin(d) - ballast.mass_kg * r_b @ r_b + np.array(added.inertia_kg_m2)
    return {"M_0": _six(M_0), "C_0": C_0.ravel(), "J_0": _six(J_0), "M_f": _six(M_f), "C_f": C_f.ravel()}


def _six(S: NDArray[np.float64]) -> list[float]:
    return [S[0, 0], S[1, 1], S[2, 2], S[0, 1], S[0, 2], S[1, 2]]


def _buoyancy(d: VehicleFile, physics: Physics, neutral_density: float) -> dict[str, object]:
    origin = (0.0, 0.0, 0.0)
    engine = d.actuators.buoyancy if physics.bladder else None
    elastic = d.hull if physics.hull_elasticity else None
    return {
        "V_0": d.mass_kg / neutral_density,
        "kappa": elastic.compressibility_per_pa if elastic else 0.0,
        "alpha_T": elastic.thermal_expansion_per_k if elastic else 0.0,
        "T_0": d.water.temperature_c,
        "r_bl": (engine.bladder_position_m if engine else None) or origin,
        "r_res": (engine.reservoir_position_m if engine else None) or origin,
        "rho_oil": (engine.oil_density_kg_m3 if engine else None) or 0.0,
    }


def _coefficients(d: VehicleFile) -> dict[str, object]:
    h = d.hydrodynamics
    base = {
        "K_D0": h.drag_kg_m,
        "K_D": h.drag_per_rad2_kg_m,
        "K_L0": h.lift_kg_m,
        "K_L": h.lift_per_rad_kg_m,
        "S_beta": _known(h.side_force_per_rad_kg_m),
        "K_beta": _known(h.roll_moment_per_rad_kg),
        "M_zero": h.pitch_moment_kg,
        "M_alpha": h.pitch_moment_per_rad_kg,
        "N_beta": _known(h.yaw_moment_per_rad_kg),
        "D_omega": [_known(h.roll_damping_kg_s), h.pitch_damping_kg_s or 0.0, _known(h.yaw_damping_kg_s)],
        "moments_in_flow_frame": float(h.moments_along == "flow"),
    }
    return base | _build_up(d, base)


def _build_up(d: VehicleFile, total: dict[str, object]) -> dict[str, object]:
    """Component build-up: what wing and rudder change when they leave the positions of the vehicle's totals.

    The body keeps what remains of the totals at the reference positions, so that only differences of the shares enter
    (design notes on the component build-up; shares as in Etkin and Reid 1995).
    """
    M_alpha, D_q, Z_q = 0.0, 0.0, 0.0
    if d.wing is not None:
        L_w, here, there = d.wing.lift_per_rad_kg_m, d.wing.aerodynamic_centre_aft_m, d.wing.reference_aft_m
        M_alpha = -L_w * (here - there)
        D_q = -L_w * (here**2 - there**2)
        Z_q = -L_w * (here - there)
    N_beta, D_r, Y_r, Y_delta, l_delta, z_delta = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    if d.rudder is not None:
        Y_delta, l_delta, z_delta = (
            d.rudder.side_force_per_rad_kg_m,
            d.rudder.aerodynamic_centre_aft_m,
            -d.rudder.height_m,
        )
        there = d.rudder.reference_aft_m
        N_beta = Y_delta * (l_delta - there)
        D_r = -Y_delta * (l_delta**2 - there**2)
        Y_r = Y_delta * (l_delta - there)
    return {
        "M_alpha": total["M_alpha"] + M_alpha,  # type: ignore[operator]  # both are numbers
        "N_beta": total["N_beta"] + N_beta,  # type: ignore[operator]  # both are numbers
        "D_omega_V": [0.0, D_q, D_r],
        "Z_q": Z_q,
        "Y_r": Y_r,
        "S_delta": Y_delta,
        "N_delta": Y_delta * l_delta,
        "K_delta": Y_delta * z_delta,
    }


def _beyond_stall(d: VehicleFile, physics: Physics) -> dict[str, object]:
    h = d.hydrodynamics
    bounded = physics.large_angles
    return {
        "alpha_attached": radians(h.stall_begins_deg) if bounded else 2 * pi,
        "alpha_separated": radians(h.stall_ends_deg) if bounded else 3 * pi,
        "K_N": h.broadside_drag_kg_m or h.lift_per_rad_kg_m,
    }
