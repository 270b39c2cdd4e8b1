"""The parameters of the equations of motion as one flat record, which compiled code reads by the paper's symbols.

A record is frozen data: an array of records is a batch of vehicles. Switches are numbers, not branches: the paper's
simplifications are the values that make a term vanish (`stommel.vehicle.Physics`).
"""

import numpy as np
from numpy.typing import NDArray

VEHICLE_RECORD = np.dtype(
    [
        # masses (section 2.2 of the paper)
        ("m", "f8"),  # total mass [kg]
        ("m_p", "f8"),  # moving mass [kg]
        ("R_p", "f8"),  # distance of the moving mass from the b1 axis [m]
        ("J_p", "f8", (6,)),  # its inertia about its own centre at mu = 0 [kg m2]
        ("s_0", "f8", (3,)),  # static moment of the masses that do not move, m_rb r_rb + m_b r_b [kg m]
        # inertia of all that does not move, added inertia included: M_rb + M_b + M_f
        ("M_0", "f8", (6,)),  # [kg]
        ("C_0", "f8", (9,)),  # [kg m]
        ("J_0", "f8", (6,)),  # [kg m2]
        # the added part of it again, which sees the velocity relative to the water
        ("M_f", "f8", (6,)),  # [kg]
        ("C_f", "f8", (9,)),  # [kg m]
        # weight and buoyancy
        ("g", "f8"),  # gravity [m/s2]
        ("V_0", "f8"),  # neutral displaced volume at reference [m3]
        ("kappa", "f8"),  # hull compressibility [1/Pa]
        ("alpha_T", "f8"),  # hull thermal expansion [1/K]
        ("T_0", "f8"),  # reference temperature [deg C]
        ("r_bl", "f8", (3,)),  # bladder: where the ballast volume displaces water [m]
        ("r_res", "f8", (3,)),  # reservoir: where the oil comes from [m]
        ("rho_oil", "f8"),  # oil density; 0 when the oil's own mass is neglected [kg/m3]
        # viscous forces: times V^2 unless noted, angles in rad
        ("K_D0", "f8"),  # drag [kg/m]
        ("K_D", "f8"),
        ("S_beta", "f8"),  # side force, opposes sideslip
        ("S_delta", "f8"),
        ("K_L0", "f8"),  # lift
        ("K_L", "f8"),
        ("K_beta", "f8"),  # roll moment [kg]
        ("K_delta", "f8"),
        ("M_zero", "f8"),  # pitch moment
        ("M_alpha", "f8"),
        ("N_beta", "f8"),  # yaw moment
        ("N_delta", "f8"),
        ("D_omega", "f8", (3,)),  # angular damping, times V^2 [kg s]
        ("D_omega_V", "f8", (3,)),  # angular damping of wing and rudder, times V [kg m]
        ("Y_r", "f8"),  # side force from yaw rate, times V [kg]
        ("Z_q", "f8"),  # force along b3 from pitch rate, times V [kg]
        ("moments_in_flow_frame", "f8"),  # 1: the moments are along the flow's axes; 0: along the body's
        # beyond stall
        ("alpha_attached", "f8"),  # up to here the coefficients above hold [rad]
        ("alpha_separated", "f8"),  # from here on the flat-plate form holds [rad]
        ("K_N", "f8"),  # normal force of the separated flow, broadside [kg/m]
    ],
    align=True,
)
"""Layout of the parameter record; SI units."""


def parameter_record(**values: object) -> np.record:
    """Return a record with every field of `VEHICLE_RECORD` filled from `values`.

    Raises
    ------
    KeyError
        A field is missing or unknown.
    """
    names = set(VEHICLE_RECORD.names or ())
    if names != set(values):
        raise KeyError(f"parameter fields differ: {sorted(names ^ set(values))}")
    record: NDArray[np.void] = np.zeros(1, dtype=VEHICLE_RECORD)
    for name, value in values.items():
        record[name] = value
    record.flags.writeable = False
    frozen: np.record = record.view(np.recarray)[0]
    return frozen
