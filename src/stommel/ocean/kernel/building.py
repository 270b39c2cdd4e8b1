"""From fields on latitudes and longitudes to the grid that compiled code reads."""

from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from stommel.ocean.errors import UnknownOceanError
from stommel.ocean.kernel.chart import Chart, centre_of, chart_at, project_nodes
from stommel.ocean.kernel.grid import CT, ERROR, FIELDS, S_A, U_X, U_Y, Nodes, OceanGrid, T

_WIDEST = np.radians(120.0)
"""Farthest that a node may lie from the centre of the plane; at 180 degrees it would lie at infinity."""

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Frame:
    """Where and when an ocean has values: what does not change with time."""

    times: Array
    """[s since 1970-01-01 UTC], increasing."""
    time_range: tuple[float, float]
    """First and last time that the values speak for [s]."""
    depths: Array
    """[m], positive down, increasing."""
    latitude: Array
    """Of the nodes (j, i) [rad]."""
    longitude: Array
    """Of the nodes (j, i) [rad]."""
    bottom: Array | None
    """Depth of the bottom (j, i) [m]; nan, or above the surface, where unknown. None: the deepest level with water."""
    tide_speed: Array = field(default_factory=lambda: np.zeros(0))
    """[rad/s]"""
    tide: Array | None = None
    """(constituent, j, i, 4): east cos, east sin, north cos, north sin [m/s]."""
    profile_depths: Array = field(default_factory=lambda: np.zeros(0))
    """Depths of a density given directly [m]."""
    profile_rho: Array = field(default_factory=lambda: np.zeros(0))
    """That density [kg/m3]."""
    period: float = np.inf
    """Times repeat after so long [s]."""


@dataclass(frozen=True)
class Slot:
    """Fields at one time, each (level, j, i), nan where there is no water; SI, temperatures in deg C."""

    T: Array
    """In-situ temperature."""
    S_A: Array
    """Absolute Salinity [g/kg]."""
    CT: Array
    """Conservative Temperature."""
    U_east: Array
    """[m/s]"""
    U_north: Array
    """[m/s]"""


def ocean_grid(frame: Frame, slots: Iterable[Slot], *, mean_slot: bool = False) -> OceanGrid:
    """Build the grid; one slot at a time is in memory at double precision.

    With `mean_slot` there is room for the mean over time after the last slot. Outside its data the ocean refuses; other
    policies are set by `stommel.ocean.kernel.outside`.

    Raises
    ------
    UnknownOceanError
        The nodes reach too far around the Earth, or no node has water.
    """
    chart, plane = _plane(frame)
    count = len(frame.times)
    again = 1 if np.isfinite(frame.period) else 0
    shape = (count + again + int(mean_slot), *frame.latitude.shape, FIELDS, len(frame.depths))
    water = np.full(shape, np.nan, dtype=np.float32)
    for n, slot in enumerate(slots):
        _write(water[n], slot, plane)
    levels = _levels(water[:count])
    if not levels.any():
        raise UnknownOceanError("the ocean has no place with temperature, salinity and currents at all of its times")
    _carry_down(water[:count], levels)
    times = frame.times
    if again:
        water[count] = water[0]
        times = np.append(times, times[0] + frame.period)
    if mean_slot:
        water[-1] = water[:count].mean(axis=0)
    nodes = Nodes(
        times, frame.period, frame.depths, plane[0], plane[1], water, levels, _bottom(frame, levels), frame.tide_speed,
        _plane_tide(frame, plane), frame.profile_depths, frame.profile_rho, chart,
        np.array(frame.time_range, dtype=np.float64),
    )  # fmt: skip
    return OceanGrid(nodes, ERROR, ERROR, nothing(chart), ERROR, 0.0, 0.0)


