"""Finding the variables of a CF file by what they are, and reading their numbers in SI units."""

import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import prod
from typing import Any, NoReturn

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stommel.errors import FileError, Problem
from stommel.files.sentences import shown
from stommel.ocean.reading.stores import REASONS, first_line
from stommel.ocean.reading.tally import Tally, share
from stommel.ocean.reading.units import UNITS, plain
from stommel.ocean.reading.unpacking import ValidRange, unpacked, valid_ranges

Array = NDArray[np.float64]

STANDARD_NAMES: dict[str, tuple[str, ...]] = {
    "temperature": (
        "sea_water_conservative_temperature",
        "sea_water_potential_temperature",
        "sea_water_temperature",
    ),
    "salinity": ("sea_water_absolute_salinity", "sea_water_practical_salinity", "sea_water_salinity"),
    "current_east": ("eastward_sea_water_velocity",),
    "current_north": ("northward_sea_water_velocity",),
    "current_x": ("sea_water_x_velocity", "x_sea_water_velocity"),
    "current_y": ("sea_water_y_velocity", "y_sea_water_velocity"),
    "bottom": (
        "sea_floor_depth_below_sea_level",
        "sea_floor_depth_below_geoid",
        "sea_floor_depth_below_mean_sea_level",
        "model_sea_floor_depth_below_sea_level",
        "model_sea_floor_depth_below_geoid",
        "sea_floor_depth",
    ),
    "latitude": ("latitude",),
    "longitude": ("longitude",),
    "angle": ("angle_of_rotation_from_east_to_x",),
}
"""Standard names of each thing that an ocean needs, in the order of preference."""

OWN_NAMES = (*STANDARD_NAMES, "time", "depth")
"""What `names` may rename."""

_SENSIBLE = {
    "temperature": (-5.0, 42.0),
    "salinity": (0.0, 42.0),
    "velocity": (-20.0, 20.0),
    "length": (-12000.0, 12000.0),
}
"""What seawater can have, in SI; beyond it lie fill values that nothing marks."""
_OVERSHOOT = {"salinity": 0.5}
"""By how much a model's numerics may leave that; such numbers count as its ends."""
_MOST_NUMBERS = 4e7
"""The most nodes or times of one file: what a header promises is looked at before memory is asked for it."""
_MOST_AT_ONCE = 5e8
"""The most numbers that are read at once, a piece in which a file is packed among them."""


