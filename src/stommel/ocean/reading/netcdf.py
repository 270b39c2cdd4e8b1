"""An ocean from CF NetCDF files."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from stommel.files.nearest import did_you_mean
from stommel.ocean import times as clock
from stommel.ocean.answers import Region
from stommel.ocean.errors import UnknownOceanError
from stommel.ocean.kernel.building import Frame, Slot, ocean_grid
from stommel.ocean.kernel.grid import FIELDS, OceanGrid
from stommel.ocean.reading.plausible import left_out, require_salinity, require_speed
from stommel.ocean.reading.region import inside
from stommel.ocean.reading.sea_floor import read_sea_floor
from stommel.ocean.reading.series import (
    Layout,
    Layouts,
    Series,
    check_same_places,
    check_same_times,
    layout_of,
    numbers_at,
    series_of,
)
from stommel.ocean.reading.sources import opened
from stommel.ocean.reading.units import QUANTITY_OF, UNITS, plain
from stommel.ocean.reading.variables import OWN_NAMES, File
from stommel.ocean.times import Time, seconds
from stommel.seawater import properties

Array = NDArray[np.float64]

YEAR = 365.2425 * 86400.0
"""Mean year of the calendar, after which a climatology repeats [s]."""
_MOST_BYTES = 4e9
"""A grid larger than this is refused: it must be cut to the mission's region."""
_DEEPEST_FIRST_LEVEL = 20.0
"""A first level deeper than this is worth a note: the water above is held [m]."""


@dataclass(frozen=True)
class Reading:
    """What of the files is read, and how; `Ocean.open` describes the arguments."""

    names: dict[str, str]
    units: dict[str, str]
    bounds: Region | None = None
    between: tuple[Time, Time] | None = None
    yearly: bool | None = None
    at_rest: bool = False
    mean_slot: bool = False
    beyond: bool = False
    """Times outside the files are answered by a policy: none of them need be in `between`."""


@dataclass(frozen=True)
class _Fields:
    """The quantities over time, and whether the currents are east and north; none where the water is at rest."""

    temperature: Series
    salinity: Series
    u: Series | None
    v: Series | None
    geographic: bool

    @property
    def all(self) -> list[Series]:
        return [series for series in (self.temperature, self.salinity, self.u, self.v) if series is not None]


def read_ocean(paths: Sequence[Path], reading: Reading) -> tuple[OceanGrid, dict[str, str]]:
    """Read the grid of files and notes on what was found where."""
    unknown = sorted(set(reading.names) - set(OWN_NAMES))
    if unknown:
        hint = did_you_mean(unknown[0], OWN_NAMES)
        raise UnknownOceanError(f"names: unknown key {unknown[0]}{hint} known: {', '.join(OWN_NAMES)}")
    _check_units(reading.units)
    with opened(paths, reading.names, reading.units) as files:
        return _read(files, reading)


def _check_units(units: dict[str, str]) -> None:
    for what, unit in units.items():
        if what not in QUANTITY_OF:
            hint = did_you_mean(what, QUANTITY_OF)
            raise UnknownOceanError(f"units: unknown key {what}{hint} known: {', '.join(QUANTITY_OF)}")
        known = UNITS[QUANTITY_OF[what]]
        if plain(unit) not in known:
            raise UnknownOceanError(f"units: {what} = {unit!r}: must be one of {', '.join(known)}")


def _read(files: Sequence[File], reading: Reading) -> tuple[OceanGrid, dict[str, str]]:
    _check_dimensions(files, reading.names)
    fields = _fields(files, at_rest=reading.at_rest)
    first, nodes = fields.temperature, fields.temperature.first.nodes
    yearly = first.of_every_year if reading.yearly is None else reading.yearly
    slots = np.arange(len(first.times)) if yearly else _slots(first, reading)
    j, i = inside(first.first.file, nodes, reading.bounds)
    _check_size(first.first, len(slots), len(j), len(i))
    box = np.ix_(j, i)
    here = replace(nodes, latitude=nodes.latitude[box], longitude=nodes.longitude[box])
    bottom, bottom_note = read_sea_floor(files, first.first, _wet(first, int(slots[0]), (j, i)), (j, i))
    frame = Frame(
        first.times[slots], _span(first, slots, yearly=yearly), first.first.depths, here.latitude, here.longitude,
        bottom, period=YEAR if yearly else np.inf,
    )  # fmt: skip
    try:
        grid = ocean_grid(frame, _slices(fields, slots, (j, i), frame), mean_slot=reading.mean_slot)
    except UnknownOceanError as error:
        first.first.file.refuse(first.first.variable, str(error))
    return grid, _notes(fields, frame, bottom_note, len(files)) | _told(files)


