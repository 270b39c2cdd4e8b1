"""Writes the flight table that control laws read, from the trim solver."""

from math import cos, degrees, radians

import numpy as np
from numpy.typing import NDArray

from stommel.analysis.linear_equations import LATERAL, linearise_into
from stommel.analysis.steady_equations import ALPHA, CONVERGED, QUANTITIES, R_PX, THETA, V
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
    r_px, alpha, speed, turn_pole, turn_drive = (np.empty(shape) for _ in range(5))
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
                turn_pole[way, i, j], turn_drive[way, i, j] = _turning(vehicle, record, z, water)
    surge = record.m + record.M_f[0]
    return FlightTable(theta, V_b, r_px, alpha, speed, turn_pole, turn_drive, float(record.K_D0 / surge))


def _turning(vehicle: Vehicle, record: np.record, z: NDArray[np.float64], water: Water) -> tuple[float, float]:
    """Slow turning about the flight `z`: r' = pole r + drive times the steering angle; [1/s] and [1/s2].

    The pole is the slowest lateral mode, and the drive is what gives the final turn rate of the whole lateral model,
    psi' = -drive / pole. Zero drive where the vehicle has nothing to steer with, or its sources give no lateral
    coefficients.
    """
    d = vehicle.description
    rudder = d.rudder is not None and d.actuators.rudder is not None
    if list(d.unknown_lateral()) or not (rudder or d.actuators.roll is not None):
        return 0.0, 0.0
    A, B = np.empty((8, 8)), np.empty((8, 4))
    linearise_into(record, z, water, A, B)
    lateral, steering = A[LATERAL, LATERAL], B[LATERAL, 2 if rudder else 3]
    pole = float(np.linalg.eigvals(lateral).real.max())
    final = -np.linalg.solve(lateral, steering)[2] / cos(z[THETA])
    return pole, -pole * float(final)


def fastest_mode(vehicle: Vehicle, theta: float, V_b: float, *, physics: Physics = FULL) -> float:
    """Greatest magnitude of an eigenvalue at pitch `theta` [rad] and ballast `V_b` [m3]: what time steps must follow.

    In the vehicle's reference water; [1/s].

    Raises
    ------
    StommelError
        There is no such flight.
    """
    record, water, z = pack(vehicle, physics), reference_water(vehicle), np.zeros(QUANTITIES)
    if trim_at_ballast(record, theta, V_b, water, z) != CONVERGED:
        raise StommelError(f"{vehicle.name}: no steady flight at pitch {degrees(theta):g} deg with {V_b * 1e6:.1f} ml")
    A, B = np.empty((8, 8)), np.empty((8, 4))
    linearise_into(record, z, water, A, B)
    return float(np.abs(np.linalg.eigvals(A)).max())
