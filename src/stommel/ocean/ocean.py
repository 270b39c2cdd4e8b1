"""The ocean as Python sees it: open a file or make one by name, ask for values, hand the grid to compiled code."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from math import ceil, radians
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from stommel.files.opening import exists
from stommel.ocean import times
from stommel.ocean.answers import DEEPEST, Region, Sample, Source, depth_refusal, refusal, sample_of
from stommel.ocean.errors import LandError, OutsideOceanError, UnknownOceanError
from stommel.ocean.kernel.column import fill_column
from stommel.ocean.kernel.given_current import with_current
from stommel.ocean.kernel.grid import (
    BOTTOM,
    CLIMATOLOGY,
    CT_ROW,
    ERROR,
    HELD,
    RHO,
    SALINITY,
    UNBOUNDED_DEPTH,
    Column,
    OceanGrid,
    new_cell,
    new_column,
)
from stommel.ocean.kernel.outside import policy, with_policies
from stommel.ocean.summary import around, node_places, ranges_of, summary_of
from stommel.ocean.times import Time
from stommel.seawater.stratification import Stratification
from stommel.seawater.table import DensityTable, SeawaterTable, density_table, freezing_table, sound_speed_table

BLEND_KM = 50.0
"""Beyond the edge of the data, over which the nearest values give way to a climatology."""
BLEND_H = 24.0
"""The same before the first and after the last time."""
FASTEST_CURRENT = 5.0
"""That can be given [m/s]."""
_SAMPLE_STEP = 10.0
"""Largest step of the column that answers a single question [m]."""


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
        path: Source,
        *,
        folder: Path | None = None,
        names: Mapping[str, str] | None = None,
        units: Mapping[str, str] | None = None,
        outside: str = "error",
        outside_time: str | None = None,
        climatology: "Ocean | Source | None" = None,
        blend_km: float = BLEND_KM,
        blend_hours: float = BLEND_H,
        bounds: Region | None = None,
        between: tuple[Time, Time] | None = None,
        yearly: bool | None = None,
        at_rest: bool = False,
        parameters: Mapping[str, Any] | None = None,
    ) -> Self:
        """Read an ocean from CF NetCDF files, or from a profile.

        A profile is a .csv file for `stommel.seawater.read_stratification`; its layers then stand everywhere, in a
        steady current.

        Parameters
        ----------
        path
            File with temperature, salinity, two components of the current and, if it has it, the depth of the bottom,
            on depth levels and a regular or curvilinear grid; or several that have these among them, for one stretch
            of time after the other or one quantity each; or a pattern like `sea_2016*.nc`.
        folder
            Where relative names are sought first.
        names
            Names of the file's variables where `standard_name` does not tell: `temperature`, `salinity`, `current_x`,
            `current_y`, `bottom`, `time`, `depth`, `latitude`, `longitude`, `angle`. For a profile, of its columns.
        units
            Units of the file's variables where the file leaves them out or has them wrong, as `{"salinity": "psu"}`.
        outside
            Beyond the data: "error" refuses, "hold" keeps the nearest values, "climatology" goes over to
            `climatology`, or without one to the mean of the file.
        outside_time
            The same for times, if different.
        climatology
            A second ocean, its file, or the name of an analytic one. A file is cut to the region of this ocean and
            10 deg around it, and repeats every year if it says that it is a climatology, else its times are held.
        blend_km, blend_hours
            Beyond the edge of the data and their times, over which the nearest values give way to the climatology.
        bounds
            South, north, west, east of the region to read [deg]; all of the file if left out.
        between
            First and last time to read; the file's slots around them are kept. None of them need lie in the file if
            `outside_time` is not "error".
        yearly
            Whether the times repeat every year; if left out, where the file says so (CF, section 7.4).
        at_rest
            Read no currents: the water is at rest, as in a climatology of temperature and salinity alone.
        parameters
            Numbers of a profile's ocean: `latitude_deg`, `longitude_deg`, `bottom_m`, `current_east_m_s`,
            `current_north_m_s`.

        Raises
        ------
        FileError
            The file cannot be used; the error names the variable and what is allowed.
        UnknownOceanError
            A policy, name or option is unknown, or does not fit.
        """
        from stommel.ocean.opening import open_ocean  # noqa: PLC0415 - xarray takes time to load

        policy(outside)  # a wrong word is said before a large file is read
        at_times = policy(outside if outside_time is None else outside_time, "outside_time")
        found = open_ocean(
            path, folder, dict(names or {}), dict(units or {}), bounds, between, yearly, dict(parameters or {}),
            at_rest=at_rest, mean_slot=at_times == CLIMATOLOGY and climatology is None, beyond=at_times != ERROR,
        )  # fmt: skip
        return cls(*found).with_outside(
            outside, outside_time, climatology=climatology, blend_km=blend_km, blend_hours=blend_hours, folder=folder
        )

    @classmethod
    def analytic(cls, name: str, **parameters: Any) -> Self:
        """Make an analytic ocean, see `stommel.ocean.analytic.catalogue.ANALYTIC` for names and parameters.

        Raises
        ------
        UnknownOceanError
            The name or a parameter is unknown, or a value is not allowed.
        """
        from stommel.ocean.analytic.catalogue import build_analytic  # noqa: PLC0415 - it imports geodesy

        data, notes = build_analytic(name, parameters)
        return cls(name, data, notes)

    def with_outside(
        self,
        outside: str,
        outside_time: str | None = None,
        *,
        climatology: "Ocean | Source | None" = None,
        blend_km: float = BLEND_KM,
        blend_hours: float = BLEND_H,
        folder: Path | None = None,
    ) -> Self:
        """Return the ocean with other policies outside its data; the arguments are those of `open`.

        Raises
        ------
        FileError, UnknownOceanError
            A policy is unknown, the climatology cannot be used or is not asked for.
        """
        space = policy(outside)
        time = space if outside_time is None else policy(outside_time, "outside_time")
        for key, value in (("blend_km", blend_km), ("blend_hours", blend_hours)):
            if not 0.0 <= value < np.inf:
                raise UnknownOceanError(f"{key} = {value:g}: must be at least 0")
        if climatology is None:
            second = None
        elif CLIMATOLOGY in (space, time):
            second = self._second(climatology, folder)
        else:
            raise UnknownOceanError('climatology: is only used with outside or outside_time = "climatology"')
        data = with_policies(
            self.data, space, time, second.data if second is not None else None, 1e3 * blend_km, 3600.0 * blend_hours
        )
        notes = dict(self.notes)
        if CLIMATOLOGY in (space, time):
            behind = second.name if second is not None else "the mean of this ocean"
            notes["climatology"] = f"{behind}, reached {blend_km:g} km and {blend_hours:g} h beyond the data"
            notes |= {f"climatology, {key}": text for key, text in (second.notes if second else {}).items()}
        return type(self)(self.name, data, notes)

    def with_current(self, east_m_s: float, north_m_s: float) -> Self:
        """Return the same water moving to east and north at these speeds, everywhere and always, without tides.

        Raises
        ------
        UnknownOceanError
            A speed is not between -5 and 5 m/s.
        """
        for key, value in (("east_m_s", east_m_s), ("north_m_s", north_m_s)):
            if not -FASTEST_CURRENT <= value <= FASTEST_CURRENT:
                raise UnknownOceanError(
                    f"{key} = {value:g}: must be between {-FASTEST_CURRENT:g} and {FASTEST_CURRENT:g} m/s"
                )
        notes = dict(self.notes) | {"current": f"given: {east_m_s:g} m/s to the east, {north_m_s:g} m/s to the north"}
        return type(self)(self.name, with_current(self.data, east_m_s, north_m_s), notes)

    def _second(self, climatology: "Ocean | Source", folder: Path | None) -> "Ocean":
        """Open the ocean behind this one."""
        from stommel.ocean.analytic.catalogue import is_analytic  # noqa: PLC0415 - it imports geodesy

        if isinstance(climatology, Ocean):
            return climatology
        beside = isinstance(climatology, str) and folder is not None and exists(folder / climatology)
        if isinstance(climatology, str) and not beside and is_analytic(climatology):
            return Ocean.analytic(climatology)
        return Ocean.open(climatology, folder=folder, outside_time="hold", bounds=around(self.data))

    def grid(self) -> OceanGrid:
        """Return the arrays for `stommel.ocean.kernel.column.fill_column`."""
        return self.data

    @cached_property
    def table(self) -> DensityTable:
        """Density over the ocean's own range of salinity, temperature and pressure, and of what is behind it."""
        return density_table(*ranges_of(self.data))

    @cached_property
    def sound_speed_table(self) -> SeawaterTable:
        """Speed of sound over the same range, for `stommel.seawater.table.tabulated`."""
        return sound_speed_table(*ranges_of(self.data))

    @cached_property
    def freezing_table(self) -> SeawaterTable:
        """Freezing temperature over the same range, for `stommel.seawater.table.tabulated`."""
        S_A, _, p = ranges_of(self.data)
        return freezing_table(S_A, p)

    def at(self, time: Time, latitude_deg: float, longitude_deg: float, depth_m: float = 0.0) -> Sample:
        """Water at one point, by the interpolation of the compiled code.

        Raises
        ------
        OutsideOceanError
            The place or time is outside the data, and the policy is to refuse.
        LandError
            The place is on land.
        BelowBottomError
            The depth is negative, below the bottom or below the deepest trench.
        """
        asked = 0.0 < depth_m <= DEEPEST
        steps = max(1, ceil(depth_m / _SAMPLE_STEP)) if asked else 1
        step = depth_m / steps if asked else 1.0
        column = new_column(self.data, depth_m if asked else 1.0, step)
        held = self._fill(time, latitude_deg, longitude_deg, column)
        bottom = float(column.place[BOTTOM])
        if not 0.0 <= depth_m <= min(bottom, DEEPEST):
            raise depth_refusal(self.name, depth_m, (latitude_deg, longitude_deg), bottom)
        return sample_of(column.values[round(depth_m / step)], bottom, held=held)

    def bottom_depth(self, latitude_deg: float, longitude_deg: float) -> float:
        """Depth of the bottom [m]; infinite where the ocean has none.

        Raises
        ------
        OutsideOceanError, LandError
            As `at`.
        """
        column = new_column(self.data, 1.0, 1.0)
        self._fill(float(self.data.nodes.times[0]), latitude_deg, longitude_deg, column)
        bottom = float(column.place[BOTTOM])
        return bottom if bottom < UNBOUNDED_DEPTH else float("inf")

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
        UnknownOceanError
            The step is not a positive number.
        OutsideOceanError, LandError
            As `at`.
        """
        if not 0.01 <= step_m <= DEEPEST:
            raise UnknownOceanError(f"step_m = {step_m:g}: must be between 0.01 and {DEEPEST:g}")
        deepest = min(float(self.data.nodes.depths[-1]), float(self.data.bottom.max()))
        column = new_column(self.data, deepest, step_m)
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

    def _fill(self, time: Time, latitude_deg: float, longitude_deg: float, column: Column) -> bool:
        """Fill a column; say whether the policy answered."""
        at = times.seconds(time)
        if not (-90.0 <= latitude_deg <= 90.0 and np.isfinite(longitude_deg)):
            raise OutsideOceanError(
                f"latitude {latitude_deg:g}, longitude {longitude_deg:g}: latitude must be between -90 and 90 deg, "
                "longitude a number"
            )
        status = fill_column(
            self.data, self.table, at, radians(latitude_deg), radians(longitude_deg), new_cell(), column
        )
        if status > HELD:
            raise refusal(self.name, self.data, status, at, (latitude_deg, longitude_deg))
        return bool(status == HELD)
