"""A circuit reduced to the constants of steady pumping, and the energy of an inflation from them in closed form."""

from collections import deque
from math import pi

import numpy as np
from numpy.typing import ArrayLike

from stommel.machinery.engine.circuit import CircuitError, assemble
from stommel.machinery.engine.network import CHECK_VALVE, SOLENOID_VALVE, Network, rad_s
from stommel.machinery.engine.steady_state import Array, EngineParameters, steady_state
from stommel.vehicle.schema import Engine


def engine_parameters(engine: Engine) -> EngineParameters:
    """Reduce the circuit to one pump, one loss and one piston.

    A piston that a screw drives is a pump whose displacement is the volume of one turn of the screw.

    Raises
    ------
    CircuitError
        More than one pump, or no way for the oil from the pump to the bladder.
    """
    network = assemble(engine)
    motor, drive = engine.motors[0], network.drive[0]
    i = int(drive["measured"])
    piston = network.pistons[i]
    common = {
        "torque_constant_n_m_a": float(drive["k_t"]),
        "resistance_ohm": motor.resistance_ohm,
        "no_load_current_a": motor.no_load_current_a,
        "piston_area_m2": float(piston["S"]),
        "cylinder_coulomb_n": float(piston["coulomb"]),
        "cylinder_viscous_n_s_m": float(piston["viscous"]),
        "cylinder_stribeck_n": float(piston["stribeck"]),
        "stribeck_velocity_m_s": float(piston["v_s"]),
        "reservoir_pressure_pa": float(piston["gas"]),
        "supply_voltage_v": motor.supply_voltage_v,
        "driver_efficiency": motor.driver_efficiency,
        "current_limit_a": motor.current_limit_a,
    }
    if piston["driven"]:
        R, kappa, cracking = _losses(engine, network, int(piston["node"]), network.bladder)
        pump = {
            "gear_ratio": 1.0,
            "gear_efficiency": float(piston["efficiency"]),
            "displacement_m3_rev": float(drive["q_rad"]) * 2.0 * pi,
            "leakage_m3_s_pa": 0.0,
            "pump_friction_n_m": 0.0,
            "pump_friction_share": 0.0,
            "pump_damping_n_m_s": 0.0,
        }
    else:
        if len(network.pumps) != 1:
            raise CircuitError(f"engine: steady pumping is known for one pump, this circuit has {len(network.pumps)}")
        row = network.pumps[0]
        before = _losses(engine, network, int(piston["node"]), int(row["inlet"]))
        after = _losses(engine, network, int(row["outlet"]), network.bladder)
        R, kappa, cracking = (a + b for a, b in zip(before, after, strict=True))
        pump = {
            "gear_ratio": 1.0 / float(row["ratio"]),
            "gear_efficiency": float(row["efficiency"]),
            "displacement_m3_rev": float(row["D"]) * 2.0 * pi,
            "leakage_m3_s_pa": float(row["k_l"]),
            "pump_friction_n_m": float(row["friction"]),
            "pump_friction_share": float(row["share"]),
            "pump_damping_n_m_s": float(row["damping"]),
        }
    lines = {"line_resistance_pa_s_m3": R, "line_loss_pa_s2_m6": kappa, "cracking_pressure_pa": cracking}
    return EngineParameters(**common, **pump, **lines)


def inflation_energy(engine: Engine, volume_m3: ArrayLike, pressure_pa: ArrayLike) -> Array:
    """Energy from the supply for an inflation at the file's motor speed [J], NaN where the engine cannot do it.

    Steady pumping with the driver's ramps at both ends. Within 1 % of the simulation for 50 ml and more
    (tests/engine/test_reduction.py); what an elastic bladder or an accumulator stores is left out.

    Parameters
    ----------
    engine
        The circuit; `InflationCosts` keeps it reduced for many calls.
    volume_m3
        Oil into the bladder [m3].
    pressure_pa
        Gauge pressure of the sea [Pa]. Shapes broadcast.

    Raises
    ------
    CircuitError
        The circuit cannot be reduced to steady pumping.
    """
    return InflationCosts(engine).energy_j(volume_m3, pressure_pa)


class InflationCosts:
    """Energy and time of inflations by one engine; each call takes tens of microseconds, whatever the array's size."""

    def __init__(self, engine: Engine, motor_speed_rpm: float | None = None) -> None:
        motor = engine.motors[0]
        self.parameters = engine_parameters(engine)
        self._omega = rad_s(motor_speed_rpm or abs(engine.inflate.motor_speed_rpm))
        self._inertia = motor.rotor_inertia_g_cm2 / 1e7
        self._ramp = motor.ramp_s
        self._coils = sum(v.power_w for v in engine.solenoid_valves if v.name in engine.inflate.open_valves)

    def duration_s(self, volume_m3: ArrayLike, pressure_pa: ArrayLike) -> Array:
        """Time of an inflation [s]; NaN where the engine cannot do it."""
        steady = steady_state(self.parameters, pressure_pa, self._omega)
        with np.errstate(divide="ignore"):
            time = np.asarray(volume_m3) / steady.flow_m3_s + self._ramp
        return np.where(steady.stalled | ~steady.attainable, np.nan, time)

    def energy_j(self, volume_m3: ArrayLike, pressure_pa: ArrayLike) -> Array:
        """Energy from the supply of an inflation [J]; NaN where the engine cannot do it."""
        P, T = self.parameters, self._ramp
        steady = steady_state(P, pressure_pa, self._omega)
        k_t, R, eta = P.torque_constant_n_m_a, P.resistance_ohm, P.driver_efficiency
        swing = self._inertia * self._omega / T / k_t  # current that the ramp takes
        ramps = np.zeros_like(steady.current_a)
        for current in (steady.current_a + swing, np.maximum(steady.current_a - swing, 0.0)):
            ramps = ramps + (R * current**2 + 0.5 * k_t * self._omega * current) * T / eta
        with np.errstate(divide="ignore", invalid="ignore"):
            # a ramp moves half of what its time would move at full speed
            pumping = np.asarray(volume_m3) / steady.flow_m3_s - T
            energy = steady.power_w * pumping + ramps + self._coils * (pumping + 2.0 * T)
        return np.where(steady.stalled | ~steady.attainable, np.nan, energy)


def _losses(engine: Engine, network: Network, start: int, goal: int) -> tuple[float, float, float]:
    """Sum of the losses along the way of the oil while inflating: laminar, turbulent, cracking."""
    ways: dict[int, list[tuple[int, tuple[float, float, float]]]] = {}
    for name, row in zip(network.passage_names, network.passages, strict=True):
        if row["kind"] == SOLENOID_VALVE and name not in engine.inflate.open_valves:
            continue
        loss = (float(row["R"]), float(row["kappa"]), float(row["cracking"]))
        ways.setdefault(int(row["a"]), []).append((int(row["b"]), loss))
        if row["kind"] != CHECK_VALVE:
            ways.setdefault(int(row["b"]), []).append((int(row["a"]), loss))
    found = {start: (0.0, 0.0, 0.0)}
    waiting = deque([start])
    while waiting:
        here = waiting.popleft()
        for there, loss in ways.get(here, []):
            if there not in found:
                R, kappa, cracking = (a + b for a, b in zip(found[here], loss, strict=True))
                found[there] = (R, kappa, cracking)
                waiting.append(there)
    if goal not in found:
        raise CircuitError(
            f"engine: while inflating there is no way for the oil from {network.node_names[start]!r} to "
            f"{network.node_names[goal]!r}"
        )
    return found[goal]
