"""Steady pumping of a motor-driven buoyancy engine, in closed form and for whole arrays at once.

The simulation of the circuit settles to exactly this state (tests/engine/test_steady_state.py). Equation numbers are
those of docs/theory/engine.
"""

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

_STRIBECK_ITERATIONS = 6
"""Friction is corrected for its Stribeck part so many times; far above the Stribeck velocity the first is exact."""


@dataclass(frozen=True)
class EngineParameters:
    """Constants of a pumped buoyancy engine, in SI units; pressures are gauge."""

    torque_constant_n_m_a: float
    """k_t of the motor [N m/A]; equal to its back-EMF constant [V s/rad]."""
    resistance_ohm: float
    """Terminal resistance [ohm]."""
    no_load_current_a: float
    """Current that the motor's own friction takes [A]."""
    gear_ratio: float
    """Motor revolutions per revolution of the pump."""
    gear_efficiency: float
    """Share of the motor's work that reaches the pump, 0 to 1."""
    displacement_m3_rev: float
    """D, oil per revolution of the pump without leakage [m3]."""
    leakage_m3_s_pa: float
    """k_l, laminar leakage from outlet to inlet per pressure difference [m3/(s Pa)]."""
    pump_friction_n_m: float
    """Constant friction torque at the pump's shaft [N m]."""
    pump_friction_share: float
    """Friction torque proportional to pressure, as a share of the ideal torque D dp / 2 pi."""
    pump_damping_n_m_s: float
    """Friction torque proportional to the speed of the pump's shaft [N m s]."""
    piston_area_m2: float
    """S, cross-section of the reservoir cylinder [m2]."""
    cylinder_coulomb_n: float
    """Coulomb friction of the reservoir piston [N]."""
    cylinder_viscous_n_s_m: float
    """Viscous friction of the reservoir piston [N s/m]."""
    line_resistance_pa_s_m3: float
    """Laminar loss of lines and valves between reservoir and bladder while pumping [Pa s/m3]."""
    line_loss_pa_s2_m6: float = 0.0
    """Turbulent loss of the same [Pa s2/m6]."""
    cracking_pressure_pa: float = 0.0
    """Pressure that the check valve takes to open [Pa]."""
    cylinder_stribeck_n: float = 0.0
    """Friction of the piston at rest above its Coulomb friction [N]."""
    stribeck_velocity_m_s: float = 5e-4
    """Velocity at which 1/e of that remains [m/s]."""
    reservoir_pressure_pa: float = 0.0
    """Gas pressure behind the reservoir piston [Pa, gauge]; 0 on a bench, negative in an evacuated hull."""
    supply_voltage_v: float = 24.0
    """Voltage of the supply [V]."""
    driver_efficiency: float = 1.0
    """Share of the supply's power that the motor driver passes to the windings, 0 to 1."""
    current_limit_a: float = np.inf
    """Greatest current that the driver gives the windings [A]."""


@dataclass(frozen=True)
class SteadyState:
    """Steady pumping; every field has the broadcast shape of pressure and speed."""

    flow_m3_s: Array
    """Oil into the bladder [m3/s]; zero where leakage takes the whole flow of the pump."""
    pump_pressure_pa: Array
    """Pressure difference over the pump [Pa]."""
    pump_torque_n_m: Array
    """Torque at the pump's shaft [N m]."""
    torque_n_m: Array
    """Electromagnetic torque of the motor, its own friction included [N m]."""
    current_a: Array
    """Current of the windings [A]."""
    voltage_v: Array
    """Voltage at the windings [V]."""
    power_w: Array
    """Power from the supply [W]."""
    supply_current_a: Array
    """Current from the supply, power / supply voltage [A]."""
    volumetric_efficiency: Array
    """Flow / (displacement x speed)."""
    total_efficiency: Array
    """Pressure times flow over power from the supply: eta of section 5.1.2."""
    stalled: NDArray[np.bool_]
    """No oil moves: leakage takes the whole flow."""
    attainable: NDArray[np.bool_]
    """Supply voltage and current limit allow this speed under this load."""


