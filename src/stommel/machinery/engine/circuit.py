"""From the parts and connections of a vehicle file to a network of nodes."""

from collections import deque
from dataclasses import dataclass
from math import pi

import numpy as np

from stommel.errors import StommelError
from stommel.machinery.engine.network import (
    ACCUMULATOR,
    BLADDER,
    CHECK_VALVE,
    DRIVE,
    LINE,
    LOCKED,
    NODE,
    OIL,
    PASSAGE,
    PISTON,
    PUMP,
    SOLENOID_VALVE,
    Network,
    Records,
)  # fmt: skip
from stommel.vehicle.schema import Engine

MEGA = 1e6
"""Pa in a MPa, and ml in a m3."""


class CircuitError(StommelError):
    """Parts that are connected soundly but cannot work together."""


@dataclass(frozen=True)
class Train:
    """How a shaft or rod moves with the motor."""

    ratio: float
    """Its speed per speed of the motor: 1, or m/rad for a rod."""
    efficiency: float
    """Share of the motor's work that arrives."""


def assemble(engine: Engine) -> Network:
    """Turn a circuit into a network at rest, with empty lines' pressure and pistons unset.

    Raises
    ------
    CircuitError
        A pump or rod that no motor drives, a train that closes on itself, a node with two stores.
    """
    node_of, names = _oil_nodes(engine)
    driven = trains(engine)
    network = Network(
        nodes=_nodes(engine, node_of, names),
        pumps=_pumps(engine, node_of, driven),
        passages=_passages(engine, node_of),
        pistons=_pistons(engine, node_of, driven),
        drive=np.zeros(1, DRIVE),
        opened=np.zeros(0, np.int64),
        moving=np.zeros(0, np.int64),
        node_names=tuple(names),
        passage_names=tuple(part.name for part in (*engine.lines, *engine.check_valves, *engine.solenoid_valves)),
        piston_names=tuple(piston.name for piston in (*engine.reservoirs, *engine.cylinders)),
        bladder=node_of[f"{engine.bladders[0].name}.oil"],
    )
    network.opened = np.zeros(len(network.passages) + len(network.nodes), np.int64)
    network.moving = np.zeros(len(network.pistons), np.int64)
    motor, record = engine.motors[0], network.drive[0]
    record["k_t"], record["R"] = motor.torque_constant_mn_m_a / 1e3, motor.resistance_ohm
    record["I_0"], record["I_max"] = motor.no_load_current_a, motor.current_limit_a
    record["J"], record["U"] = motor.rotor_inertia_g_cm2 / 1e7, motor.supply_voltage_v
    record["efficiency"], record["mode"], record["s"] = motor.driver_efficiency, LOCKED, 1
    moved = [pump["D"] * pump["ratio"] for pump in network.pumps]
    moved += [piston["S"] * piston["ratio"] for piston in network.pistons if piston["driven"]]
    record["q_rad"] = sum(moved)
    record["measured"] = network.piston_names.index(engine.sensor.measures)
    return network


def trains(engine: Engine) -> dict[str, Train]:
    """How each shaft and rod port moves with the motor, following gears and screws from the motor outwards.

    Raises
    ------
    CircuitError
        A shaft or rod that no motor drives, or a train that closes on itself.
    """
    passes = {
        f"{gear.name}.input": (f"{gear.name}.output", 1.0 / gear.ratio, gear.efficiency) for gear in engine.gearboxes
    }
    passes |= {
        f"{screw.name}.shaft": (f"{screw.name}.rod", screw.lead_mm / 1e3 / (2.0 * pi), screw.efficiency)
        for screw in engine.screws
    }
    joined = {port: ports for ports in engine.connections for port in ports}
    found: dict[str, Train] = {}
    waiting = deque([(f"{engine.motors[0].name}.shaft", Train(1.0, 1.0))])
    while waiting:
        start, drive = waiting.popleft()
        for port in joined[start]:
            if port in found:
                raise CircuitError(
                    f"engine: the train closes on itself at {port!r}; gears and screws must branch outwards"
                )
            found[port] = drive
            if port in passes:
                other, ratio, efficiency = passes[port]
                waiting.append((other, Train(drive.ratio * ratio, drive.efficiency * efficiency)))
    mechanical = [
        f"{part.name}.{port}" for part in engine.parts() for port, domain in part.PORTS.items() if domain != "oil"
    ]
    undriven = [port for port in mechanical if port not in found]
    if undriven:
        raise CircuitError(f"engine: no motor drives {', '.join(undriven)}; a gear passes from its input to its output")
    return found