def _wet(series: Series, n: int, box: tuple[NDArray[np.intp], NDArray[np.intp]]) -> NDArray[np.bool_]:
    """Nodes with water at the first level."""
    layout, slot = series.places[n]
    wet: NDArray[np.bool_] = np.isfinite(numbers_at(layout, series.what, slot, *box, top=True)[0])
    return wet


def _told(files: Sequence[File]) -> dict[str, str]:
    """What was left out or set right, by variable."""
    return {f"numbers of {key}": text for file in files for key, text in file.tally.told().items()}


def _check_dimensions(files: Sequence[File], names: dict[str, str]) -> None:
    """Refuse a time or depth that no variable has as a dimension."""
    for what in ("time", "depth"):
        if what in names and not any(names[what] in file.data.dims for file in files):
            there = ", ".join(map(str, files[0].data.dims)) or "none"
            files[0].refuse(what, f"names: {what} = {names[what]!r}: no such dimension; there are: {there}")


def _fields(files: Sequence[File], *, at_rest: bool) -> _Fields:
    """Find the quantities in the files, and check that all lie at the same times, levels and nodes."""
    known: Layouts = {}
    temperature, salinity = (_series(files, what, known) for what in ("temperature", "salinity"))
    east, north = _holders(files, "current_east"), _holders(files, "current_north")
    geographic = bool(east and north)
    currents = ("current_east", "current_north") if geographic else ("current_x", "current_y")
    u, v = (None, None) if at_rest else (_series(files, what, known, turned=not geographic) for what in currents)
    fields = _Fields(temperature, salinity, u, v, geographic)
    for series in fields.all:
        for layout in {id(layout): layout for layout, _ in series.places}.values():
            check_same_places(temperature.first, layout)
        check_same_times(temperature, series)
    return fields


def _holders(files: Sequence[File], what: str) -> list[File]:
    return [file for file in files if file.find(what, needed=False) is not None]


def _series(files: Sequence[File], what: str, known: Layouts, *, turned: bool = False) -> Series:
    holders = _holders(files, what)
    if not holders:
        files[0].find(what)  # says what is missing
    return series_of(what, [layout_of(file, str(file.find(what)), known, turned=turned) for file in holders])


def _slots(series: Series, reading: Reading) -> NDArray[np.intp]:
    """Indices of the times that a mission between two times needs."""
    times = series.times
    if reading.between is None or series.first.time is None:
        return np.arange(len(times))
    first, last = seconds(reading.between[0]), seconds(reading.between[1])
    if last < first:
        raise UnknownOceanError("between: the last time must not be before the first")
    if not reading.beyond and (last < series.spoken_for[0] or first > series.spoken_for[1]):
        covered = " to ".join(clock.text(time) for time in series.spoken_for)
        series.first.file.refuse("time", f"has no times in the wanted interval; it has {covered}")
    start = min(max(int(np.searchsorted(times, first, side="right")) - 1, 0), len(times) - 1)
    return np.arange(start, max(min(int(np.searchsorted(times, last, side="left")) + 1, len(times)), start + 1))


def _span(series: Series, slots: NDArray[np.intp], *, yearly: bool) -> tuple[float, float]:
    """First and last time that the chosen slots speak for [s]."""
    times = series.times
    if yearly:
        if times[-1] - times[0] >= YEAR:
            series.first.file.refuse("time", "spans more than a year; a climatology must lie within one")
        return -np.inf, np.inf
    return (
        series.spoken_for[0] if slots[0] == 0 else float(times[slots[0]]),
        series.spoken_for[1] if slots[-1] == len(times) - 1 else float(times[slots[-1]]),
    )


def _check_size(layout: Layout, slots: int, rows: int, columns: int) -> None:
    size = 4.0 * FIELDS * slots * len(layout.depths) * rows * columns
    if size > _MOST_BYTES:
        layout.file.refuse(
            layout.variable,
            f"the ocean needs {size / 1e9:.1f} GB of memory; cut it with bounds (south, north, west, east) or between",
        )


