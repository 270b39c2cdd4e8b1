"""Samples on a regular grid: means in cells of depth, by profile or by time; an empty cell stays empty."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stommel.data.profiles import seconds
from stommel.data.variables import BY_NAME
from stommel.geometry.longitudes import all_wrapped_deg, continued_deg

MOST_CELLS = 4_000_000
Array = NDArray[np.float64]


def section(samples: xr.Dataset, variable: str, *, cell_m: float = 1.0, deepest_m: float | None = None) -> xr.Dataset:
    """Return a variable in cells of depth, a column for each profile.

    Parameters
    ----------
    samples
        With `depth`, `profile_number`, `time` and, if it has them, positions.
    variable
        Which one.
    cell_m
        Height of a cell, 0.1 to 100 m.
    deepest_m
        Lower end; that of the samples if left out.

    Returns
    -------
    xr.Dataset
        The variable (mean of the samples in the cell), `samples_in_cell` on (profile, depth); `time` (mean),
        `profile_number`, `profile_direction` and mean positions of each profile; `depth` at the middle of cells.

    Raises
    ------
    ValueError
        The cell is out of range, or there would be more than `MOST_CELLS`.
    """
    if not 0.1 <= cell_m <= 100.0:
        raise ValueError(f"cell = {cell_m:g} m: must be from 0.1 to 100 m")
    number = samples["profile_number"].values
    depth = samples["depth"].values.astype(np.float64)
    values = samples[variable].values.astype(np.float64)
    profiles = np.unique(number[number > 0])
    lowest = float(np.nanmax(depth, initial=0.0)) if deepest_m is None else deepest_m
    cells = max(1, int(np.ceil(lowest / cell_m)))
    if profiles.size * cells > MOST_CELLS:
        raise ValueError(f"{profiles.size} profiles x {cells} cells: at most {MOST_CELLS}; take larger cells")
    row = np.floor(depth / cell_m)
    used = (number > 0) & np.isfinite(values) & (row >= 0) & (row < cells)
    column = np.searchsorted(profiles, number)
    place = column[used] * cells + row[used].astype(np.int64)
    counts = np.bincount(place, minlength=profiles.size * cells).reshape(profiles.size, cells)
    sums = np.bincount(place, values[used], profiles.size * cells).reshape(profiles.size, cells)
    with np.errstate(invalid="ignore", divide="ignore"):
        means = np.where(counts, sums / counts, np.nan)
    about = BY_NAME[variable].attributes if variable in BY_NAME else dict(samples[variable].attrs)
    return xr.Dataset(
        {
            variable: (("profile", "depth"), means, about),
            "samples_in_cell": (("profile", "depth"), counts.astype(np.int32), {"long_name": "samples in the cell"}),
            **_of_profiles(samples, number, profiles),
        },
        coords={"depth": ("depth", (np.arange(cells) + 0.5) * cell_m, BY_NAME["depth"].attributes)},
    )


def joined(sections: Sequence[xr.Dataset]) -> xr.Dataset:
    """Return sections of the same cells side by side, in their order, down to the deepest of them.

    Parameters
    ----------
    sections
        From `section`, at least one, of profiles of which none is in two.
    """
    if len(sections) == 1:
        return sections[0]
    depth = max((each["depth"] for each in sections), key=lambda found: found.size)
    padded = [each.reindex(depth=depth, fill_value={"samples_in_cell": 0}) for each in sections]
    return xr.concat(padded, "profile", combine_attrs="override")


def _of_profiles(samples: xr.Dataset, number: NDArray[np.int32], profiles: NDArray[np.int32]) -> dict[str, tuple]:  # type: ignore[type-arg]
    """What each profile has once: number, way, mean time and place."""

    def mean(values: Array) -> Array:
        used = np.isfinite(values) & (number > 0)
        column = np.searchsorted(profiles, number[used])
        counts = np.bincount(column, minlength=profiles.size)
        with np.errstate(invalid="ignore", divide="ignore"):
            found: Array = np.bincount(column, values[used], profiles.size) / counts
        return found

    first = (
        np.searchsorted(number, profiles)
        if np.all(np.diff(number) >= 0)
        else [np.flatnonzero(number == n)[0] for n in profiles]
    )
    stamps = {"long_name": "mean time", "standard_name": "time", "units": "seconds since 1970-01-01T00:00:00Z"}
    found: dict[str, tuple[str, NDArray[Any], dict[str, Any]]] = {
        "time": ("profile", mean(seconds(samples["time"].values)), stamps),
        "profile_number": ("profile", profiles, {"long_name": "number of the profile"}),
        "profile_direction": ("profile", samples["profile_direction"].values[first], {"long_name": "1 down, -1 up"}),
    }
    if "latitude" in samples:
        latitude = samples["latitude"].values.astype(np.float64)
        found["latitude"] = ("profile", mean(latitude), BY_NAME["latitude"].attributes)
    if "longitude" in samples:
        longitude = samples["longitude"].values.astype(np.float64)
        is_known = np.isfinite(longitude)
        longitude[is_known] = continued_deg(longitude[is_known])
        found["longitude"] = ("profile", all_wrapped_deg(mean(longitude)), BY_NAME["longitude"].attributes)
    return found
