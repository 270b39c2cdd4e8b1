"""The most general evaluation of the equations of motion: no term of them vanishes and none is diagonal."""

import numpy as np
from numpy.typing import NDArray

from stommel.dynamics.acceleration import state_of
from stommel.dynamics.packing import pack
from stommel.dynamics.parameters import VEHICLE_RECORD, parameter_record
from stommel.dynamics.state import STATE_SIZE, Actuation
from stommel.geometry.attitude import quaternion_from_euler
from stommel.geometry.vectors import add, to_body
from stommel.seawater.water import Water
from stommel.vehicle import FULL, load_vehicle

ACTUATION = Actuation(r_px_dot=0.005, u_px=1.0, u_b=8e-6, delta_r=0.2, mu=0.3, mu_dot=0.05)
WATER = Water(rho=1027.0, P=1e6, T=10.0, U=(0.2, -0.1, 0.02), DU_Dt=(1e-3, 2e-3, -1e-3))


def general_vehicle() -> np.record:
    """Parameters of the ZJU glider with every coupling filled in by a few per cent, and a mass that hangs off-axis."""
    record = pack(load_vehicle("zju"), FULL)
    values = {name: np.array(record[name]) for name in VEHICLE_RECORD.names or ()}
    values["R_p"] = np.array(0.03)
    values["J_p"] = np.array([0.02, 0.1, 0.11, 0.002, 0.003, 0.001])
    for name in ("M_0", "M_f", "J_0"):
        values[name] = values[name] + np.array([0.0, 0.0, 0.0, 0.4, 0.7, -0.3])
    added_coupling = np.array([0.1, -0.3, 0.2, 0.4, 0.05, -0.7, 0.1, 0.6, -0.1])
    values["C_f"] = values["C_f"] + added_coupling
    values["C_0"] = values["C_0"] + added_coupling
    values["D_omega_V"] = np.array([-1.0, -2.0, -3.0])
    values["Y_r"], values["Z_q"] = np.array(1.5), np.array(-2.5)
    values["moments_in_flow_frame"] = np.array(1.0)
    return parameter_record(**values)


def attached_state() -> NDArray[np.float64]:
    """Flat state of a turning glide at an angle of attack of 4 degrees and a sideslip of -3 degrees."""
    V, alpha, beta = 0.4, np.deg2rad(4.0), np.deg2rad(-3.0)
    Q = quaternion_from_euler(0.1, np.deg2rad(-35.0), 0.4)
    v_r = (V * np.cos(alpha) * np.cos(beta), V * np.sin(beta), V * np.sin(alpha) * np.cos(beta))
    v = add(v_r, to_body(Q, WATER.U))
    omega, X = (0.01, -0.005, 0.02), (100.0, 50.0, 80.0)
    state = state_of(general_vehicle(), v, omega, X, Q, 0.26, 2e-4, ACTUATION, WATER)
    return np.hstack(state)


def random_states(generator: np.random.Generator, count: int) -> NDArray[np.float64]:
    """Flat states (count x 16) at every attitude and angle of attack, most of them stalled."""
    scales = np.array([100.0] * 3 + [1.0] * 4 + [30.0] * 3 + [3.0] * 3 + [0.3, 3.0, 2e-4])
    x = scales * generator.normal(size=(count, STATE_SIZE))
    x[:, 3:7] /= np.linalg.norm(x[:, 3:7], axis=1, keepdims=True)
    x[::4, 8:10] *= 0.05  # a share of them nearly straight ahead, in attached flow
    return x