def friction_pressure(parameters: EngineParameters, flow_m3_s: ArrayLike) -> Array:
    """Pressure that the reservoir piston's friction takes at a flow [Pa]: Stribeck, Coulomb and viscous."""
    v = np.asarray(flow_m3_s, dtype=np.float64) / parameters.piston_area_m2
    stribeck = parameters.cylinder_stribeck_n * np.exp(-((v / parameters.stribeck_velocity_m_s) ** 2))
    force = parameters.cylinder_coulomb_n + stribeck + parameters.cylinder_viscous_n_s_m * v
    return np.asarray(force / parameters.piston_area_m2)


def steady_state(parameters: EngineParameters, pressure_pa: ArrayLike, motor_speed_rad_s: ArrayLike) -> SteadyState:
    """Flow, torque, current and power while the engine pumps steadily.

    Parameters
    ----------
    parameters
        Constants of the engine.
    pressure_pa
        Gauge pressure of the sea at the bladder [Pa].
    motor_speed_rad_s
        Speed of the motor [rad/s], held by its driver. Shapes broadcast.
    """
    P = parameters
    p, omega = (np.asarray(a, dtype=np.float64) for a in np.broadcast_arrays(pressure_pa, motor_speed_rad_s))
    omega_p = omega / P.gear_ratio
    q_ideal = P.displacement_m3_rev * omega_p / (2.0 * pi)
    q = _flow(P, p, q_ideal)
    stalled = q <= 0.0
    q = np.maximum(q, 0.0)
    dp = np.where(stalled, _blocked_pressure(P, q_ideal), _pressure_rise(P, p, q))
    torque_p = (
        P.displacement_m3_rev / (2.0 * pi) * dp * (1.0 + P.pump_friction_share)
        + P.pump_friction_n_m
        + P.pump_damping_n_m_s * omega_p
    )
    torque = torque_p / (P.gear_ratio * P.gear_efficiency) + P.torque_constant_n_m_a * P.no_load_current_a
    i = torque / P.torque_constant_n_m_a
    u = P.resistance_ohm * i + P.torque_constant_n_m_a * omega
    power = u * i / P.driver_efficiency
    with np.errstate(divide="ignore", invalid="ignore"):
        eta_v = np.where(q_ideal > 0.0, q / q_ideal, 0.0)
        eta = np.where(power > 0.0, p * q / power, 0.0)
    return SteadyState(
        flow_m3_s=q,
        pump_pressure_pa=dp,
        pump_torque_n_m=torque_p,
        torque_n_m=torque,
        current_a=i,
        voltage_v=u,
        power_w=power,
        supply_current_a=power / P.supply_voltage_v,
        volumetric_efficiency=eta_v,
        total_efficiency=eta,
        stalled=stalled,
        attainable=(u <= P.supply_voltage_v) & (i <= P.current_limit_a),
    )


def _pressure_rise(P: EngineParameters, p: Array, q: Array) -> Array:
    """Pressure difference that the pump works against at a flow [Pa]."""
    lines = P.cracking_pressure_pa + P.line_resistance_pa_s_m3 * q + P.line_loss_pa_s2_m6 * q**2
    return np.asarray(p - P.reservoir_pressure_pa + friction_pressure(P, q) + lines)


def _blocked_pressure(P: EngineParameters, q_ideal: Array) -> Array:
    """Pressure difference at which leakage takes the whole flow [Pa]."""
    if P.leakage_m3_s_pa == 0.0:
        return np.zeros_like(q_ideal)
    return q_ideal / P.leakage_m3_s_pa


def _flow(P: EngineParameters, p: Array, q_ideal: Array) -> Array:
    """Solve q = q_ideal - k_l dp(q) [m3/s]: a quadratic, with the Stribeck part of the friction put in from before."""
    k_l = P.leakage_m3_s_pa
    slope = P.line_resistance_pa_s_m3 + P.cylinder_viscous_n_s_m / P.piston_area_m2**2
    a, b = k_l * P.line_loss_pa_s2_m6, 1.0 + k_l * slope
    q = q_ideal
    for _ in range(_STRIBECK_ITERATIONS):
        still = friction_pressure(P, np.maximum(q, 0.0)) - P.cylinder_viscous_n_s_m * q / P.piston_area_m2**2
        c = q_ideal - k_l * (p - P.reservoir_pressure_pa + still + P.cracking_pressure_pa)
        # the root that tends to c / b without turbulent loss, written so that a = 0 is allowed
        q = 2.0 * c / (b + np.sqrt(np.maximum(b**2 + 4.0 * a * c, 0.0)))
    return np.asarray(q)
