"""Best speed, pitch and depth for endurance and for range, by search over the flights that the vehicle can fly."""

from dataclasses import dataclass
from math import degrees, radians
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stommel.analysis.limits import reachable
from stommel.analysis.steady_equations import ALPHA, CONVERGED, QUANTITIES, R_PX, THETA, V_B, V
from stommel.analysis.wings_level import trim_at_ballast, trim_many
from stommel.design.endurance.dive_cycle import Glides, dive_cycle
from stommel.design.endurance.endurance import DAY
from stommel.dynamics.packing import pack, reference_water
from stommel.errors import StommelError
from stommel.machinery.power.model import EnergyModel
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

    Speeds begin at energy.slowest_speed_m_s; pitches are the specification's. A grid over shares of the speed between
    the slowest and what the ballast gives at each pitch, pitches and depths; then finer grids about the best of it.

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
    lowest = np.array([0.0, radians(gentle), shallow + 0.05 * (deepest_m - shallow)])
    highest = np.array([1.0, radians(steep), deepest_m])
    counts = (SPEEDS, PITCHES, DEPTHS)
    axes = [np.linspace(low, high, count) for low, high, count in zip(lowest, highest, counts, strict=True)]
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
    """Endurance [s] and range [m] over a grid; minus infinity out of reach."""

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
        """Endurance and range on the grid of `axes`: share of the speeds [1], pitch of the climb [rad], depth [m]."""
        fastest = np.array([self.fastest(float(pitch)) for pitch in axes[1]])
        slowest = self.model.plan.slowest_speed_m_s
        speed = slowest + axes[0][:, np.newaxis] * (fastest - slowest)
        pitch = np.broadcast_to(axes[1], speed.shape)
        endurance, distance = self.flown(np.where(fastest >= slowest, speed, np.nan), pitch, axes[2])
        return _Field(axes, endurance, distance)

    def flown(self, speed: Array, pitch: Array, depth: Array) -> tuple[Array, Array]:
        """Endurance [s] and range [m] of dives at pairs of speed and pitch, to each of the depths."""
        shape = (*speed.shape, len(depth))
        endurance, distance = np.full(shape, -np.inf), np.full(shape, -np.inf)
        dive, dives = self._trims(speed.ravel(), -pitch.ravel())
        climb, climbs = self._trims(speed.ravel(), pitch.ravel())
        ok = dives & climbs
        if ok.any():
            with np.errstate(invalid="ignore"):
                cycle = dive_cycle(self.model, glides_from(dive[ok], climb[ok]), depth[np.newaxis, :])
                lasting = self.stored.usable_j / (cycle.total_j / cycle.duration_s + self.stored.self_discharge_w)
            flat = ok.reshape(speed.shape)
            endurance[flat] = np.where(np.isfinite(lasting) & (lasting > 0.0), lasting, -np.inf)
            distance[flat] = endurance[flat] * cycle.distance_m / cycle.duration_s
        return endurance, distance

    def fastest(self, pitch: float) -> float:
        """Speed [m/s] that the whole ballast gives at a pitch [rad], in the dive and in the climb; NaN if none."""
        engine = self.vehicle.description.actuators.buoyancy
        assert engine is not None
        found = FASTEST_M_S
        for side, V_limit in ((-1.0, engine.volume_m3[0]), (1.0, engine.volume_m3[1])):
            z = np.zeros(QUANTITIES)
            if trim_at_ballast(self.record, side * pitch, V_limit, self.water, z) != CONVERGED:
                return float("nan")
            found = min(found, float(z[V]))
        return found * (1.0 - 1e-9)  # inside the limit by more than rounding

    def _trims(self, speed: Array, pitch: Array) -> tuple[Array, NDArray[np.bool_]]:
        flights, flyable = np.zeros((len(speed), QUANTITIES)), np.isfinite(speed)
        codes = trim_many(self.record, np.where(flyable, speed, 1.0), pitch, False, self.water, flights)
        return flights, reachable(self.vehicle, flights, codes) & flyable

    def flight(self, point: Array, lowest: Array, highest: Array) -> BestFlight:
        """The dive at one point, with the limits that it lies at."""
        field = self.over([point[k : k + 1] for k in range(3)])
        slowest, fastest = self.model.plan.slowest_speed_m_s, self.fastest(float(point[1]))
        names = (("slowest speed", "ballast volume"), ("shallowest pitch", "steepest pitch"), ("", "depth"))
        near = 1e-6 * (highest - lowest)
        limits = [
            low for (low, _), x, least, e in zip(names, point, lowest, near, strict=True) if low and x <= least + e
        ]
        limits += [high for (_, high), x, most, e in zip(names, point, highest, near, strict=True) if x >= most - e]
        return BestFlight(
            speed_m_s=float(slowest + point[0] * (fastest - slowest)),
            pitch_deg=-degrees(point[1]),
            depth_m=float(point[2]),
            endurance_s=float(field.endurance[0, 0, 0]),
            range_m=float(field.range[0, 0, 0]),
            limits=tuple(limits + self._beside(point, lowest, highest)),
        )

    def _beside(self, point: Array, lowest: Array, highest: Array) -> list[str]:
        """Say where a little more or less pitch is out of reach: stall, or the travel of the moving mass."""
        found = []
        for step, word in ((-0.01, "shallower"), (0.01, "steeper")):
            pitch = point[1] + step
            if lowest[1] <= pitch <= highest[1]:
                field = self.over([point[:1], np.array([pitch]), point[2:]])
                if not np.isfinite(field.endurance).any():
                    found.append(f"a {word} pitch cannot be flown")
        return found


def endurance_over_speed(
    vehicle: Vehicle, model: EnergyModel, physics: Physics, pitch_deg: float, depth_m: float
) -> tuple[Array, Array, Array]:
    """Speeds [m/s] that can be flown at one pitch, endurance [days] and range [km] there."""
    speeds = np.linspace(model.plan.slowest_speed_m_s, FASTEST_M_S, 241)
    pitch = np.full_like(speeds, radians(abs(pitch_deg)))
    endurance, distance = _Search(vehicle, model, physics).flown(speeds, pitch, np.array([depth_m]))
    flown = np.isfinite(endurance[:, 0])
    return speeds[flown], endurance[flown, 0] / DAY, distance[flown, 0] / 1e3


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
        drive=column(np.abs(dive[:, V_B])),
        sinking_at_drive=column(-dive[:, V] * np.sin(gamma_down)),
    )