def _oil_nodes(engine: Engine) -> tuple[dict[str, int], list[str]]:
    """Index of the node of each oil port, and the nodes' names."""
    ports = {f"{part.name}.{port}" for part in engine.parts() for port, domain in part.PORTS.items() if domain == "oil"}
    node_of: dict[str, int] = {}
    names: list[str] = []
    for joined in engine.connections:
        if joined[0] in ports:
            node_of |= dict.fromkeys(joined, len(names))
            names.append(" - ".join(joined))
    return node_of, names


def _nodes(engine: Engine, node_of: dict[str, int], names: list[str]) -> Records:
    nodes = np.zeros(len(names), NODE)
    nodes["kind"], nodes["volume"] = OIL, engine.oil.node_volume_ml / 1e6
    nodes["K"] = engine.oil.bulk_modulus_mpa * MEGA
    for store, kind in [(part, BLADDER) for part in engine.bladders] + [(a, ACCUMULATOR) for a in engine.accumulators]:
        n = node_of[f"{store.name}.oil"]
        if nodes[n]["kind"] != OIL:
            raise CircuitError(f"engine: node {names[n]!r} has two stores of oil; put a line between them")
        nodes[n]["kind"] = kind
    bladder = engine.bladders[0]
    nodes[node_of[f"{bladder.name}.oil"]]["stiffness"] = bladder.stiffness_mpa_ml * MEGA**2
    for accumulator in engine.accumulators:
        node = nodes[node_of[f"{accumulator.name}.oil"]]
        node["precharge"] = accumulator.precharge_mpa * MEGA + 101325.0
        node["gas_volume"], node["exponent"] = accumulator.gas_volume_ml / 1e6, accumulator.polytropic_exponent
    return nodes


def _pumps(engine: Engine, node_of: dict[str, int], driven: dict[str, Train]) -> Records:
    rows = [
        (
            node_of[f"{pump.name}.inlet"], node_of[f"{pump.name}.outlet"],
            driven[f"{pump.name}.shaft"].ratio, driven[f"{pump.name}.shaft"].efficiency,
            pump.displacement_ml_r / 1e6 / (2.0 * pi), pump.leakage_ml_s_mpa / 1e12,
            pump.friction_n_m, pump.friction_share, pump.damping_n_m_s,
        )
        for pump in engine.pumps
    ]  # fmt: skip
    return np.array(rows, PUMP)


def _passages(engine: Engine, node_of: dict[str, int]) -> Records:
    def row(name: str, ports: tuple[str, str], kind: int, *numbers: float) -> tuple[float, ...]:
        return (kind, *(node_of[f"{name}.{port}"] for port in ports), *numbers)

    square = MEGA * 1e12  # MPa s2/ml2 in Pa s2/m6
    rows = [
        row(p.name, ("a", "b"), LINE, p.resistance_mpa_s_ml * 1e12, p.loss_mpa_s2_ml2 * square, 0.0, 0.0)
        for p in engine.lines
    ]
    rows += [
        row(
            p.name,
            ("inlet", "outlet"),
            CHECK_VALVE,
            p.resistance_mpa_s_ml * 1e12,
            0.0,
            p.cracking_pressure_mpa * MEGA,
            0.0,
        )
        for p in engine.check_valves
    ]
    rows += [
        row(
            p.name, ("a", "b"), SOLENOID_VALVE, p.resistance_mpa_s_ml * 1e12, p.loss_mpa_s2_ml2 * square, 0.0, p.power_w
        )
        for p in engine.solenoid_valves
    ]
    return np.array(rows, PASSAGE)


def _pistons(engine: Engine, node_of: dict[str, int], driven: dict[str, Train]) -> Records:
    rows = []
    for piston in (*engine.reservoirs, *engine.cylinders):
        rod = driven.get(f"{piston.name}.rod")
        rows.append(
            (
                node_of[f"{piston.name}.oil"], rod is not None,
                rod.ratio if rod else 0.0, rod.efficiency if rod else 1.0, piston.area_m2,
                getattr(piston, "piston_mass_kg", 1.0), piston.coulomb_n, piston.stribeck_n,
                piston.stribeck_mm_s / 1e3, piston.viscous_n_s_m, piston.gas_pressure_mpa * MEGA,
                piston.stroke_mm / 1e3,
            )
        )  # fmt: skip
    return np.array(rows, PISTON)
