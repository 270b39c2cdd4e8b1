"""Parts of a mission's Dataset that pictures need: times, the first dives, means in cells, bands instead of stripes."""

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stommel.simulation.results.events import dives_begun

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = NDArray[np.float64]

_UNITS = (("s", 1.0), ("min", 60.0), ("h", 3600.0), ("days", 86400.0))


def values(dataset: xr.Dataset, name: str) -> Array:
    """Values of a variable as doubles."""
    return np.asarray(dataset[name].values, dtype=float)


def seconds(dataset: xr.Dataset, name: str = "time", origin: "np.datetime64 | None" = None) -> Array:
    """Time since the first row, or since `origin` [s]."""
    start = dataset["time"].values[0] if origin is None else origin
    return np.asarray((dataset[name].values - start) / np.timedelta64(1, "ns"), dtype=float) / 1e9


def fitting_unit(span: float) -> tuple[str, float]:
    """Name and length [s] of the unit in which a span of time [s] reads well."""
    fitting = [unit for unit in _UNITS if span >= 3.0 * unit[1]]
    return fitting[-1] if fitting else _UNITS[0]


def date(dataset: xr.Dataset) -> str:
    """Date and time of the first row, in words."""
    return str(np.datetime_as_string(dataset["time"].values[0], unit="m")).replace("T", " ") + " UTC"


def _begins(dataset: xr.Dataset) -> NDArray[np.datetime64]:
    """Times at which dives begin."""
    begun = dives_begun(dataset["event_phase"].values, dataset["event_reason"].values)
    begins: NDArray[np.datetime64] = dataset["event_time"].values[begun]
    return begins


def dive_times(dataset: xr.Dataset) -> Array:
    """Times after the first row at which dives begin [s]."""
    return np.asarray((_begins(dataset) - dataset["time"].values[0]) / np.timedelta64(1, "ns"), dtype=float) / 1e9


def dives_in(dataset: xr.Dataset) -> int:
    """How many dives there are."""
    return len(_begins(dataset))


def first_dives(dataset: xr.Dataset, count: int) -> xr.Dataset:
    """Rows from the start to the end of the first `count` dives; all of them if there are fewer."""
    begins = _begins(dataset)
    if len(begins) <= count:
        return dataset
    return dataset.isel(time=dataset["time"].values <= begins[count])


def positions(dataset: xr.Dataset, prefix: str = "") -> tuple[Array, Array]:
    """Kilometres east and north of the first row, on a plane that touches the ellipsoid there."""
    from pyproj import Transformer  # noqa: PLC0415 - start-up counts

    latitude, longitude = float(dataset["latitude"][0]), float(dataset["longitude"][0])
    plane = f"+proj=aeqd +lat_0={latitude:.9f} +lon_0={longitude:.9f} +datum=WGS84"
    to_plane = Transformer.from_crs("EPSG:4326", plane, always_xy=True)
    east, north = to_plane.transform(values(dataset, f"{prefix}longitude"), values(dataset, f"{prefix}latitude"))
    return np.asarray(east) / 1e3, np.asarray(north) / 1e3


def travelled(dataset: xr.Dataset) -> Array:
    """Horizontal way over ground since the first row [m]."""
    east, north = positions(dataset)
    return 1e3 * np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(east), np.diff(north)))])


def unbroken(angles: Array) -> Array:
    """Headings [deg] between -180 and 180 about their mean, so that north is no break."""
    middle = np.degrees(np.angle(np.exp(1j * np.radians(angles)).mean()))
    return np.asarray(middle + (angles - middle + 180.0) % 360.0 - 180.0)


_LEVELS = 50
"""Cells over depth."""


def mean_in_cells(time: Array, depth: Array, curve: Array, deepest: float, columns: int) -> tuple[Array, Array, Array]:
    """Edges in time and depth, and the mean of a curve in each cell between them; not a number where it never was."""
    edges, levels = np.linspace(time[0], time[-1], columns + 1), np.linspace(0.0, deepest, _LEVELS + 1)
    i = np.clip(np.searchsorted(edges, time, side="right") - 1, 0, columns - 1)
    j = np.clip(np.searchsorted(levels, depth, side="right") - 1, 0, _LEVELS - 1)
    cell = j * columns + i
    count = np.bincount(cell, minlength=_LEVELS * columns)
    total = np.bincount(cell, weights=curve, minlength=_LEVELS * columns)
    with np.errstate(invalid="ignore"):
        return edges, levels, np.where(count > 0, total / count, np.nan).reshape(_LEVELS, columns)


READABLE_DIVES = 60
"""More dives side by side are stripes; then a curve is drawn as the band between its least and its greatest values."""
_BANDS = 150
"""Pieces of a band at most."""


def band(time: Array, curve: Array, dives: int) -> tuple[Array, Array, Array]:
    """Middle of each piece of time, and the least and greatest value of a curve in it.

    Pieces hold about two dives, so that each has seen a whole one and the band is as smooth as the mission.
    """
    pieces = int(np.clip(dives // 2, 1, _BANDS))
    edges = np.unique(np.linspace(0, len(time), pieces + 1).astype(int))
    low = np.array([np.nanmin(curve[i:j]) for i, j in pairwise(edges)])
    high = np.array([np.nanmax(curve[i:j]) for i, j in pairwise(edges)])
    middle = np.array([0.5 * (time[i] + time[j - 1]) for i, j in pairwise(edges)])
    return middle, low, high


def days(dataset: xr.Dataset, after: Array) -> Array:
    """Times after the first row [s] as days since 1970-01-01 UTC, in which matplotlib counts dates."""
    return np.asarray(dataset["time"].values[0].astype("datetime64[ns]").astype(float) / 8.64e13 + after / 86400.0)


def utc_axis(axes: "Axes", dataset: xr.Dataset) -> None:
    """Label an axis of time by dates and hours in UTC, and the whole of it by its two ends."""
    from matplotlib.dates import AutoDateLocator, ConciseDateFormatter  # noqa: PLC0415 - start-up counts

    locator = AutoDateLocator(minticks=4, maxticks=9)  # type: ignore[no-untyped-call]
    axes.xaxis.set_major_locator(locator)
    axes.xaxis.set_major_formatter(
        ConciseDateFormatter(  # type: ignore[no-untyped-call]
            locator,
            formats=["%Y", "%b %Y", "%d %b", "%H:%M", "%H:%M", "%H:%M:%S"],
            zero_formats=["", "%b %Y", "%d %b", "%d %b", "%H:%M", "%H:%M"],
            show_offset=False,
        )
    )
    first, last = (str(np.datetime_as_string(dataset["time"].values[k], unit="m")).replace("T", " ") for k in (0, -1))
    axes.set_xlabel(f"UTC, {first} to {last}")
