"""Rates, observations and event functions of a circuit (compiled). Equation numbers are those of docs/theory/engine."""

from math import exp, sqrt

import numpy as np

from stommel.design.engine.network import (
    ACCUMULATOR, BLADDER, BRAKE, CHECK_VALVE, CHECK_VALVES, DRIVER, HOLD, HULL_GAS, LIMITED, LINE, LINES, LOCKED,
    MOTOR_FRICTION, PISTON_FRICTION, PUMP_FRICTION, PUMP_LEAKAGE, RAMP, SEA, SOLENOID_VALVE, SOLENOID_VALVES, STUCK,
    SUPPLY, TRANSMISSION, VALVE_COILS, WINDINGS,
)  # fmt: skip
from stommel.dynamics.compilation import compiled, inlined

P_ATM = 101325.0
"""Gauge pressures count from here [Pa]."""

CURRENT, VOLTAGE, POWER, BLADDER_FLOW, FIRST_PRESSURE = range(5)
"""What `evaluate` observes; the pressures of the nodes follow."""


@inlined
def node_pressure(node: np.record, stock: float, chambers: float, sea: float) -> float:
    """Pressure of a node from the oil in it [Pa, gauge], Eqs. (n5) to (n7)."""
    if node.kind == BLADDER:
        return sea + node.stiffness * stock
    if node.kind == ACCUMULATOR:
        if stock <= 0.0:
            return node.precharge - P_ATM + node.K * stock / (node.volume + chambers)
        filled = min(stock, 0.999 * node.gas_volume)
        return node.precharge * (node.gas_volume / (node.gas_volume - filled)) ** node.exponent - P_ATM
    return node.K * stock / (node.volume + chambers)


@inlined
def passage_flow(R: float, kappa: float, dp: float) -> float:
    """Solve dp = R q + kappa q |q| for the flow [m3/s], Eq. (n8)."""
    root = sqrt(R * R + 4.0 * kappa * abs(dp))
    return 2.0 * dp / (R + root)


@inlined
def piston_friction(piston: np.record, v: float, direction: int) -> float:
    """Force that opposes a piston's motion [N], Eq. (n10)."""
    still = piston.coulomb + piston.stribeck * exp(-((v / piston.v_s) ** 2))
    return direction * still + piston.viscous * v


@inlined
def at_motor(effort: float, power: float, efficiency: float) -> float:
    """Torque at the motor of a load's torque reduced to it, with the train's loss in the direction of power, Eq. (n4)."""
    return effort / efficiency if power > 0.0 else effort * efficiency