def nothing(chart: Chart) -> Nodes:
    """Return a single node of no meaning, for the place behind an ocean that has nothing there."""
    one = np.zeros((1, 1))
    return Nodes(
        np.zeros(1), np.inf, np.zeros(1), one, one, np.zeros((1, 1, 1, FIELDS, 1), dtype=np.float32),
        np.ones((1, 1), dtype=np.int32), one, np.zeros(0), np.zeros((0, 1, 1, 4), dtype=np.float32), np.zeros(0),
        np.zeros(0), chart, np.array([-np.inf, np.inf]),
    )  # fmt: skip


def _plane(frame: Frame) -> tuple[Chart, Array]:
    """Chart, and x, y, north_x, north_y of the nodes (4, j, i); a single node keeps (east, north)."""
    latitude, longitude = frame.latitude, frame.longitude
    middle = centre_of(latitude, longitude)
    chart = chart_at(*middle)
    cosine = np.sin(middle[0]) * np.sin(latitude) + np.cos(middle[0]) * np.cos(latitude) * np.cos(longitude - middle[1])
    farthest = float(np.arccos(np.clip(cosine.min(), -1.0, 1.0)))
    if farthest > _WIDEST:
        raise UnknownOceanError(
            f"the ocean reaches {np.degrees(farthest):.0f} degrees from its centre; at most {np.degrees(_WIDEST):.0f} "
            "are allowed: cut it to the region of the mission (bounds = south, north, west, east)"
        )
    out = np.empty((latitude.size, 4))
    project_nodes(chart, latitude.ravel(), longitude.ravel(), out)
    plane = np.ascontiguousarray(out.T).reshape(4, *latitude.shape)
    if latitude.size == 1:
        plane[2:] = np.array([0.0, 1.0])[:, None, None]
    return chart, plane


def _write(out: NDArray[np.float32], slot: Slot, plane: Array) -> None:
    north_x, north_y = plane[2], plane[3]
    out[:, :, T] = np.moveaxis(slot.T, 0, -1)
    out[:, :, S_A] = np.moveaxis(slot.S_A, 0, -1)
    out[:, :, CT] = np.moveaxis(slot.CT, 0, -1)
    # east lies a right angle clockwise of north
    out[:, :, U_X] = np.moveaxis(slot.U_east * north_y + slot.U_north * north_x, 0, -1)
    out[:, :, U_Y] = np.moveaxis(slot.U_north * north_y - slot.U_east * north_x, 0, -1)


def _plane_tide(frame: Frame, plane: Array) -> NDArray[np.float32]:
    if frame.tide is None:
        return np.zeros((0, *frame.latitude.shape, 4), dtype=np.float32)
    east, north = frame.tide[..., :2], frame.tide[..., 2:]
    north_x, north_y = plane[2][..., None], plane[3][..., None]
    both = [east * north_y + north * north_x, north * north_y - east * north_x]
    return np.ascontiguousarray(np.concatenate(both, axis=-1), dtype=np.float32)


def _levels(water: NDArray[np.float32]) -> NDArray[np.int32]:
    """Levels from the surface down to the first that lacks a field at some time."""
    present = np.isfinite(water).all(axis=(0, 3))
    levels: NDArray[np.int32] = np.cumprod(present, axis=-1).sum(axis=-1).astype(np.int32)
    return levels


def _carry_down(water: NDArray[np.float32], levels: NDArray[np.int32]) -> None:
    """Carry on the deepest values below the last level; nodes on land get zeros, which no weight ever reaches."""
    for k in range(1, water.shape[-1]):
        below = (levels <= k) & (levels > 0)
        water[:, below, :, k] = water[:, below, :, k - 1]
    water[:, levels == 0] = 0.0


def _bottom(frame: Frame, levels: NDArray[np.int32]) -> Array:
    deepest = frame.depths[np.maximum(levels - 1, 0)]
    bottom = deepest if frame.bottom is None else np.where(frame.bottom > 0.0, frame.bottom, deepest)
    return np.where(levels > 0, bottom, 0.0)
