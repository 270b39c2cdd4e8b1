"""Faults of machinery, hull and battery: what the plant is told."""

from collections.abc import Iterable
from math import inf, isfinite

from stommel.simulation.plant.driven import AS_NEW, Wear
from stommel.simulation.plant.hull_air import Hull
from stommel.simulation.plant.parameters import HOTEL
from stommel.sitl.faults.acting import Acting
from stommel.sitl.plant import Plant

ML_MIN = 1e-6 / 60.0
"""A millilitre a minute [m3/s]."""


def wear_of(acting: Iterable[Acting]) -> Wear:
    """What is worn and broken, by the faults that act now."""
    wear = AS_NEW
    for one in acting:
        if one.kind == "pump_dead":
            wear = wear._replace(pump=0.0)
        elif one.kind == "pump_weak":
            wear = wear._replace(pump=min(wear.pump, one.value))
        elif one.kind == "oil_creeps":
            wear = wear._replace(creep=wear.creep + one.value * ML_MIN)
        elif one.kind == "valve_stuck_open":
            wear = wear._replace(valve=one.value)
        elif one.kind == "valve_stuck_shut":
            wear = wear._replace(valve=0.0)
        elif one.kind == "limit_switch_broken":
            wear = wear._replace(switches=0.0)
        elif one.kind == "mass_jammed":
            wear = wear._replace(mass=min(wear.mass, one.value))
        elif one.kind == "steering_jammed":
            wear = wear._replace(steering=min(wear.steering, one.value))
    return wear


def hull_with(acting: Iterable[Acting], hull: Hull, sound: Hull) -> Hull:
    """The hull as it leaks now; `sound` is that of the scenario, which may leak by itself."""
    rate = sum(one.value for one in acting if one.kind == "hull_leak") * ML_MIN
    if not rate:
        return sound if hull.leak_rate != sound.leak_rate or hull.leak_starts != sound.leak_starts else hull
    own = sound.leak_rate if isfinite(sound.leak_starts) else 0.0
    return sound._replace(leak_starts=min(0.0, sound.leak_starts), leak_rate=own + rate)


def run_down(plant: Plant, share: float) -> None:
    """Use the energy of the battery until this share is left; it does not come back."""
    battery, world = plant.setup.equipment.plant.battery, plant.setup.world
    if battery.energy == inf:
        return
    used = world.energy_total + battery.self_discharge * plant.time
    gone = max(0.0, (1.0 - share) * battery.energy - used)
    world.energy[HOTEL] += gone
    world.energy_total += gone
