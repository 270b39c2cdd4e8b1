"""The ocean as Python sees it: open a file or make one by name, ask for values, hand the grid to compiled code."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from math import ceil, radians
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from stommel.ocean import times
from stommel.ocean.column import fill_column
from stommel.ocean.errors import BelowBottomError, LandError, OutsideOceanError
from stommel.ocean.grid import (
    BOTTOM,
    CT,
    CT_ROW,
    EAST,
    EAST_ACCELERATION,
    HELD,
    LAND,
    NORTH,
    NORTH_ACCELERATION,
    OUTSIDE_SPACE,
    OUTSIDE_TIME,
    RHO,
    S_A,
    SALINITY,
    TEMPERATURE,
    UNBOUNDED_DEPTH,
    Column,
    OceanGrid,
    P,
    new_cell,
    new_column,
)
from stommel.ocean.summary import extent_of, node_places, summary_of
from stommel.ocean.times import Time
from stommel.seawater.stratification import Stratification
from stommel.seawater.table import DensityTable, density_table

_SAMPLE_STEP = 10.0
"""Largest step of the column that answers a single question [m]."""
_DEEPEST = 11900.0


@dataclass(frozen=True)
class Sample:
    """The water at one point; SI units unless noted."""

    density: float
    """[kg/m3]"""
    pressure: float
    """Gauge pressure [Pa]."""
    temperature: float
    """In-situ temperature [deg C]."""
    conservative_temperature: float
    """[deg C]"""
    absolute_salinity: float
    """[g/kg]"""
    current_north: float
    """[m/s]"""
    current_east: float
    """[m/s]"""
    acceleration_north: float
    """Of the water, DU/Dt [m/s2]."""
    acceleration_east: float
    """[m/s2]"""
    bottom_depth: float
    """[m]; infinite where the ocean has no bottom."""
    held: bool
    """The point lies outside the data, and the ocean's policy answered."""


