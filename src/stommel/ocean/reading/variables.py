"""Finding the variables of a CF file by what they are, and reading their numbers in SI units."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NoReturn

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stommel.errors import FileError, Problem

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

_UNITS: dict[str, dict[str, tuple[float, float]]] = {
    "temperature": {
        **dict.fromkeys(("degc", "celsius", "degree_c", "degrees_c", "deg_c", "c", "degree_celsius"), (1.0, 0.0)),
        "degrees_celsius": (1.0, 0.0), "°c": (1.0, 0.0), "k": (1.0, -273.15), "kelvin": (1.0, -273.15),
        "degk": (1.0, -273.15),
    },
    "salinity": {
        **dict.fromkeys(
            ("1", "1e-3", "1e-03", "0.001", "10-3", "psu", "pss-78", "pss", "g kg-1", "g/kg", "ppt", "‰"), (1.0, 0.0)
        ),
        "kg kg-1": (1000.0, 0.0), "kg/kg": (1000.0, 0.0),
    },
    "velocity": {
        **dict.fromkeys(("m s-1", "m/s", "ms-1"), (1.0, 0.0)),
        **dict.fromkeys(("cm s-1", "cm/s"), (0.01, 0.0)),
        **dict.fromkeys(("mm s-1", "mm/s"), (0.001, 0.0)),
    },
    "length": {"m": (1.0, 0.0), "km": (1000.0, 0.0), "cm": (0.01, 0.0)},
    "length_of_map": {"m": (1.0, 0.0), "km": (1000.0, 0.0), "cm": (0.01, 0.0)},
    "angle": {
        **dict.fromkeys(
            ("degree", "degrees", "deg", "degree_north", "degrees_north", "degree_n", "degrees_n", "degree_east",
             "degrees_east", "degree_e", "degrees_e"),
            (np.pi / 180.0, 0.0),
        ),
        "radian": (1.0, 0.0), "radians": (1.0, 0.0), "rad": (1.0, 0.0),
    },
}  # fmt: skip
"""Factor and summand to SI (temperature: deg C) by quantity and unit."""

_SENSIBLE = {
    "temperature": (-5.0, 42.0),
    "salinity": (0.0, 42.0),
    "velocity": (-20.0, 20.0),
    "length": (-12000.0, 12000.0),
}
"""What seawater can have, in the units above; beyond it lie fill values that nothing marks."""

_NO_NUMBER = 1e30
"""netCDF writes 9.97e36 where nothing was written."""


@dataclass(frozen=True)
class File:
    """An open file and the names that the user gave its variables."""

    name: str
    data: xr.Dataset
    names: Mapping[str, str]

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
            found = unpacked(raw, self.data[variable].attrs) * factor + summand
        except (ValueError, TypeError) as error:
            self.refuse(
                variable, f"{variable} cannot be unpacked by its scale_factor, add_offset and valid_range: {error}"
            )
        if quantity in _SENSIBLE:
            low, high = _SENSIBLE[quantity]
            wrong = found[(found < low) | (found > high)]
            if wrong.size:
                self.refuse(
                    variable,
                    f"{variable} has the value {wrong.flat[0]:g}: must be between {low:g} and {high:g}; "
                    "is it a fill value that _FillValue does not name, or are the units wrong?",
                )
        return found

    def raw(self, variable: str, values: xr.DataArray | None = None) -> NDArray[Any]:
        """Read a variable, or a part of it, as it is stored."""
        array = self.data[variable] if values is None else values
        try:
            return np.asarray(array.values)
        except (OSError, RuntimeError, ValueError, MemoryError) as error:
            reason = " ".join(str(error).split()) or type(error).__name__
            self.refuse(variable, f"{variable} cannot be read ({reason}); the file is damaged or was cut short")

    def _unit(self, variable: str, quantity: str) -> tuple[float, float]:
        given = str(self.data[variable].attrs.get("units", "")).strip()
        known = _UNITS[quantity]
        if not given:
            self.refuse(variable, f"{variable} has no units; must be one of {', '.join(known)}")
        unit = _plain(given)
        if unit not in known:
            self.refuse(variable, f"{variable} has the units {given!r}; must be one of {', '.join(known)}")
        return known[unit]


def _plain(unit: str) -> str:
    """Write a unit the short way: `meter second-1` is `m s-1`."""
    text = unit.lower().replace("**", "").replace("^", "").replace(".", " " if not re.search(r"\d\.\d", unit) else ".")
    text = re.sub(r"\bcentimet(?:er|re)s?\b", "cm", text)
    text = re.sub(r"\bkilomet(?:er|re)s?\b", "km", text)
    text = re.sub(r"\bmet(?:er|re)s?\b", "m", text)
    text = re.sub(r"\bsec(?:ond)?s?(?=\b|-)", "s", text)
    return re.sub(r"\s+", " ", text).strip()


def unpacked(raw: NDArray[Any], attributes: Mapping[str, Any]) -> Array:
    """Numbers of a packed variable (CF conventions, section 8.1, and 2.5.1 on missing data)."""
    found: Array = np.array(raw, dtype=np.float64)
    missing = ~np.isfinite(found) | (np.abs(found) > _NO_NUMBER)
    for name in ("_FillValue", "missing_value"):
        for value in np.atleast_1d(attributes.get(name, [])):
            missing |= raw == value
    bounds = np.atleast_1d(attributes.get("valid_range", []))
    low, high = bounds if bounds.size == 2 else (attributes.get("valid_min"), attributes.get("valid_max"))
    if low is not None:
        missing |= raw < low
    if high is not None:
        missing |= raw > high
    found = np.asarray(found * np.float64(attributes.get("scale_factor", 1.0)))
    found += np.float64(attributes.get("add_offset", 0.0))
    found[missing] = np.nan
    return found
