"""What moving oil, mass and rudder costs in electrical energy and time: the inputs of a dive cycle.

A cost is a small table, so that a search over thousands of flights only interpolates. Where the tables come from (the
engine's equations, the drives' equations, or an efficiency) is a matter of `stommel.machinery.power.actuator_models`.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from stommel.errors import StommelError

Array = NDArray[np.float64]
Quantity = float | Array
"""A number, or an array of them that broadcasts with the others."""


class PumpStallError(StommelError):
    """The pump cannot push oil against this pressure."""


@dataclass(frozen=True)
class PumpWork:
    """Cost of inflating and deflating the bladder, over the sea's pressure."""

    pressure_pa: Array
    """Gauge pressure at the bladder, rising [Pa]."""
    inflating_j_m3: Array
    """Electrical energy per volume into the bladder [J/m3]; infinite where the pump stalls."""
    inflating_m3_s: Array
    """Flow into the bladder [m3/s]."""
    deflating_j_m3: Array
    """Electrical energy per volume out of the bladder [J/m3]."""
    deflating_m3_s: Array
    """Flow out of the bladder [m3/s]."""
    origin: str
    """Where the numbers come from."""
    starting_j: Array
    """Electrical energy of a start of the pump, whatever the volume [J]."""
    starting_s: float = 0.0
    """Time of a start of the pump, whatever the volume [s]."""

    def inflation(self, volume_m3: Quantity, pressure_pa: Quantity) -> tuple[Array, Array]:
        """Energy [J] and time [s] of pumping a volume into the bladder at a pressure."""
        volume = np.maximum(volume_m3, 0.0)
        energy, flow = self._at(pressure_pa, self.inflating_j_m3), self._at(pressure_pa, self.inflating_m3_s)
        starting, moves = self._at(pressure_pa, self.starting_j), volume > 0.0
        return volume * energy + starting * moves, volume / flow + self.starting_s * moves

    def deflation(self, volume_m3: Quantity, pressure_pa: Quantity) -> tuple[Array, Array]:
        """Energy [J] and time [s] of letting a volume out of the bladder at a pressure."""
        volume = np.maximum(volume_m3, 0.0)
        energy, flow = self._at(pressure_pa, self.deflating_j_m3), self._at(pressure_pa, self.deflating_m3_s)
        return volume * energy, volume / flow

    def _at(self, pressure_pa: Quantity, column: Array) -> Array:
        return np.asarray(np.interp(pressure_pa, self.pressure_pa, column))

    def check(self, pressure_pa: float) -> None:
        """Refuse a pressure beyond the table, or one at which the pump stalls.

        Raises
        ------
        PumpStallError
            The pump moves no oil at this pressure.
        """
        strong = self.pressure_pa[np.isfinite(self.inflating_j_m3)]
        most = float(strong[-1]) if len(strong) else 0.0
        if pressure_pa > most * (1.0 + 1e-9):
            raise PumpStallError(
                f"the buoyancy engine cannot inflate at {pressure_pa / 1e6:.3f} MPa; it does so up to "
                f"{most / 1e6:.3f} MPa ({self.origin})"
            )

    def scaled(self, factor: float) -> "PumpWork":
        """Return the same engine with all energies multiplied."""
        return replace(
            self,
            inflating_j_m3=factor * self.inflating_j_m3,
            deflating_j_m3=factor * self.deflating_j_m3,
            starting_j=factor * self.starting_j,
        )


@dataclass(frozen=True)
class PitchDriveWork:
    """Cost of moving the mass forward, over the pitch; moving aft costs what moving forward costs at minus the pitch.

    Gravity along the hull is m_p g sin(theta), and friction is the same both ways. While the mass moves, the vehicle
    passes through the equilibria in between: tan(theta) goes in proportion to its position.
    """

    slope: Array
    """tan(theta), rising."""
    forward_j_m: Array
    """Electrical energy per metre forward [J/m]."""
    forward_s_m: Array
    """Time per metre forward [s/m]."""
    origin: str

    def move(self, r_from: Quantity, r_to: Quantity, pitch_from: Quantity, pitch_to: Quantity) -> tuple[Array, Array]:
        """Energy [J] and time [s] of a change of trim."""
        travel = np.asarray(r_to, dtype=np.float64) - r_from
        side = np.where(travel < 0.0, -1.0, 1.0)
        first, last = np.asarray(side * np.tan(pitch_from)), np.asarray(side * np.tan(pitch_to))
        distance = np.abs(travel)
        with np.errstate(invalid="ignore"):  # infinite less infinite, where the motor stalls
            return (
                distance * self._mean(first, last, self.forward_j_m, self._integral_j),
                distance * self._mean(first, last, self.forward_s_m, self._integral_s),
            )

    def to_and_fro(self, distance_m: Quantity, pitch: Quantity) -> tuple[Array, Array]:
        """Energy [J] and time [s] of moving the mass by a distance and back at one pitch."""
        slope = np.tan(pitch)
        both = np.stack([slope, -slope])
        energy = np.interp(both, self.slope, self.forward_j_m).sum(axis=0)
        time = np.interp(both, self.slope, self.forward_s_m).sum(axis=0)
        return np.asarray(distance_m * energy), np.asarray(distance_m * time)

    @cached_property
    def _integral_j(self) -> Array:
        return self._integral(self.forward_j_m)

    @cached_property
    def _integral_s(self) -> Array:
        return self._integral(self.forward_s_m)

    def _integral(self, column: Array) -> Array:
        steps = 0.5 * (column[1:] + column[:-1]) * np.diff(self.slope)
        return np.concatenate(([0.0], np.cumsum(steps)))  # infinite from where the motor stalls

    def _mean(self, first: Array, last: Array, column: Array, integral: Array) -> Array:
        """Mean of a column between two slopes, by its integral."""
        span = last - first
        rise = np.interp(last, self.slope, integral) - np.interp(first, self.slope, integral)
        flat = np.abs(span) < 1e-9
        if not flat.any():
            return np.asarray(rise / span)
        return np.where(flat, np.interp(first, self.slope, column), rise / np.where(flat, 1.0, span))

    def scaled(self, factor: float) -> "PitchDriveWork":
        """Return the same drive with all energies multiplied."""
        return replace(self, forward_j_m=factor * self.forward_j_m)


@dataclass(frozen=True)
class RudderWork:
    """Cost of putting the rudder over and back, over the speed along the path."""

    speed_square: Array
    """Square of the speed, rising [m2/s2]; the moment of the water grows with it."""
    turn_j: Array
    """Electrical energy of putting the rudder over and back, brake included [J]."""
    turn_s: float
    """Time in which steering motor and brake work for it [s]."""
    origin: str

    def turn(self, speed_m_s: Quantity) -> Array:
        """Energy of putting the rudder over and back [J]."""
        return np.asarray(np.interp(np.square(speed_m_s), self.speed_square, self.turn_j))

    def scaled(self, factor: float) -> "RudderWork":
        """Return the same drive with all energies multiplied."""
        return replace(self, turn_j=factor * self.turn_j)
