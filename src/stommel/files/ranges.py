"""What numbers of gliders may be, both ends of each: wide enough for any that could be built, and no wider.

From a laboratory glider of a kilogram and 0.3 m to a flying wing of two tonnes and 6 m, from a pool to the deepest
trench. A range is stated here where several tables share the quantity, and at its field where it stands alone; units
are those of the key. The ends are judgements, not physics: they are there to catch slips of the unit, of the point,
and of the key.
"""

from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import Field
from pydantic_core import PydanticCustomError, core_schema

GREATEST_SEED = (1 << 63) - 1
"""Of random numbers; TOML has no greater whole number."""

OUT_OF_RANGE = "out_of_range"
"""Kind of error of a number that is refused by `ZeroOr`."""


def between(low: float, high: float) -> Any:
    """Allow finite numbers from `low` to `high`, both ends among them."""
    return Field(strict=True, ge=low, le=high, allow_inf_nan=False)


@dataclass(frozen=True)
class ZeroOr:
    """Zero, for what is not there, or a number from `low` to `high`."""

    low: float
    high: float

    def words(self) -> str:
        """What is allowed."""
        return f"0, or between {self.low:g} and {self.high:g}"

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> core_schema.CoreSchema:
        """Tell pydantic how such a number is read."""
        number = core_schema.float_schema(strict=True, allow_inf_nan=False)
        return core_schema.no_info_after_validator_function(self._checked, number)

    def _checked(self, value: float) -> float:
        if value != 0.0 and not self.low <= value <= self.high:
            raise PydanticCustomError(OUT_OF_RANGE, "{words}", {"words": f"must be {self.words()}"})
        return value


# places and sizes
Coordinate = Annotated[float, between(-10, 10)]
"""Of a place in the body frame [m]."""
Position = Annotated[float, between(-5000, 5000)]
"""Of a moving mass, a switch or a stop [mm]."""
BodyLength = Annotated[float, between(0.2, 10)]
"""Of a hull or a whole vehicle [m]."""
Diameter = Annotated[float, between(20, 2000)]
"""Of a hull [mm]."""
PartSize = Annotated[float, between(0.5, 10000)]
"""Length, width or height of a part [mm]."""
Wall = Annotated[float, between(0.1, 200)]
"""Thickness of a wall [mm]."""
Depth = Annotated[float, between(0.5, 12000)]
"""Of a dive, or that a hull is rated for [m]."""
DepthOrZero = Annotated[float, between(0, 12000)]
"""Depth or altitude that may be none [m]."""

# masses and volumes
Mass = Annotated[float, between(0.1, 2000)]
"""Of a vehicle or of its rigid body [kg]."""
Inertia = Annotated[float, between(-20000, 20000)]
"""Component of a tensor of inertia [kg m2], or of its coupling with the mass [kg m]."""
Volume = Annotated[float, between(0.1, 1e5)]
"""Of oil or ballast [ml]."""
SignedVolume = Annotated[float, between(-1e5, 1e5)]
"""Of ballast, negative below neutral [ml]."""
Liquid = Annotated[float, between(500, 1500)]
"""Density of oil or water [kg/m3]."""

# motion and time
Speed = Annotated[float, between(0.005, 5)]
"""Along the path [m/s]."""
AngularSpeed = Annotated[float, between(0.1, 1000)]
"""Of a rudder or a rolling mass [deg/s]."""
Turns = Annotated[float, between(1, 50000)]
"""Of a motor or pump [r/min]."""
Seconds = Annotated[float, between(0, 86400)]
"""A time of at most a day [s]."""
Hours = Annotated[float, between(0.01, 17520)]
"""A time of at most two years [h]."""

# shares and counts
Share = Annotated[float, between(0, 1)]
"""A part of a whole."""
Efficiency = Annotated[float, between(0.01, 1)]
"""What arrives of work or energy."""

# electricity
Voltage = Annotated[float, between(1, 600)]
"""Of a supply or a battery [V]."""
Current = Annotated[float, between(0.001, 400)]
"""Of a motor [A]."""
NoLoadCurrent = Annotated[float, between(0, 20)]
"""That a motor's own friction takes [A]."""
Power = Annotated[float, between(0, 500)]
"""Of a consumer, a coil or a brake [W]."""
TorqueConstant = Annotated[float, between(0.1, 10000)]
"""Of a motor [mN m/A]."""
RotorInertia = Annotated[float, between(0.001, 1e5)]
"""Of a motor with what is reduced to it [g cm2]."""

# pressure and elasticity
Pressure = Annotated[float, between(0.001, 130)]
"""Of the sea, gauge [MPa]; 130 are those of 12 km."""
PressureOrZero = Annotated[float, between(0, 130)]
"""The same, or none."""
Compressibility = Annotated[float, between(0, 1e-8)]
"""Volume that is lost per pressure; water has 4.5e-10 [1/Pa]."""
ThermalExpansion = Annotated[float, between(-1e-3, 1e-3)]
"""Per degree [1/K]."""
Stress = Annotated[float, between(0.1, 20000)]
"""Strength of a material [MPa]."""
