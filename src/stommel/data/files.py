"""Samples as files: CF NetCDF of a trajectory, and CSV with the units in its head."""

import csv
import io
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import xarray as xr

from stommel.data.profiles import seconds
from stommel.files.whole import whole_file
from stommel.version import __version__

CONVENTIONS = "CF-1.10"
TIME = {
    "long_name": "time of the sample",
    "standard_name": "time",
    "units": "seconds since 1970-01-01T00:00:00Z",
    "calendar": "standard",
    "axis": "T",
}
_FILL = 9.969209968386869e36
"""Of NetCDF for numbers that are not there."""
_CHUNK = 16_384
"""Samples that are compressed together in a file that grows."""
_ROWS = 5000
"""Lines that are made at a time."""


def as_trajectory(samples: xr.Dataset, trajectory: str, about: Mapping[str, str]) -> xr.Dataset:
    """Return samples as a CF discrete sampling geometry of one trajectory.

    Parameters
    ----------
    samples
        Along one dimension, with `time` [s since 1970].
    trajectory
        Which deployment this is.
    about
        Global attributes: title, source, history, ...
    """
    (dimension,) = samples["time"].dims
    place = "time depth latitude longitude"
    found = samples.rename({dimension: "obs"}) if dimension != "obs" else samples.copy()
    found = found.reset_coords().assign(
        time=("obs", seconds(samples["time"].values), TIME),
        trajectory=((), trajectory, {"cf_role": "trajectory_id", "long_name": "name of the deployment"}),
    )
    found = found.set_coords([name for name in place.split() if name in found])
    return found.assign_attrs(
        {
            "Conventions": CONVENTIONS,
            "featureType": "trajectory",
            "source": f"stommel {__version__}",
            **about,
        }
    )


def write_netcdf(samples: xr.Dataset, path: Path) -> None:
    """Write a data set; whole or not at all."""
    with whole_file(path) as made:
        samples.to_netcdf(made, format="NETCDF4", engine="netcdf4", encoding=_encoding(samples))


def write_netcdf_pieces(pieces: Iterator[xr.Dataset], path: Path) -> int:
    """Write a data set that comes in pieces along `obs`, of which one is held at a time; how many samples.

    Parameters
    ----------
    pieces
        From `as_trajectory`, at least one, each with the same variables.
    path
        Is written whole or not at all.
    """
    with whole_file(path) as made:
        first = next(pieces)
        encoding = _encoding(first)
        for name, variable in first.variables.items():
            if variable.dims == ("obs",):
                encoding.setdefault(name, {})["chunksizes"] = (_CHUNK,)
        first.to_netcdf(made, format="NETCDF4", engine="netcdf4", encoding=encoding, unlimited_dims=["obs"])
        count = first.sizes["obs"]
        with netCDF4.Dataset(made, "a") as file:
            for piece in pieces:
                end = count + piece.sizes["obs"]
                for name, variable in piece.variables.items():
                    if variable.dims == ("obs",):
                        file[str(name)][count:end] = np.ma.masked_invalid(variable.values)
                count = end
    return count


def _encoding(samples: xr.Dataset) -> dict[Any, dict[str, Any]]:
    encoding: dict[Any, dict[str, Any]] = {}
    for name, variable in samples.variables.items():
        if variable.dtype.kind == "f":
            fill = None if name == "time" else _FILL
            encoding[name] = {"zlib": True, "complevel": 4, "_FillValue": fill}
        elif variable.ndim and variable.dtype.kind in "iu":
            encoding[name] = {"zlib": True, "complevel": 4}
    return encoding


def csv_lines(samples: xr.Dataset, *, head: bool = True) -> Iterator[str]:
    """CSV in pieces: a head of names with units, then a line a sample; an empty cell is what is not known."""
    names = [name for name, variable in samples.variables.items() if variable.ndim == 1]
    names.sort(key=lambda name: name != "time")
    if head:
        yield _written([[_title(str(name), samples[name].attrs) for name in names]])
    columns = [samples[name].values for name in names]
    for begin in range(0, samples["time"].size, _ROWS):
        part = [column[begin : begin + _ROWS] for column in columns]
        yield _written(zip(*map(_cells, names, part), strict=True))


def csv_of_pieces(pieces: Iterable[xr.Dataset]) -> Iterator[str]:
    """CSV of a data set that comes in pieces, each with the same variables: one head, then all lines."""
    for number, piece in enumerate(pieces):
        yield from csv_lines(piece, head=number == 0)


def write_csv(samples: xr.Dataset, path: Path) -> None:
    """Write `csv_lines`; whole or not at all."""
    write_csv_pieces([samples], path)


def write_csv_pieces(pieces: Iterable[xr.Dataset], path: Path) -> None:
    """Write `csv_of_pieces`; whole or not at all."""
    with whole_file(path) as made, made.open("w", encoding="utf-8", newline="") as file:
        file.writelines(csv_of_pieces(pieces))


def _title(name: str, attributes: Mapping[str, Any]) -> str:
    if name == "time":
        return "time [UTC]"
    unit = str(attributes.get("units", ""))
    return name if unit in ("", "1") else f"{name} [{unit}]"


def _cells(name: object, values: np.ndarray[Any, Any]) -> list[str]:
    if name == "time":
        good = np.isfinite(values)
        stamps = (np.where(good, values, 0.0) * 1e3).round().astype("datetime64[ms]")
        return [f"{stamp}Z" if known else "" for stamp, known in zip(stamps, good, strict=True)]
    if values.dtype.kind == "f":
        return ["" if np.isnan(value) else f"{value:.10g}" for value in values.tolist()]
    return [str(value) for value in values.tolist()]


def _written(rows: Any) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()
