"""The circuit at rest, and what is stored in it at any time: oil and energy."""

import numpy as np

from stommel.machinery.engine.circuit_equations import P_ATM
from stommel.machinery.engine.network import ACCUMULATOR, BLADDER, LINE, OIL, Network
from stommel.machinery.engine.results import Array
from stommel.vehicle.schema import Engine


def at_rest(network: Network, engine: Engine, *, full: bool) -> Array:
    """State at rest: the measured piston at the end of its range, every node at the pressure of what it is open to."""
    y = np.zeros(network.size)
    positions = slice(network.first_position, network.first_velocity)
    for i, piston in enumerate((*engine.reservoirs, *engine.cylinders)):
        y[network.first_position + i] = piston.working_range_mm[0 if full else 1] / 1e3
    measured = engine.measured_piston
    y[1 + network.bladder] = measured.working_volume_ml / 1e6 if full else 0.0
    sea = network.drive[0]["pressure"] + network.nodes[network.bladder]["stiffness"] * y[1 + network.bladder]
    open_to_sea = {network.bladder}
    lines = [(row["a"], row["b"]) for row in network.passages if row["kind"] == LINE]
    for _ in lines:
        for a, b in lines:
            if a in open_to_sea or b in open_to_sea:
                open_to_sea |= {int(a), int(b)}
    inside = float(network.pistons[0]["gas"])
    for n, node in enumerate(network.nodes):
        held = network.pistons["node"] == n
        chambers = float(np.sum(network.pistons["S"][held] * y[positions][held]))
        p = sea if n in open_to_sea else inside
        if node["kind"] == OIL:
            y[1 + n] = p * (node["volume"] + chambers) / node["K"]
        elif node["kind"] == ACCUMULATOR:
            filled = node["gas_volume"] * (1.0 - (node["precharge"] / max(p + P_ATM, 1.0)) ** (1.0 / node["exponent"]))
            empty = (p + P_ATM - node["precharge"]) * (node["volume"] + chambers) / node["K"]
            y[1 + n] = filled if filled > 0.0 else empty
            network.opened[len(network.passages) + n] = int(filled > 0.0)
    return y


def stored_energy(network: Network, y: Array) -> float:
    """Energy in rotor, pistons, compressed oil, bladder and accumulators [J]."""
    positions = y[network.first_position : network.first_velocity]
    velocities = y[network.first_velocity : network.first_entry]
    energy = 0.5 * network.drive[0]["J"] * y[0] ** 2 + 0.5 * float(np.sum(network.pistons["mass"] * velocities**2))
    for n, node in enumerate(network.nodes):
        stock = y[1 + n]
        held = network.pistons["node"] == n
        volume = node["volume"] + float(np.sum(network.pistons["S"][held] * positions[held]))
        if node["kind"] == BLADDER:
            energy += 0.5 * node["stiffness"] * stock**2
        elif node["kind"] == ACCUMULATOR and stock > 0.0:
            V, p, k = node["gas_volume"], node["precharge"], node["exponent"]
            share = V / (V - stock)
            work = p * V * np.log(share) if k == 1.0 else p * V / (k - 1.0) * (share ** (k - 1.0) - 1.0)
            energy += work - P_ATM * stock
        elif node["kind"] == ACCUMULATOR:
            energy += (node["precharge"] - P_ATM) * stock + 0.5 * node["K"] * stock**2 / volume
        else:
            energy += 0.5 * node["K"] * stock**2 / volume
    return float(energy)


def all_oil(network: Network, y: Array) -> float:
    """Oil in nodes and chambers, as volume without pressure [m3]."""
    positions = y[network.first_position : network.first_velocity]
    return float(np.sum(y[1 : network.first_position]) + np.sum(network.pistons["S"] * positions))
