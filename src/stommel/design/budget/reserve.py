"""Reserve of the buoyancy engine over the densities of a sea area."""

from dataclasses import dataclass
from math import sqrt
from typing import Any

from stommel.analysis.trim import trim
from stommel.errors import StommelError
from stommel.vehicle import Vehicle

POINTS = 5
"""Densities of a range that are shown."""


@dataclass(frozen=True)
class ReserveRow:
    """The engine in one water. Volumes are ballast volumes, zero at the middle of trimming."""

    rho: float
    """[kg/m3]."""
    neutral: float
    """Ballast volume at which the vehicle floats without weight [m3]."""
    to_dive: float
    """What is left to sink with [m3]; negative: it cannot sink."""
    to_climb: float
    """What is left to rise with at the greatest depth [m3]; negative: it cannot rise."""
    dive_speed: float | None
    """Speed at the design pitch with all of it [m/s]; None where there is no reserve, and where unknown."""
    climb_speed: float | None
    """Likewise, upwards."""

    def as_row(self) -> dict[str, float | None]:
        """The row in words with units."""
        return {
            "density_kg_m3": self.rho,
            "neutral_ballast_ml": self.neutral * 1e6,
            "to_sink_ml": self.to_dive * 1e6,
            "to_rise_ml": self.to_climb * 1e6,
            "dive_speed_m_s": self.dive_speed,
            "climb_speed_m_s": self.climb_speed,
        }


@dataclass(frozen=True)
class Reserve:
    """The engine over a range of densities, for a vehicle trimmed in the middle of it."""

    trimmed_for: float
    """Density in which the vehicle is neutral at zero ballast [kg/m3]."""
    compression: float
    """Volume that the hull loses at the greatest depth [m3]."""
    rows: tuple[ReserveRow, ...]
    sinks_and_rises: tuple[float, float] | None
    """Densities between which it can do both [kg/m3]; None where there are none."""
    design_speed: float | None
    """[m/s]."""
    flies: tuple[float, float] | None
    """Densities between which it reaches the design speed both ways [kg/m3]; None where unknown or none."""

    @property
    def least(self) -> float:
        """Least of all reserves [m3]."""
        return min(min(row.to_dive, row.to_climb) for row in self.rows)

    def as_row(self) -> dict[str, Any]:
        """The reserve in words with units."""
        return {
            "trimmed_for_kg_m3": self.trimmed_for,
            "compression_ml": self.compression * 1e6,
            "sinks_and_rises_kg_m3": self.sinks_and_rises,
            "design_speed_m_s": self.design_speed,
            "flies_kg_m3": self.flies,
            "rows": [row.as_row() for row in self.rows],
        }


def best_trim_density(vehicle: Vehicle, volume: float, low: float, high: float) -> float:
    """Density to trim for, so that the engine's reserve is the same at both ends of a range (eq-w7) [kg/m3]."""
    engine = vehicle.description.actuators.buoyancy
    if engine is None:
        return 0.5 * (low + high)
    middle = 0.5 * (sum(engine.volume_m3) - compression(vehicle, volume, 0.5 * (low + high)))
    return (1.0 + middle / volume) * 2.0 / (1.0 / low + 1.0 / high)


def compression(vehicle: Vehicle, volume: float, rho: float) -> float:
    """Volume that the hull loses at the depth of its rating [m3]; 0 where the file says nothing of it."""
    d = vehicle.description
    if d.hull is None or d.hull.depth_rating_m is None:
        return 0.0
    return volume * d.hull.compressibility_per_pa * rho * d.water.gravity_m_s2 * d.hull.depth_rating_m


def reserve(vehicle: Vehicle, volume: float, trimmed_for: float, low: float, high: float) -> Reserve | None:
    """Reserve of a vehicle that displaces `volume` [m3] at neutral ballast and is trimmed for a density [kg/m3].

    None where the file has no [actuators.buoyancy].
    """
    engine = vehicle.description.actuators.buoyancy
    if engine is None:
        return None
    least, most = engine.volume_m3
    shrinks = compression(vehicle, volume, 0.5 * (low + high))
    mass = trimmed_for * volume
    speed, dive, climb = _design_volumes(vehicle)

    def row(rho: float) -> ReserveRow:
        neutral = mass / rho - volume
        to_dive, to_climb = neutral - least, most - neutral - shrinks
        return ReserveRow(rho, neutral, to_dive, to_climb, _speed(speed, to_dive, dive), _speed(speed, to_climb, climb))

    count = 1 if low == high else POINTS
    densities = [low + (high - low) * k / max(count - 1, 1) for k in range(count)]
    return Reserve(
        trimmed_for,
        shrinks,
        tuple(row(rho) for rho in densities),
        _band(mass, volume, least, most - shrinks),
        speed,
        _band(mass, volume, least + dive, most - shrinks - climb) if speed is not None else None,
    )


def _band(mass: float, volume: float, low: float, high: float) -> tuple[float, float] | None:
    """Densities whose neutral ballast lies between two volumes."""
    return (mass / (volume + high), mass / (volume + low)) if low <= high else None


def _design_volumes(vehicle: Vehicle) -> tuple[float | None, float, float]:
    """Design speed [m/s], and the ballast below and above neutral that it takes at the design pitch [m3]."""
    spec = vehicle.description.specification
    if spec is None or spec.design_speed_m_s is None or spec.design_pitch_deg is None:
        return None, 0.0, 0.0
    try:
        dive, climb = (
            trim(vehicle, speed_m_s=spec.design_speed_m_s, pitch_deg=side * spec.design_pitch_deg, within_limits=False)
            for side in (-1.0, 1.0)
        )
    except StommelError:
        return None, 0.0, 0.0
    return spec.design_speed_m_s, -dive.V_b, climb.V_b


def _speed(design: float | None, have: float, need: float) -> float | None:
    """Speed that a ballast volume gives: its square grows with the volume (eq-s6).

    The coefficients of drag and the net weight both grow with the density, so that it does not enter.
    """
    return None if design is None or need <= 0.0 or have <= 0.0 else design * sqrt(have / need)
