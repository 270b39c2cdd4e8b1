"""Writes the flight table that control laws read, from the trim solver."""

from math import radians

import numpy as np

from stommel.analysis.steady_equations import ALPHA, CONVERGED, QUANTITIES, R_PX, V
from stommel.analysis.wings_level import trim_at_ballast
from stommel.control.flight_table import FlightTable
from stommel.dynamics.packing import pack, reference_water
from stommel.dynamics.state import Water
from stommel.errors import StommelError
from stommel.vehicle import FULL, Physics, Vehicle

PITCHES_DEG = tuple(float(pitch) for pitch in range(5, 62, 3))
SHARES = tuple(k / 16 for k in range(1, 17))
"""Of the largest ballast volume."""


def flight_table(vehicle: Vehicle, *, physics: Physics = FULL, water: Water | None = None) -> FlightTable:
    """Trim the vehicle over pitch and ballast volume, in its reference water if no other is given.

    Raises
    ------
    StommelError
        The file gives no range of ballast volume, or the vehicle has no flight at some point of the table.
    """
    engine = vehicle.description.actuators.buoyancy
    if engine is None:
        raise StommelError(f"{vehicle.name}: a flight table needs the table [actuators.buoyancy] with volume_ml")
    water = water or reference_water(vehicle)
    record = pack(vehicle, physics)
    most = max(abs(end) for end in engine.volume_m3)
    theta, V_b = np.radians(PITCHES_DEG), most * np.array(SHARES)
    shape = (2, len(theta), len(V_b))
    r_px, alpha, speed = np.empty(shape), np.empty(shape), np.empty(shape)
    z = np.zeros(QUANTITIES)
    for way, sign in enumerate((-1.0, 1.0)):
        for i, pitch in enumerate(PITCHES_DEG):
            for j, volume in enumerate(V_b):
                if trim_at_ballast(record, sign * radians(pitch), sign * volume, water, z) != CONVERGED:
                    raise StommelError(
                        f"{vehicle.name}: no steady flight at pitch {sign * pitch:g} deg with "
                        f"{sign * volume * 1e6:.1f} ml for its flight table"
                    )
                r_px[way, i, j], alpha[way, i, j], speed[way, i, j] = z[R_PX], z[ALPHA], z[V]
    surge = record.m + record.M_f[0]
    return FlightTable(theta, V_b, r_px, alpha, speed, float(record.K_D0 / surge))
