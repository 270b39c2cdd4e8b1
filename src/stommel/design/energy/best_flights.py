"""Best speed, pitch and depth for endurance and for range, by search over the flights that the vehicle can fly."""

from dataclasses import dataclass
from math import degrees, radians
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stommel.analysis.limits import reachable
from stommel.analysis.steady_equations import ALPHA, QUANTITIES, R_PX, THETA, V_B, V
from stommel.analysis.wings_level import trim_many
from stommel.design.energy.dive_cycle import Glides, dive_cycle
from stommel.design.energy.endurance import DAY
from stommel.design.energy.model import EnergyModel
from stommel.dynamics.packing import pack, reference_water
from stommel.errors import StommelError
from stommel.vehicle import Physics, Vehicle

Array = NDArray[np.float64]

FASTEST_M_S = 2.5
SPEEDS, PITCHES, DEPTHS = 17, 17, 5
REFINEMENTS, FINE = 5, 7
SHALLOWEST_DEG, STEEPEST_DEG = 5.0, 85.0
"""Pitches of the search where the file has no specification of them."""


class NoDiveError(StommelError):
    """The vehicle can fly no dive at all."""


@dataclass(frozen=True)
class BestFlight:
    """The dive that lasts longest, or reaches farthest."""

    speed_m_s: float
    pitch_deg: float
    depth_m: float
    endurance_s: float
    range_m: float
    limits: tuple[str, ...]
    """What keeps it from being better still: keys of limits that it lies at."""

    def as_row(self) -> dict[str, Any]:
        """The dive in words with units."""
        return {
            "speed_m_s": self.speed_m_s,
            "pitch_deg": self.pitch_deg,
            "depth_m": self.depth_m,
            "endurance_days": self.endurance_s / DAY,
            "range_km": self.range_m / 1e3,
            "limited_by": list(self.limits),
        }


@dataclass(frozen=True)
class BestFlights:
    """Both optima; they hardly ever coincide."""

    longest: BestFlight
    farthest: BestFlight


def best_flights(vehicle: Vehicle, model: EnergyModel, *, physics: Physics, deepest_m: float) -> BestFlights:
    """Search speeds, pitches and depths for the longest and the farthest mission.

    Speeds begin at energy.slowest_speed_m_s; pitches are the specification's. A grid over everything
    reachable, then finer grids about the best of it.

    Raises
    ------
    NoDiveError
        No dive with a climb as fast is within the limits.
    """
    slowest = model.plan.slowest_speed_m_s
    shallow = model.plan.upper_turn_m if model.plan.dives_per_surfacing > 1 else 0.0
    if not shallow < deepest_m:
        raise NoDiveError(f"depth = {deepest_m:g} m: must be deeper than energy.upper_turn_m = {shallow:g}")
    spec = vehicle.description.specification
    gentle, steep = (spec.shallowest_pitch_deg, spec.pitch_deg) if spec else (SHALLOWEST_DEG, STEEPEST_DEG)
    lowest = np.array([slowest, radians(gentle), shallow + 0.05 * (deepest_m - shallow)])
    highest = np.array([max(FASTEST_M_S, slowest), radians(steep), deepest_m])
    axes = [
        np.geomspace(lowest[0], highest[0], SPEEDS),
        np.linspace(lowest[1], highest[1], PITCHES),
        np.linspace(lowest[2], highest[2], DEPTHS),
    ]
    search = _Search(vehicle, model, physics)
    first = search.over(axes)
    found = {}
    for merit in ("endurance", "range"):
        best, cell, grid = first.best(merit), [_cell(axis) for axis in axes], axes
        if best is None:
            raise NoDiveError(
                f"{vehicle.name}: no dive from energy.slowest_speed_m_s = {slowest:g} m/s upwards is within the "
                "limits of the vehicle"
            )
        for _ in range(REFINEMENTS):
            grid = [
                np.unique(np.clip(x + c * np.linspace(-1.0, 1.0, FINE), low, high))
                for x, c, low, high in zip(best.point, cell, lowest, highest, strict=True)
            ]
            cell = [c / 3.0 for c in cell]
            finer = search.over(grid).best(merit)
            if finer is not None and finer.value >= best.value:
                best = finer
        found[merit] = search.flight(best.point, lowest, highest)
    return BestFlights(longest=found["endurance"], farthest=found["range"])


def _cell(axis: Array) -> float:
    return float(np.max(np.diff(axis))) if len(axis) > 1 else 0.0


@dataclass(frozen=True)
class _Point:
    point: Array
    value: float


