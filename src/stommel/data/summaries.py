"""One line for each profile: when, where, which way, how deep."""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stommel.data.profiles import seconds
from stommel.geometry.longitudes import mean_deg

Array = NDArray[Any]


class ProfileSummary(NamedTuple):
    """A profile as a list shows it; None is what is not known."""

    number: int
    """From 1."""
    direction: int
    """1 down, -1 up."""
    begin: float
    """[s since 1970]"""
    end: float
    samples: int
    dive: int | None
    latitude: float | None
    """Mean [deg]."""
    longitude: float | None
    least_depth_m: float | None
    greatest_depth_m: float | None


def profile_summaries(samples: xr.Dataset) -> list[ProfileSummary]:
    """Summaries of all profiles, in the order of their numbers.

    Parameters
    ----------
    samples
        After `with_profiles` and `with_derived`.
    """
    number = samples["profile_number"].values
    order = np.argsort(number, kind="stable")
    bounds = np.flatnonzero(np.diff(number[order])) + 1
    time = seconds(samples["time"].values)
    columns = {name: samples[name].values for name in ("latitude", "longitude", "depth", "dive") if name in samples}
    found = []
    for part in np.split(order, bounds):
        if not part.size or number[part[0]] <= 0:
            continue
        depth, dive = columns["depth"][part], columns["dive"][part] if "dive" in columns else np.zeros(0)
        found.append(
            ProfileSummary(
                int(number[part[0]]),
                int(samples["profile_direction"].values[part[0]]),
                float(time[part].min()),
                float(time[part].max()),
                int(part.size),
                int(dive[0]) if dive.size and dive[0] > 0 else None,
                of_known(columns["latitude"][part], np.mean),
                of_known(columns["longitude"][part], mean_deg),
                of_known(depth, np.min),
                of_known(depth, np.max),
            )
        )
    return found


def of_known(values: Array, of: Callable[[Array], Any]) -> float | None:
    """What a function makes of those values that are numbers; None where none is."""
    known = values[np.isfinite(values)]
    return float(of(known)) if known.size else None