def _slices(
    fields: _Fields, slots: NDArray[np.intp], box: tuple[NDArray[np.intp], NDArray[np.intp]], frame: Frame
) -> Iterator[Slot]:
    """Read one time after the other, and convert to Absolute Salinity and Conservative Temperature."""
    latitude, longitude = np.degrees(frame.latitude), np.degrees(frame.longitude)
    p = properties.pressure_from_depth(frame.depths[:, None, None], latitude)
    for n in map(int, slots):
        S, given = fields.salinity.read(n, "salinity", *box), fields.temperature.read(n, "temperature", *box)
        east, north = _currents(fields, n, box, S.shape)
        _leave_out(fields, n, S, given, (east == 0.0) & (north == 0.0))
        absolute = _standard_name(fields.salinity, n) == "sea_water_absolute_salinity"
        S_A = S if absolute else properties.absolute_salinity(S, p, longitude, latitude)
        T, CT = _temperatures(_standard_name(fields.temperature, n), given, S_A, p)
        yield Slot(T, S_A, CT, east, north)


def _currents(
    fields: _Fields, n: int, box: tuple[NDArray[np.intp], NDArray[np.intp]], shape: tuple[int, ...]
) -> tuple[Array, Array]:
    if fields.u is None or fields.v is None:
        return np.zeros(shape), np.zeros(shape)
    east, north = fields.u.read(n, "velocity", *box), fields.v.read(n, "velocity", *box)
    require_speed(fields.u.first.file, fields.u.first.variable, east, north)
    if fields.geographic:
        return east, north
    return to_east_and_north(east, north, fields.u.places[n][0].nodes.angle[np.ix_(*box)])


def _leave_out(fields: _Fields, n: int, S: Array, given: Array, still: NDArray[np.bool_]) -> None:
    """Leave out what is no water by the look of the field, or refuse it."""
    salinity, temperature = fields.salinity.places[n][0], fields.temperature.places[n][0]
    if "salinity" not in salinity.file.units:
        require_salinity(salinity.file, salinity.variable, S)
    wrong = left_out((salinity.file, salinity.variable), (temperature.file, temperature.variable), S, given, still)
    S[wrong] = np.nan


def _standard_name(series: Series, n: int) -> str:
    layout = series.places[n][0]
    return layout.file.standard_name(layout.variable)


def to_east_and_north(u: Array, v: Array, angle: Array) -> tuple[Array, Array]:
    """Turn components along a grid's axes by the angle from east to its x axis [rad]."""
    return u * np.cos(angle) - v * np.sin(angle), u * np.sin(angle) + v * np.cos(angle)


def _temperatures(standard_name: str, given: Array, S_A: Array, p: Array) -> tuple[Array, Array]:
    """In-situ and Conservative Temperature of whichever the file has."""
    if standard_name == "sea_water_temperature":
        return given, properties.conservative_temperature(given, S_A, p)
    if standard_name == "sea_water_conservative_temperature":
        return properties.in_situ_temperature(given, S_A, p), given
    CT = properties.conservative_from_potential(given, S_A)
    return properties.in_situ_temperature(CT, S_A, p), CT


def _notes(fields: _Fields, frame: Frame, bottom: str, count: int) -> dict[str, str]:
    """Say what was read from where, and what was assumed."""
    u, v = fields.u, fields.v
    notes = {
        "temperature": _taken(fields.temperature, "potential temperature"),
        "salinity": _taken(fields.salinity, "practical salinity"),
        "bottom": bottom,
    }
    if u is None or v is None:
        notes["currents"] = "at rest, as asked"
    else:
        how = "east and north" if fields.geographic else f"along the grid's axes, turned by {u.first.nodes.how}"
        notes["currents"] = f"{u.first.variable}, {v.first.variable}: {how}"
    if count > 1:
        notes["files"] = f"{count} files joined"
    if np.isfinite(frame.period):
        notes["times"] = "the same every year"
    if frame.depths[0] > _DEEPEST_FIRST_LEVEL:
        notes["surface"] = f"the first level, {frame.depths[0]:g} m, is held up to the surface"
    if frame.latitude.size == 1:
        notes["place"] = "one place: the same everywhere"
    return notes


def _taken(series: Series, otherwise: str) -> str:
    """Say which quantity a variable was taken for."""
    return f"{series.first.variable}: {_standard_name(series, 0) or f'taken as {otherwise} (no standard_name)'}"