@dataclass(frozen=True)
class Ocean:
    """Temperature, salinity, currents and bottom in space and time."""

    name: str
    """File name or name of the analytic ocean, for messages."""
    data: OceanGrid = field(repr=False)
    notes: Mapping[str, str] = field(default_factory=dict)
    """What was read from where, and what was assumed."""

    @classmethod
    def open(
        cls,
        path: str | Path,
        *,
        names: Mapping[str, str] | None = None,
        outside: str = "error",
        outside_time: str | None = None,
        bounds: tuple[float, float, float, float] | None = None,
        between: tuple[Time, Time] | None = None,
    ) -> Self:
        """Read an ocean from a CF NetCDF file.

        Parameters
        ----------
        path
            File with temperature, salinity, two components of the current and, if it has it, the depth of the bottom,
            on depth levels and a regular or curvilinear grid.
        names
            Names of the file's variables where `standard_name` does not tell: `temperature`, `salinity`, `current_x`,
            `current_y`, `bottom`, `time`, `depth`, `latitude`, `longitude`.
        outside
            Beyond the data: "error" refuses, "hold" keeps the nearest values, "climatology" takes the mean of the file.
        outside_time
            The same for times, if different.
        bounds
            South, north, west, east of the region to read [deg]; all of the file if left out.
        between
            First and last time to read; the file's slots around them are kept.

        Raises
        ------
        FileError
            The file cannot be used; the error names the variable and what is allowed.
        UnknownOceanError
            A policy or name is unknown.
        """
        from stommel.ocean.netcdf import read_ocean  # noqa: PLC0415 - xarray takes time to load

        policies = (outside, outside if outside_time is None else outside_time)
        data, notes = read_ocean(Path(path), dict(names or {}), policies, bounds, between)
        return cls(str(path), data, notes)

    @classmethod
    def analytic(cls, name: str, **parameters: Any) -> Self:
        """Make an analytic ocean, see `stommel.ocean.analytic.ANALYTIC` for names and parameters.

        Raises
        ------
        UnknownOceanError
            The name or a parameter is unknown, or a value is not allowed.
        """
        from stommel.ocean.analytic import build_analytic  # noqa: PLC0415 - it imports geodesy

        data, notes = build_analytic(name, parameters)
        return cls(name, data, notes)

    def grid(self) -> OceanGrid:
        """Return the arrays for `stommel.ocean.column.fill_column`."""
        return self.data

    @cached_property
    def table(self) -> DensityTable:
        """Density over the ocean's own range of salinity, temperature and pressure."""
        wet = self.data.levels > 0
        S_A_found, CT_found = self.data.water[:, wet][:, :, S_A], self.data.water[:, wet][:, :, CT]
        deepest = min(max(float(self.data.depths[-1]), self._deepest_bottom()), _DEEPEST / 1.05)
        return density_table(
            (max(float(S_A_found.min()) - 0.01, 0.0), min(float(S_A_found.max()) + 0.01, 42.0)),
            (max(float(CT_found.min()) - 0.01, -5.0), min(float(CT_found.max()) + 0.01, 42.0)),
            (0.0, 1.05 * deepest + 10.0),
        )

    def at(self, time: Time, latitude_deg: float, longitude_deg: float, depth_m: float = 0.0) -> Sample:
        """Water at one point, by the interpolation of the compiled code.

        Raises
        ------
        OutsideOceanError
            The place or time is outside the data, and the policy is to refuse.
        LandError
            The place is on land.
        BelowBottomError
            The depth is negative or below the bottom.
        """
        steps = max(1, ceil(depth_m / _SAMPLE_STEP)) if depth_m > 0.0 else 1
        step = depth_m / steps if depth_m > 0.0 else 1.0
        column = new_column(self.data, depth_m if depth_m > 0.0 else 1.0, step)
        held = self._fill(time, latitude_deg, longitude_deg, column)
        bottom = float(column.place[BOTTOM])
        if not 0.0 <= depth_m <= bottom:
            what = "above the surface" if depth_m < 0.0 else f"below the bottom at {bottom:.6g} m"
            raise BelowBottomError(
                f"{self.name}: depth = {depth_m:g} m at {_place(latitude_deg, longitude_deg)}: {what}"
            )
        row = column.values[round(depth_m / step)]
        return Sample(
            density=float(row[RHO]),
            pressure=float(row[P]),
            temperature=float(row[TEMPERATURE]),
            conservative_temperature=float(row[CT_ROW]),
            absolute_salinity=float(row[SALINITY]),
            current_north=float(row[NORTH]),
            current_east=float(row[EAST]),
            acceleration_north=float(row[NORTH_ACCELERATION]),
            acceleration_east=float(row[EAST_ACCELERATION]),
            bottom_depth=_or_infinite(bottom),
            held=held,
        )

    def bottom_depth(self, latitude_deg: float, longitude_deg: float) -> float:
        """Depth of the bottom [m]; infinite where the ocean has none.

        Raises
        ------
        OutsideOceanError, LandError
            As `at`.
        """
        column = new_column(self.data, 1.0, 1.0)
        self._fill(self._some_time(), latitude_deg, longitude_deg, column)
        return _or_infinite(float(column.place[BOTTOM]))

    def is_land(self, latitude_deg: float, longitude_deg: float) -> bool:
        """Say whether a place within the data is on land.

        Raises
        ------
        OutsideOceanError
            The place is outside the data, and the policy is to refuse.
        """
        try:
            self.bottom_depth(latitude_deg, longitude_deg)
        except LandError:
            return True
        return False

    def stratification(
        self, time: Time, latitude_deg: float, longitude_deg: float, step_m: float = 1.0
    ) -> Stratification:
        """Stratification at one place and time, every `step_m` from the surface to the bottom or the last level.

        Raises
        ------
        OutsideOceanError, LandError
            As `at`.
        """
        column = new_column(self.data, min(float(self.data.depths[-1]), self._deepest_bottom()), step_m)
        self._fill(time, latitude_deg, longitude_deg, column)
        depths = np.arange(len(column.values)) * step_m
        kept = depths <= max(column.place[BOTTOM], step_m)
        values = column.values[kept]
        return Stratification(
            depths[kept], values[:, SALINITY], values[:, CT_ROW], latitude_deg, depths[kept], values[:, RHO], self.name
        )

    def summary(self) -> dict[str, Any]:
        """Extent, resolution, ranges and policy, with units in the names."""
        return summary_of(self.name, self.data, self.notes, self.table)

    def node_places(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Latitude and longitude of the nodes (j, i) [deg]."""
        return node_places(self.data)

    def _deepest_bottom(self) -> float:
        return float(self.data.bottom.max())

    def _some_time(self) -> float:
        return float(self.data.times[0])

    def _fill(self, time: Time, latitude_deg: float, longitude_deg: float, column: Column) -> bool:
        """Fill a column; say whether the policy answered."""
        at = times.seconds(time)
        if not (-90.0 <= latitude_deg <= 90.0 and np.isfinite(longitude_deg)):
            raise OutsideOceanError(
                f"{_place(latitude_deg, longitude_deg)}: latitude must be between -90 and 90 deg, longitude a number"
            )
        status = fill_column(
            self.data, self.table, at, radians(latitude_deg), radians(longitude_deg), new_cell(), column
        )
        if status > HELD:
            self._refuse(status, at, latitude_deg, longitude_deg)
        return bool(status == HELD)

    def _refuse(self, status: int, time: float, latitude_deg: float, longitude_deg: float) -> None:
        place = _place(latitude_deg, longitude_deg)
        if status == LAND:
            raise LandError(f"{self.name}: {place} is on land")
        if status == OUTSIDE_TIME:
            first, last = (times.text(float(t)) for t in self.data.time_range)
            raise OutsideOceanError(
                f"{self.name}: time {times.text(time)} is outside the ocean, which has {first} to {last}; "
                'outside_time = "hold" or "climatology" allows it'
            )
        if status == OUTSIDE_SPACE:
            extent = extent_of(self.data)
            low, high = extent["latitude_deg"], extent["longitude_deg"]
            raise OutsideOceanError(
                f"{self.name}: {place} is outside the ocean, which lies within latitude {low[0]:.4g} to {low[1]:.4g}, "
                f'longitude {high[0]:.4g} to {high[1]:.4g}; outside = "hold" or "climatology" allows it'
            )


def _place(latitude_deg: float, longitude_deg: float) -> str:
    return f"latitude {latitude_deg:g}, longitude {longitude_deg:g}"


def _or_infinite(bottom: float) -> float:
    return bottom if bottom < UNBOUNDED_DEPTH else float("inf")
