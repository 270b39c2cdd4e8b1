"""Writes the flight table that control laws read, from the trim solver."""

import copy
from math import degrees

import numpy as np
from numpy.typing import NDArray

from stommel.analysis.linear_equations import LATERAL, linearise_into
from stommel.analysis.steady_equations import ALPHA, CONVERGED, QUANTITIES, R_PX, THETA, V
from stommel.analysis.wings_level import trim_at_ballast
from stommel.compilation import compiled
from stommel.control.flight_table import FlightTable
from stommel.dynamics.packing import pack, reference_water
from stommel.errors import StommelError
from stommel.seawater.water import Water
from stommel.vehicle import FULL, Physics, Vehicle
from stommel.vehicle.missing_table import missing_table

Array = NDArray[np.float64]

PITCHES_DEG = tuple(float(pitch) for pitch in range(5, 62, 3))
SHARES = tuple(k / 16 for k in range(1, 17))
"""Of the largest ballast volume."""

_COLUMNS = {"rudder": 2, "roll": 3}
"""Of the inputs that steer."""

_KEPT = 8
_tables: dict[tuple[bytes, int | None, float, Water], FlightTable] = {}
"""The last tables of this process: most missions of a study share one."""


def flight_table(vehicle: Vehicle, *, physics: Physics = FULL, water: Water | None = None) -> FlightTable:
    """Trim the vehicle over pitch and ballast volume, in its reference water if no other is given.

    Raises
    ------
    StommelError
        The file gives no range of ballast volume, or the vehicle has no flight at some point of the table.
    """
    engine = vehicle.description.actuators.buoyancy
    if engine is None:
        raise StommelError(
            f"{vehicle.name}: a flight table needs the table [actuators.buoyancy] with volume_ml; "
            f"{missing_table('actuators.buoyancy')}"
        )
    water = water or reference_water(vehicle)
    record = pack(vehicle, physics)
    most = max(abs(end) for end in engine.volume_m3)
    key = (record.tobytes(), _steering(vehicle), most, water)
    if key not in _tables:
        table = _computed(vehicle, record, most, water)
        if len(_tables) >= _KEPT:
            _tables.clear()
        _tables[key] = table
    # copies: what one caller writes into its table must not reach the next
    return copy.deepcopy(_tables[key])


def _steering(vehicle: Vehicle) -> int | None:
    """Input that steers the vehicle; None if it has nothing to steer with, or its sources give no lateral plane."""
    d = vehicle.description
    if list(d.unknown_lateral()):
        return None
    return _COLUMNS[d.steers_by] if d.steers_by is not None else None


def _computed(vehicle: Vehicle, record: np.record, most: float, water: Water) -> FlightTable:
    theta, V_b = np.radians(PITCHES_DEG), most * np.array(SHARES)
    way, pitches, volumes = np.meshgrid((-1.0, 1.0), theta, V_b, indexing="ij")
    shape, pitch, volume = way.shape, (way * pitches).ravel(), (way * volumes).ravel()
    steering = _steering(vehicle)
    flights = np.empty((pitch.size, QUANTITIES))
    A, B = (np.empty((0 if steering is None else pitch.size, 8, n)) for n in (8, 4))
    done = _flights(record, pitch, volume, water, flights, A, B)
    if done < pitch.size:
        raise StommelError(
            f"{vehicle.name}: no steady flight at pitch {degrees(pitch[done]):g} deg with "
            f"{volume[done] * 1e6:.1f} ml for its flight table"
        )
    pole, drive = np.zeros(pitch.size), np.zeros(pitch.size)
    if steering is not None:
        pole, drive = _turning(A[:, LATERAL, LATERAL], B[:, LATERAL, steering], flights[:, THETA])
    columns = (flights[:, R_PX], flights[:, ALPHA], flights[:, V], pole, drive)
    r_px, alpha, speed, turn_pole, turn_drive = (np.ascontiguousarray(column).reshape(shape) for column in columns)
    surge = record.m + record.M_f[0]
    return FlightTable(theta, V_b, r_px, alpha, speed, turn_pole, turn_drive, float(record.K_D0 / surge))


@compiled
def _flights(
    record: np.record,
    pitch: np.ndarray,
    volume: np.ndarray,
    water: Water,
    flights: np.ndarray,
    A: np.ndarray,
    B: np.ndarray,
) -> int:
    """Trim at every pitch [rad] and ballast volume [m3], and linearise if `A` has room; return how many were found."""
    for k in range(len(pitch)):
        if trim_at_ballast(record, pitch[k], volume[k], water, flights[k]) != CONVERGED:
            return k
        if len(A) > 0:
            linearise_into(record, flights[k], water, A[k], B[k])
    return len(pitch)


def _turning(lateral: Array, steering: Array, theta: Array) -> tuple[Array, Array]:
    """Slow turning about each flight: r' = pole r + drive times the steering angle; [1/s] and [1/s2].

    The pole is the slowest lateral mode, and the drive is what gives the final turn rate of the whole lateral model,
    psi' = -drive / pole.
    """
    pole = np.linalg.eigvals(lateral).real.max(axis=1)
    final = -np.linalg.solve(lateral, steering[:, :, None])[:, 2, 0] / np.cos(theta)
    return pole, -pole * final


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