@dataclass(frozen=True)
class File:
    """An open file and the names that the user gave its variables."""

    name: str
    data: xr.Dataset
    names: Mapping[str, str]
    units: Mapping[str, str] = field(default_factory=dict)
    """Units that the user states, by what they are of."""
    tally: Tally = field(default_factory=Tally)
    _ranges: dict[str, ValidRange | None] = field(default_factory=dict)
    """How the valid range of each variable is meant."""

    def refusal(self, key: str, message: str) -> FileError:
        """Return the error that `key` of this file is not usable."""
        return FileError([Problem(self.name, key, message)])

    def refuse(self, key: str, message: str) -> NoReturn:
        """Raise the error that `key` of this file is not usable."""
        raise self.refusal(key, message)

    def find(self, what: str, *, needed: bool = True) -> str | None:
        """Name of the variable that is `what`, by the user's names or by its standard name."""
        if what in self.names:
            if self.names[what] in self.data.variables:
                return self.names[what]
            if needed:
                there = ", ".join(map(str, self.data.variables)) or "none"
                self.refuse(what, f"names: {what} = {self.names[what]!r}: no such variable; there are: {there}")
            return None
        for standard in STANDARD_NAMES[what]:
            found = [str(n) for n, v in self.data.variables.items() if v.attrs.get("standard_name") == standard]
            # a surface field may carry the name of the full one
            deepest = max((self.data[name].ndim for name in found), default=0)
            found = [name for name in found if self.data[name].ndim == deepest]
            if len(found) > 1:
                self.refuse(what, f"{' and '.join(found)} are both {standard}; say which with names, {what} = ...")
            if found:
                return found[0]
        if needed:
            accepted = ", ".join(STANDARD_NAMES[what])
            there = ", ".join(map(str, self.data.data_vars)) or "none"
            self.refuse(
                what,
                f"no variable for {what}: none has the standard_name {accepted}; say which it is by its name "
                f"({what} = ...); there are: {there}",
            )
        return None

    def standard_name(self, variable: str) -> str:
        """Standard name of a variable, or nothing."""
        return str(self.data[variable].attrs.get("standard_name", ""))

    def numbers(self, variable: str, quantity: str, values: xr.DataArray | None = None) -> Array:
        """Read a variable, or a part of it: unpacked at double precision, nan where nothing is, in SI units."""
        factor, summand = self._unit(variable, quantity)
        raw = self.raw(variable, values)
        if not np.issubdtype(raw.dtype, np.number):
            self.refuse(variable, f"{variable} holds {raw.dtype}; must hold numbers")
        try:
            stored, found = unpacked(raw, self.data[variable].attrs)
            sensible = [(end - summand) / factor for end in _SENSIBLE.get(quantity, (-np.inf, np.inf))]
            self._mask_invalid(variable, stored, found, sensible)
        except (ValueError, TypeError, OverflowError) as error:
            self.refuse(variable, f"{variable} cannot be unpacked: {' '.join(str(error).split())}")
        found = np.asarray(found * factor + summand)
        if quantity in _SENSIBLE:
            self._require_sensible(variable, quantity, found)
        return found

    def _mask_invalid(self, variable: str, stored: NDArray[Any], found: Array, sensible: Sequence[float]) -> None:
        """Leave out what the file itself calls invalid.

        The first numbers that are read settle in which units it does: the likely ones, unless these leave more numbers
        that no sea has (`sensible`, as unpacked), or leave less than half and the others do not.
        """
        if variable not in self._ranges:
            ways = valid_ranges(self.data[variable].attrs, self.data[variable].dtype)
            strange = (found < sensible[0]) | (found > sensible[1])
            masks = [way.masked(stored, found) for way in ways]
            cost = [(int((strange & ~mask).sum()), bool(mask.sum() > 0.5 * np.isfinite(found).sum())) for mask in masks]
            self._ranges[variable] = ways[cost.index(min(cost))] if ways else None
        way = self._ranges[variable]
        if way is None:
            return
        outside = way.masked(stored, found)
        self.tally.add(variable, f"outside {way}, and left out", int(outside.sum()), int(np.isfinite(found).sum()))
        found[outside] = np.nan

    def _require_sensible(self, variable: str, quantity: str, found: Array) -> None:
        """Refuse numbers that no sea has; what only a model's numerics did is set right, and told."""
        low, high = _SENSIBLE[quantity]
        slack = _OVERSHOOT.get(quantity, 0.0)
        outside, count = (found < low) | (found > high), int(np.isfinite(found).sum())
        wrong = found[(found < low - slack) | (found > high + slack)]
        if wrong.size:
            self.refuse(
                variable,
                f"{variable} has the value {wrong.flat[0]:g}, and {share(wrong.size, count)} of its numbers are not "
                f"between {low:g} and {high:g}; is it a fill value that _FillValue does not name, or are the units "
                "wrong?",
            )
        ends = f"a little beyond {low:g} to {high:g}, and set to the end"
        self.tally.add(variable, ends, int(outside.sum()), count)
        np.clip(found, low, high, out=found, where=outside)

    def raw(self, variable: str, values: xr.DataArray | None = None) -> NDArray[Any]:
        """Read a variable, or a part of it, as it is stored."""
        array = self.data[variable] if values is None else values
        self._require_size(variable, array, _MOST_NUMBERS if values is None else _MOST_AT_ONCE)
        try:
            return np.asarray(array.values)
        except (*REASONS, MemoryError, zlib.error) as error:
            self.refuse(
                variable, f"{variable} cannot be read ({first_line(error)}); the file is damaged or was cut short"
            )

    def require_count(self, variable: str, count: int, what: str) -> None:
        """Refuse more nodes or times than are read of one file, before memory is asked for them."""
        if count > _MOST_NUMBERS:
            self.refuse(
                variable,
                f"{variable} leads to {count:.3g} {what}; at most {_MOST_NUMBERS:.3g} are read: cut the file to the "
                "mission's region first",
            )

    def _require_size(self, variable: str, array: xr.DataArray, most: float) -> None:
        """Look at how much is promised before memory is asked for it."""
        pieces = self.data[variable].encoding
        for size, what in (
            (array.size, "numbers"),
            (prod(pieces.get("chunksizes") or pieces.get("chunks") or ()), "numbers in one piece"),
        ):
            limit = most if what == "numbers" else _MOST_AT_ONCE
            if size > limit:
                self.refuse(
                    variable,
                    f"{variable} has {size:.3g} {what}; at most {limit:.3g} are read: cut the file to the mission's "
                    "region and time first",
                )

    def _unit(self, variable: str, quantity: str) -> tuple[float, float]:
        stated = self._stated_unit(variable)
        given = stated or str(self.data[variable].attrs.get("units", "")).strip()
        known = UNITS[quantity]
        if not given:
            self.refuse(
                variable,
                f"{variable} has no units; must be one of {', '.join(known)}; units says what the file leaves out",
            )
        unit = plain(given)
        if unit not in known:
            self.refuse(variable, f"{variable} has the units {shown(given)}; must be one of {', '.join(known)}")
        return known[unit]

    def _stated_unit(self, variable: str) -> str | None:
        """Unit that the user states of a variable."""
        for what, unit in self.units.items():
            known = self.find(what, needed=False) if what in STANDARD_NAMES else self.names.get(what, what)
            if known == variable:
                return unit
        return None
