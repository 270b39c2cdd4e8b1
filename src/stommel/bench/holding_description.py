"""Description of a hull pressure test: columns, limits and the compliance of what is under pressure (TOML)."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from stommel.bench.column_map import MapTable
from stommel.bench.quantities import QUANTITIES
from stommel.files.fields import Name
from stommel.files.ranges import Compressibility, Pressure, between


class PressureColumn(MapTable):
    """A column of gauge pressures."""

    column: Name
    unit: Name

    @model_validator(mode="after")
    def _unit_is_known(self) -> Self:
        known = QUANTITIES["pressure"].units
        if self.unit not in known:
            raise ValueError(f"unit = {self.unit!r}: unknown unit; allowed are {', '.join(known)}")
        return self

    @property
    def factor(self) -> float:
        """Pascals in one of the unit."""
        return QUANTITIES["pressure"].factor(self.unit)


class HoldingColumns(MapTable):
    """Columns of a table of holds; times are clock times hh:mm or hh:mm:ss."""

    hold: Name = "hold"
    begin: Name = "from"
    end: Name = "to"
    begin_pressure: PressureColumn = PressureColumn(column="from_pressure_mpa", unit="MPa")
    end_pressure: PressureColumn = PressureColumn(column="to_pressure_mpa", unit="MPa")


class HoldingLimits(MapTable):
    """When the hull passes, and what a table of holds may look like."""

    largest_loss_mpa: Annotated[float, between(0.0001, 20)] = 0.1
    """Each hold loses less than this. Default: section 5.1.1 of the paper."""
    lowest_pressure_mpa: Pressure = 2.0
    """Pressure stays above this. Default: section 5.1.1 of the paper."""
    longest_hold_hours: Annotated[float, between(0.01, 24)] = 12.0
    """A hold that would last longer, counted across midnight, is a slip of the pen."""
    longest_pause_hours: Annotated[float, between(0.01, 24)] = 12.0
    """The same between two holds."""


class Chamber(MapTable):
    """What is compressed while the pressure is held."""

    volume_l: Annotated[float, between(1, 1e5)]
    """Inside of the empty chamber."""
    compressibility_per_pa: Compressibility = 0.0
    """Relative growth of the chamber's volume per pressure."""
    water_bulk_modulus_mpa: Annotated[float, between(1800, 3000)] = 2180.0
    """Of the water at the test's temperature; fresh water at 20 deg C if left out (Kell 1975)."""
    water_thermal_expansion_per_k: Annotated[float, between(1e-6, 1e-3)] = 2.07e-4
    """Of the water at the test's temperature; fresh water at 20 deg C if left out (Kell 1975)."""
    hull_volume_l: Annotated[float, between(0.5, 20000)]
    """Displaced volume of the hull."""
    hull_compressibility_per_pa: Compressibility
    """Relative shrinking of the hull per pressure."""

    @model_validator(mode="after")
    def _hull_fits(self) -> Self:
        if self.hull_volume_l >= self.volume_l:
            raise ValueError(
                f"hull_volume_l = {self.hull_volume_l:g}: must be less than volume_l = {self.volume_l:g}, "
                "the inside of the chamber"
            )
        return self

    @property
    def water_volume_m3(self) -> float:
        """Water around the hull [m3]."""
        return (self.volume_l - self.hull_volume_l) / 1e3

    @property
    def compliance_m3_pa(self) -> float:
        """C = V_w / K_w + kappa_c V_c + kappa_h V_h, volume that one pascal takes [m3/Pa] (docs/theory/bench)."""
        return (
            self.water_volume_m3 / (self.water_bulk_modulus_mpa * 1e6)
            + self.compressibility_per_pa * self.volume_l / 1e3
            + self.hull_compressibility_per_pa * self.hull_volume_l / 1e3
        )


class HoldingDescription(MapTable):
    """Description of a hull pressure test."""

    format: Literal[1] = 1
    title: Name = "Hull pressure test"
    delimiter: Annotated[str, Field(min_length=1, max_length=1)] = ","
    columns: HoldingColumns = HoldingColumns()
    limits: HoldingLimits = HoldingLimits()
    chamber: Chamber | None = None