@dataclass(frozen=True)
class _Field:
    """Endurance [s] and range [m] over a grid of speeds, pitches and depths; minus infinity out of reach."""

    axes: list[Array]
    endurance: Array
    range: Array

    def best(self, merit: str) -> _Point | None:
        values = getattr(self, merit)
        k = np.unravel_index(int(np.argmax(values)), values.shape)
        value = float(values[k])
        if not np.isfinite(value):
            return None
        return _Point(np.array([axis[i] for axis, i in zip(self.axes, k, strict=True)]), value)


class _Search:
    """Evaluates grids of dives."""

    def __init__(self, vehicle: Vehicle, model: EnergyModel, physics: Physics) -> None:
        self.vehicle, self.model = vehicle, model
        self.record, self.water = pack(vehicle, physics), reference_water(vehicle)
        self.stored = model.stored

    def over(self, axes: list[Array]) -> _Field:
        """Endurance and range on the grid of `axes`: speed [m/s], pitch of the climb [rad], depth [m]."""
        speed, pitch = (grid.ravel() for grid in np.meshgrid(axes[0], axes[1], indexing="ij"))
        dive, dives = self._trims(speed, -pitch)
        climb, climbs = self._trims(speed, pitch)
        ok = dives & climbs
        shape = (len(axes[0]), len(axes[1]), len(axes[2]))
        endurance, distance = np.full(shape, -np.inf), np.full(shape, -np.inf)
        if ok.any():
            cycle = dive_cycle(self.model, glides_from(dive[ok], climb[ok]), axes[2][np.newaxis, :])
            power = cycle.total_j / cycle.duration_s + self.stored.self_discharge_w
            lasting = self.stored.usable_j / power
            flat = ok.reshape(shape[:2])
            endurance[flat] = np.where(np.isfinite(lasting) & (lasting > 0.0), lasting, -np.inf)
            distance[flat] = endurance[flat] * cycle.distance_m / cycle.duration_s
        return _Field(axes, endurance, distance)

    def _trims(self, speed: Array, pitch: Array) -> tuple[Array, NDArray[np.bool_]]:
        flights = np.zeros((len(speed), QUANTITIES))
        codes = trim_many(self.record, speed, pitch, False, self.water, flights)
        return flights, reachable(self.vehicle, flights, codes)

    def flight(self, point: Array, lowest: Array, highest: Array) -> BestFlight:
        """The dive at one point, with the limits that it lies at."""
        field = self.over([point[k : k + 1] for k in range(3)])
        limits = []
        if point[0] <= lowest[0] * (1.0 + 1e-6):
            limits.append("energy.slowest_speed_m_s")
        if point[1] <= lowest[1] * (1.0 + 1e-6):
            limits.append("shallowest pitch")
        if point[1] >= highest[1] * (1.0 - 1e-6):
            limits.append("steepest pitch")
        if point[2] >= highest[2] * (1.0 - 1e-6):
            limits.append("depth")
        limits += self._broken_beside(point)
        return BestFlight(
            speed_m_s=float(point[0]),
            pitch_deg=-degrees(point[1]),
            depth_m=float(point[2]),
            endurance_s=float(field.endurance[0, 0, 0]),
            range_m=float(field.range[0, 0, 0]),
            limits=tuple(limits),
        )

    def _broken_beside(self, point: Array) -> list[str]:
        """Limits of the vehicle that a little more or less pitch, or more speed, would break."""
        beside = [(1.0, -0.01), (1.0, 0.01), (1.005, 0.0)]
        words = ("a shallower pitch is out of reach", "a steeper pitch is out of reach", "faster is out of reach")
        speed = np.array([point[0] * factor for factor, _ in beside])
        pitch = np.array([point[1] + step for _, step in beside])
        fine = self._trims(speed, -pitch)[1] & self._trims(speed, pitch)[1]
        return [word for word, ok in zip(words, fine, strict=True) if not ok]


def glides_from(dive: Array, climb: Array) -> Glides:
    """Return what a cycle needs of many flights (N x 10), as columns, so that depths broadcast along rows."""

    def column(values: Array) -> Array:
        return values[:, np.newaxis]

    gamma_down, gamma_up = dive[:, THETA] - dive[:, ALPHA], climb[:, THETA] - climb[:, ALPHA]
    return Glides(
        V=column(dive[:, V]),
        down=column(-dive[:, V] * np.sin(gamma_down)),
        up=column(climb[:, V] * np.sin(gamma_up)),
        over_ground_down=column(dive[:, V] * np.cos(gamma_down)),
        over_ground_up=column(climb[:, V] * np.cos(gamma_up)),
        V_dive=column(dive[:, V_B]),
        V_climb=column(climb[:, V_B]),
        r_dive=column(dive[:, R_PX]),
        r_climb=column(climb[:, R_PX]),
        pitch_dive=column(dive[:, THETA]),
        pitch_climb=column(climb[:, THETA]),
    )
