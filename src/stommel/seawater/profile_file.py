"""Stratification from a file: CSV whose column names declare quantity and unit."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from stommel.errors import FileError, Problem
from stommel.files.delimited import Delimited, number_in, read_delimited
from stommel.files.nearest import did_you_mean
from stommel.files.sentences import shown
from stommel.seawater import properties
from stommel.seawater.stratification import Stratification

VERTICAL = ("depth_m", "pressure_dbar")
TEMPERATURE = ("temperature_c", "potential_temperature_c", "conservative_temperature_c")
SALINITY = ("salinity_psu", "absolute_salinity_g_kg")
DENSITY = "density_kg_m3"
KNOWN = (*VERTICAL, *TEMPERATURE, *SALINITY, DENSITY)
"""Names of columns; each ends with its unit. Plain temperature is in situ, salinity in psu is practical salinity."""

_ALLOWED = {
    "depth_m": (0.0, 12000.0), "pressure_dbar": (0.0, 12000.0), "temperature_c": (-5.0, 42.0),
    "potential_temperature_c": (-5.0, 42.0), "conservative_temperature_c": (-5.0, 42.0), "salinity_psu": (0.0, 42.0),
    "absolute_salinity_g_kg": (0.0, 42.0), "density_kg_m3": (900.0, 1100.0),
}  # fmt: skip

_MARK = 1e-20
"""Numbers smaller than this are no readings: Sea-Bird's programs write -9.99e-29 for a bad one."""


def read_stratification(
    path: str | Path,
    columns: Mapping[str, str] | None = None,
    *,
    latitude: float = 30.0,
    longitude: float = 0.0,
) -> Stratification:
    """Read a profile: one of the vertical columns, and temperature with salinity, or density, or all three.

    Parameters
    ----------
    path
        CSV file with a line of column names; lines that begin with # are comments.
    columns
        Where the file's own names are different: declared name to the file's, as `{"temperature_c": "T"}`.
    latitude, longitude
        Where the profile was taken, for pressure and for the composition of the salt [deg].

    Raises
    ------
    FileError
        The file cannot be read, a column is missing, or a number is impossible; every problem is listed.
    """
    name = str(path)
    table = read_delimited(path)
    data = _numbers(table, dict(columns or {}))
    problems = [*_missing(name, data), *_impossible(table, data)]
    if problems:
        raise FileError(problems)
    return _stratification(name, data, latitude, longitude)


def _numbers(table: Delimited, columns: dict[str, str]) -> dict[str, NDArray[np.float64]]:
    name, header = table.file, table.header
    unknown = sorted(set(columns) - set(KNOWN))
    if unknown:
        text = f"columns: unknown name {unknown[0]}{did_you_mean(unknown[0], KNOWN)} known: {', '.join(KNOWN)}"
        raise FileError([Problem(name, unknown[0], text)])
    absent = [f"{key} = {columns[key]!r}" for key in columns if columns[key] not in header]
    if absent:
        raise FileError([Problem(name, "", f"no column {absent[0]}; there are: {', '.join(header)}")])
    wanted = {key: columns.get(key, key) for key in KNOWN}
    return {key: _column(table, title) for key, title in wanted.items() if title in header}


def _column(table: Delimited, title: str) -> NDArray[np.float64]:
    values = []
    for row, cell in zip(table.lines, table.cells(title), strict=True):
        value = number_in(cell)
        if value is None:
            text = f"row {row}: {title} = {shown(cell)}: must be a number"
            raise FileError([Problem(table.file, title, text)])
        values.append(value)
    return np.array(values)


def _missing(name: str, data: Mapping[str, NDArray[np.float64]]) -> list[Problem]:
    problems = []
    for group, what in ((VERTICAL, "vertical"), (TEMPERATURE, "temperature"), (SALINITY, "salinity")):
        present = [key for key in group if key in data]
        if len(present) > 1:
            problems.append(Problem(name, present[1], f"{' and '.join(present)}: only one {what} column is allowed"))
        if not present and (what == "vertical" or DENSITY not in data):
            problems.append(Problem(name, group[0], f"no {what} column; add one of {', '.join(group)}"))
    return problems


def _impossible(table: Delimited, data: Mapping[str, NDArray[np.float64]]) -> list[Problem]:
    problems = [problem for key, values in data.items() if (problem := _out_of_range(table, key, values)) is not None]
    for key in VERTICAL:
        if key in data and np.any(np.diff(data[key]) <= 0.0):
            k = int(np.argmax(np.diff(data[key]) <= 0.0))
            pair = f"{data[key][k]:g} is followed by {data[key][k + 1]:g} in row {table.lines[k + 1]}"
            problems.append(Problem(table.file, key, f"{key}: {pair}; it must increase from row to row"))
    return problems


def _out_of_range(table: Delimited, key: str, values: NDArray[np.float64]) -> Problem | None:
    """The first row whose value no sea has, or which an instrument marks as no reading."""
    low, high = _ALLOWED[key]
    marks = (values != 0.0) & (np.abs(values) < _MARK)
    wrong = np.flatnonzero(~((values >= low) & (values <= high)) | marks)
    if not wrong.size:
        return None
    k = int(wrong[0])
    mark = " (an instrument writes this for a bad reading: leave such rows out)" if marks[k] else ""
    others = f"; {wrong.size} of {values.size} rows are so" if wrong.size > 1 else ""
    text = f"row {table.lines[k]}: {key} = {values[k]:g}: must be between {low:g} and {high:g}{mark}{others}"
    return Problem(table.file, key, text)


def _stratification(
    name: str, data: Mapping[str, NDArray[np.float64]], latitude: float, longitude: float
) -> Stratification:
    if "pressure_dbar" in data:
        p = data["pressure_dbar"]
        depths = properties.depth_from_pressure(p, latitude)
    else:
        depths = data["depth_m"]
        p = properties.pressure_from_depth(depths, latitude)
    if "absolute_salinity_g_kg" in data:
        S_A = data["absolute_salinity_g_kg"]
    else:
        # density without salinity: the salinity matters only beside the density, and is taken as the standard ocean's
        S_A = properties.absolute_salinity(data.get("salinity_psu", np.full(p.shape, 35.0)), p, longitude, latitude)
    if "conservative_temperature_c" in data:
        CT = data["conservative_temperature_c"]
    elif "potential_temperature_c" in data:
        CT = properties.conservative_from_potential(data["potential_temperature_c"], S_A)
    else:
        CT = properties.conservative_temperature(data.get("temperature_c", np.full(p.shape, 15.0)), S_A, p)
    given = data.get(DENSITY, np.zeros(0))
    return Stratification(depths, S_A, CT, latitude, depths if given.size else given, given, source=name)
