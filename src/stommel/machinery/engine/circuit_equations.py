"""Rates, observations and event functions of a circuit (compiled). Equation numbers are those of docs/theory/engine."""

from math import exp, sqrt

import numpy as np

from stommel.compilation import compiled, inlined
from stommel.machinery.engine.network import (
    ACCUMULATOR,
    BLADDER,
    BRAKE,
    CHECK_VALVE,
    CHECK_VALVES,
    DRIVER,
    HULL_GAS,
    LIMITED,
    LINE,
    LINES,
    LOCKED,
    MOTOR_FRICTION,
    OIL,
    PISTON_FRICTION,
    PUMP_FRICTION,
    PUMP_LEAKAGE,
    RAMP,
    SEA,
    SOLENOID_VALVES,
    STUCK,
    SUPPLY,
    TRANSMISSION,
    VALVE_COILS,
    WINDINGS,
)  # fmt: skip

P_ATM = 101325.0
"""Gauge pressures count from here [Pa]."""

PRESSURE_SLACK, FORCE_SLACK = 50.0, 0.01
"""A valve or a resting piston switches this far beyond its condition [Pa, N], several times the integrator's tolerance,
so that its errors do not make them chatter."""

FIRST_EVENT = 3
"""Events 0 to 2 are the controller's and the motor's; those of passages, pistons and nodes follow."""

CURRENT, VOLTAGE, POWER, BLADDER_FLOW, FIRST_PRESSURE = range(5)
"""What `evaluate` observes; the pressures of the nodes follow."""


@inlined
def node_pressure(node: np.record, stock: float, chambers: float, sea: float) -> float:
    """Pressure of a node from the oil in it [Pa, gauge], Eqs. (n5) to (n7)."""
    pressure: float = sea + node.stiffness * stock
    if node.kind == BLADDER:
        return pressure
    pressure = node.K * stock / (node.volume + chambers)
    if node.kind == ACCUMULATOR:
        pressure += node.precharge - P_ATM
        if stock > 0.0:
            filled = min(stock, 0.999 * node.gas_volume)
            pressure = node.precharge * (node.gas_volume / (node.gas_volume - filled)) ** node.exponent - P_ATM
    return pressure


@inlined
def passage_flow(R: float, kappa: float, dp: float) -> float:
    """Solve dp = R q + kappa q |q| for the flow [m3/s], Eq. (n8)."""
    root = sqrt(R * R + 4.0 * kappa * abs(dp))
    return 2.0 * dp / (R + root)


@inlined
def piston_friction(piston: np.record, v: float, direction: int) -> float:
    """Force that opposes a piston's motion [N], Eq. (n10)."""
    still = piston.coulomb + piston.stribeck * exp(-((v / piston.v_s) ** 2))
    force: float = direction * still + piston.viscous * v
    return force


@inlined
def piston_push(piston: np.record, p: float, node: np.record) -> float:
    """Force of oil and gas on a piston, outwards [N], Eq. (n9): with the strain energy of the oil that it displaces."""
    force: float = piston.S * (p - piston.gas)
    if node.kind == OIL:
        force += piston.S * p * p / (2.0 * node.K)
    return force


@inlined
def at_motor(effort: float, power: float, efficiency: float) -> float:
    """Torque at the motor of a load reduced to it, with the train's loss in the direction of power, Eq. (n4)."""
    return effort / efficiency if power > 0.0 else effort * efficiency


@inlined
def add_pumps(omega: float, s: int, p: np.ndarray, pumps: np.ndarray, dy: np.ndarray, book: int) -> float:
    """Add the flows and losses of the pumps to the rates; return their torque at the motor [N m]."""
    load = 0.0
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
        reduced = at_motor(torque, s * torque, pump.efficiency)
        load += reduced
        dy[book + TRANSMISSION] += (reduced - torque) * omega
        dy[book + PUMP_FRICTION] += friction * omega_p
        dy[book + PUMP_LEAKAGE] += leak * dp
    return load


@inlined
def add_passages(
    p: np.ndarray, passages: np.ndarray, opened: np.ndarray, dy: np.ndarray, book: int, g: np.ndarray
) -> None:
    """Add the flows and losses of lines and valves to the rates, and fill the events of check valves."""
    for i in range(len(passages)):
        passage = passages[i]
        dp = p[passage.a] - p[passage.b]
        passes, pressing, entry = bool(opened[i]), dp, SOLENOID_VALVES
        if passage.kind == LINE:
            passes, entry = True, LINES
        elif passage.kind == CHECK_VALVE:
            pressing, entry = dp - passage.cracking, CHECK_VALVES
            g[FIRST_EVENT + i] = PRESSURE_SLACK + (pressing if passes else -pressing)
            passes = passes and pressing > 0.0
        if passes:
            q = passage_flow(passage.R, passage.kappa, pressing)
            dy[1 + passage.a] -= q
            dy[1 + passage.b] += q
            dy[book + entry] += dp * q
            dy[book + VALVE_COILS] += passage.coil