@compiled
def evaluate(
    y: np.ndarray,
    nodes: np.ndarray,
    pumps: np.ndarray,
    passages: np.ndarray,
    pistons: np.ndarray,
    drives: np.ndarray,
    opened: np.ndarray,
    moving: np.ndarray,
    dy: np.ndarray,
    seen: np.ndarray,
    g: np.ndarray,
) -> None:
    """Fill `dy` with the rates of `y`, `seen` with observations and `g` with the event functions.

    Every event is the fall of its function through zero; a function that does not apply is 1.
    """
    drive = drives[0]
    N, n_pistons, n_passages = len(nodes), len(pistons), len(passages)
    first_x = 1 + N
    first_v = first_x + n_pistons
    book = first_v + n_pistons
    dy[:] = 0.0
    g[:] = 1.0
    omega, s = y[0], drive.s
    p = seen[FIRST_PRESSURE:]
    for n in range(N):
        chambers = 0.0
        for i in range(n_pistons):
            if pistons[i].node == n:
                chambers += pistons[i].S * y[first_x + i]
        p[n] = node_pressure(nodes[n], y[1 + n], chambers, drive.pressure)
        if nodes[n].kind == ACCUMULATOR:
            g[3 + n_passages + 2 * n_pistons + n] = y[1 + n] if opened[n_passages + n] else -y[1 + n]
    load = 0.0  # torque at the motor

    for i in range(len(pumps)):
        pump = pumps[i]
        omega_p = abs(omega) * pump.ratio
        dp = p[pump.outlet] - p[pump.inlet]
        leak = pump.k_l * dp
        q = pump.D * omega_p - leak  # (n1)
        dy[1 + pump.inlet] -= q
        dy[1 + pump.outlet] += q
        friction = pump.friction + pump.share * pump.D * abs(dp) + pump.damping * omega_p
        torque = s * (pump.D * dp + friction) * pump.ratio  # (n2)
        power = torque * omega
        reduced = at_motor(torque, s * torque, pump.efficiency)
        load += reduced
        dy[book + TRANSMISSION] += reduced * omega - power
        dy[book + PUMP_FRICTION] += friction * omega_p
        dy[book + PUMP_LEAKAGE] += leak * dp

    for i in range(n_passages):
        passage = passages[i]
        dp = p[passage.a] - p[passage.b]
        if passage.kind == CHECK_VALVE:
            beyond = dp - passage.cracking
            g[3 + i] = beyond if opened[i] else -beyond
            if beyond < 0.0:
                continue
            q = passage_flow(passage.R, passage.kappa, beyond) if opened[i] else 0.0
        elif passage.kind == LINE or opened[i]:
            q = passage_flow(passage.R, passage.kappa, dp)
        else:
            continue
        dy[1 + passage.a] -= q
        dy[1 + passage.b] += q
        entry = LINES
        if passage.kind == CHECK_VALVE:
            entry = CHECK_VALVES
        elif passage.kind == SOLENOID_VALVE:
            entry = SOLENOID_VALVES
            dy[book + VALVE_COILS] += passage.coil
        dy[book + entry] += dp * q

    for i in range(n_pistons):
        piston = pistons[i]
        x = y[first_x + i]
        push = piston.S * (p[piston.node] - piston.gas)  # outwards
        if piston.driven:
            v = -piston.ratio * omega
            friction = piston_friction(piston, v, -s)
            torque = -piston.ratio * (friction - push)
            reduced = at_motor(torque, s * torque, piston.efficiency)
            load += reduced
            dy[book + TRANSMISSION] += (reduced - torque) * omega
            if drive.mode != LOCKED:
                g[3 + n_passages + 2 * i + 1] = x if s > 0 else piston.stroke - x
        elif moving[i] == STUCK:
            v, friction = 0.0, 0.0
            net = push
            # at an end stop only a push away from it counts
            if (x <= 0.0 and push < 0.0) or (x >= piston.stroke and push > 0.0):
                net = 0.0
            g[3 + n_passages + 2 * i] = piston.coulomb + piston.stribeck - abs(net)
        else:
            v = y[first_v + i]
            friction = piston_friction(piston, v, moving[i])
            dy[first_v + i] = (push - friction) / piston.mass  # (n9)
            g[3 + n_passages + 2 * i] = moving[i] * v
            g[3 + n_passages + 2 * i + 1] = x if moving[i] < 0 else piston.stroke - x
        dy[first_x + i] = v
        dy[1 + piston.node] -= piston.S * v
        dy[book + PISTON_FRICTION] += friction * v
        dy[book + HULL_GAS] += piston.gas * piston.S * v

    for n in range(N):
        if nodes[n].kind == BLADDER:
            seen[BLADDER_FLOW] = dy[1 + n]
            dy[book + SEA] = drive.pressure * dy[1 + n]

    k_t = drive.k_t
    i_limit = min(drive.I_max, (drive.U - k_t * abs(omega)) / drive.R)
    resisting = load + s * k_t * drive.I_0
    current = 0.0
    if drive.mode == LIMITED:
        current = s * i_limit
        dy[0] = (k_t * current - resisting) / drive.J  # (n3)
        g[1] = drive.omega - s * omega
        g[2] = s * omega
    elif drive.mode != LOCKED:
        if drive.mode == RAMP:
            dy[0] = s * drive.rate
            g[1] = drive.omega - s * omega
        elif drive.mode == BRAKE:
            dy[0] = -s * drive.rate
            g[1] = s * omega
        current = (drive.J * dy[0] + resisting) / k_t  # (n3), solved for the current
        if drive.mode in (RAMP, HOLD):
            g[2] = i_limit - s * current
    voltage = drive.R * current + k_t * omega if drive.mode != LOCKED else 0.0
    power = voltage * current
    supply = power / drive.efficiency if power > 0.0 else 0.0
    dy[book + DRIVER] = supply - power
    dy[book + WINDINGS] = drive.R * current**2
    if drive.mode != LOCKED:
        dy[book + MOTOR_FRICTION] = k_t * drive.I_0 * abs(omega)
    supply += dy[book + VALVE_COILS]
    dy[book + SUPPLY] = supply
    seen[CURRENT], seen[VOLTAGE], seen[POWER] = current, voltage, supply

    if drive.towards != 0:
        i = drive.measured
        remaining = drive.towards * (drive.target - y[first_x + i])
        if drive.lead and drive.rate > 0.0:
            v = dy[first_x + i]
            # flow falls to zero at the rate of the ramp: half of q^2 over that rate still moves  (n12)
            remaining -= 0.5 * pistons[i].S * v * v / (drive.q_rad * drive.rate)
        g[0] = remaining


@compiled
def observe(
    states: np.ndarray,
    nodes: np.ndarray,
    pumps: np.ndarray,
    passages: np.ndarray,
    pistons: np.ndarray,
    drives: np.ndarray,
    opened: np.ndarray,
    moving: np.ndarray,
    events: int,
) -> np.ndarray:
    """Observations of `evaluate` along a solution; a row of `states` is one instant."""
    seen = np.empty((len(states), FIRST_PRESSURE + len(nodes)))
    dy, g = np.empty(states.shape[1]), np.empty(events)
    for k in range(len(states)):
        evaluate(states[k], nodes, pumps, passages, pistons, drives, opened, moving, dy, seen[k], g)
    return seen
