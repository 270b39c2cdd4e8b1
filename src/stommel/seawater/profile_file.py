"""Stratification from a file: CSV whose column names declare quantity and unit."""

import csv
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from stommel.errors import FileError, Problem
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
    try:
        lines = Path(path).read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise FileError([Problem(name, "", f"cannot be read: {reason}")]) from error
    data = _numbers(name, lines, dict(columns or {}))
    problems = [*_missing(name, data), *_impossible(name, data)]
    if problems:
        raise FileError(problems)
    return _stratification(name, data, latitude, longitude)


def _numbers(name: str, lines: list[str], columns: dict[str, str]) -> dict[str, NDArray[np.float64]]:
    unknown = sorted(set(columns) - set(KNOWN))
    if unknown:
        raise FileError([Problem(name, unknown[0], f"columns: unknown name {unknown[0]}; known: {', '.join(KNOWN)}")])
    kept = [(number, line) for number, line in enumerate(lines, 1) if line.strip() and not line.startswith("#")]
    if not kept:
        raise FileError([Problem(name, "", "is empty; a profile needs a line of column names and one of numbers")])
    rows = list(csv.reader(line for _, line in kept))
    header = [cell.strip() for cell in rows[0]]
    wanted = {key: columns.get(key, key) for key in KNOWN}
    absent = [f"{key} = {columns[key]!r}" for key in columns if columns[key] not in header]
    if absent:
        raise FileError([Problem(name, "", f"no column {absent[0]}; there are: {', '.join(header)}")])
    found: dict[str, NDArray[np.float64]] = {}
    for key, title in wanted.items():
        if title in header:
            place = header.index(title)
            found[key] = np.array(
                [_number(name, line, title, row, place) for (line, _), row in zip(kept[1:], rows[1:], strict=True)]
            )
    return found


def _number(name: str, line: int, title: str, row: list[str], place: int) -> float:
    try:
        return float(row[place])
    except (IndexError, ValueError):
        shown = row[place] if place < len(row) else ""
        raise FileError([Problem(name, title, f"line {line}: {title} = {shown!r}: must be a number")]) from None


def _missing(name: str, data: Mapping[str, NDArray[np.float64]]) -> list[Problem]:
    problems = []
    for group, what in ((VERTICAL, "vertical"), (TEMPERATURE, "temperature"), (SALINITY, "salinity")):
        present = [key for key in group if key in data]
        if len(present) > 1:
            problems.append(Problem(name, present[1], f"{' and '.join(present)}: only one {what} column is allowed"))
        if not present and (what == "vertical" or DENSITY not in data):
            problems.append(Problem(name, group[0], f"no {what} column; add one of {', '.join(group)}"))
    if not problems and next(iter(data.values())).size == 0:
        problems.append(Problem(name, "", "has column names but no numbers"))
    return problems


def _impossible(name: str, data: Mapping[str, NDArray[np.float64]]) -> list[Problem]:
    problems = []
    for key, values in data.items():
        low, high = _ALLOWED[key]
        wrong = values[~((values >= low) & (values <= high))]
        if wrong.size:
            problems.append(Problem(name, key, f"{key} = {wrong[0]:g}: must be between {low:g} and {high:g}"))
    for key in VERTICAL:
        if key in data and np.any(np.diff(data[key]) <= 0.0):
            place = int(np.argmax(np.diff(data[key]) <= 0.0))
            pair = f"{data[key][place]:g} is followed by {data[key][place + 1]:g}"
            problems.append(Problem(name, key, f"{key}: {pair}; it must increase from row to row"))
    return problems


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