@inlined
def add_pistons(
    y: np.ndarray,
    first_x: int,
    p: np.ndarray,
    nodes: np.ndarray,
    pistons: np.ndarray,
    drive: np.record,
    moving: np.ndarray,
    dy: np.ndarray,
    book: int,
    g: np.ndarray,
    first_event: int,
) -> float:
    """Add the motion and losses of the pistons to the rates, fill their events; return their torque at the motor."""
    omega, s, load, count = y[0], drive.s, 0.0, len(pistons)
    for i in range(count):
        piston = pistons[i]
        x = y[first_x + i]
        v, friction = 0.0, 0.0
        push = piston_push(piston, p[piston.node], nodes[piston.node])
        changes, stops = first_event + 2 * i, first_event + 2 * i + 1
        if piston.driven:
            v = -piston.ratio * omega
            friction = piston_friction(piston, v, -s)
            torque = -piston.ratio * (friction - push)  # (n11)
            reduced = at_motor(torque, s * torque, piston.efficiency)
            load += reduced
            dy[book + TRANSMISSION] += (reduced - torque) * omega
            if drive.mode != LOCKED:
                g[stops] = x if s > 0 else piston.stroke - x
        elif moving[i] == STUCK:
            # at an end stop only a push away from it counts
            held = (x <= 0.0 and push < 0.0) or (x >= piston.stroke and push > 0.0)
            g[changes] = FORCE_SLACK + piston.coulomb + piston.stribeck - (0.0 if held else abs(push))
        else:
            v = y[first_x + count + i]
            friction = piston_friction(piston, v, moving[i])
            dy[first_x + count + i] = (push - friction) / piston.mass  # (n9)
            g[changes] = moving[i] * v
            g[stops] = x if moving[i] < 0 else piston.stroke - x
        dy[first_x + i] = v
        dy[1 + piston.node] -= piston.S * v
        dy[book + PISTON_FRICTION] += friction * v
        dy[book + HULL_GAS] += piston.gas * piston.S * v
    return load


@inlined
def add_motor(
    omega: float, drive: np.record, load: float, dy: np.ndarray, book: int, seen: np.ndarray, g: np.ndarray
) -> None:
    """Turn the motor under a load: its acceleration or its current, its losses and events."""
    s, k_t = drive.s, drive.k_t
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
        if drive.mode != BRAKE:
            g[2] = i_limit - s * current
    voltage = drive.R * current + k_t * omega
    power = voltage * current
    supply = power / drive.efficiency if power > 0.0 else 0.0  # what flows back is turned into heat
    dy[book + DRIVER] = supply - power
    dy[book + WINDINGS] = drive.R * current**2
    dy[book + MOTOR_FRICTION] = k_t * drive.I_0 * abs(omega)
    dy[book + SUPPLY] = supply + dy[book + VALVE_COILS]
    seen[CURRENT], seen[VOLTAGE], seen[POWER] = current, voltage, dy[book + SUPPLY]


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
    drive, first_x = drives[0], 1 + len(nodes)
    book = first_x + 2 * len(pistons)
    first_piston = FIRST_EVENT + len(passages)
    first_node = first_piston + 2 * len(pistons)
    dy[:] = 0.0
    g[:] = 1.0
    p = seen[FIRST_PRESSURE:]
    for n in range(len(nodes)):
        chambers = 0.0
        for i in range(len(pistons)):
            if pistons[i].node == n:
                chambers += pistons[i].S * y[first_x + i]
        p[n] = node_pressure(nodes[n], y[1 + n], chambers, drive.pressure)
        if nodes[n].kind == ACCUMULATOR:
            g[first_node + n] = y[1 + n] if opened[len(passages) + n] else -y[1 + n]
    load = add_pumps(y[0], drive.s, p, pumps, dy, book)
    add_passages(p, passages, opened, dy, book, g)
    load += add_pistons(y, first_x, p, nodes, pistons, drive, moving, dy, book, g, first_piston)
    for n in range(len(nodes)):
        if nodes[n].kind == BLADDER:
            seen[BLADDER_FLOW] = dy[1 + n]
            dy[book + SEA] = drive.pressure * dy[1 + n]
    add_motor(y[0], drive, load, dy, book, seen, g)
    if drive.towards != 0:
        i = drive.measured
        g[0] = drive.towards * (drive.target - y[first_x + i])
        if drive.lead and drive.rate > 0.0:
            # the flow falls to zero at the rate of the ramp: half of q^2 over that rate still moves  (n12)
            g[0] -= 0.5 * pistons[i].S * dy[first_x + i] ** 2 / (drive.q_rad * drive.rate)


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
