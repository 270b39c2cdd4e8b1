"""What was sampled: dives, profiles, sections, temperature against salinity, and files of it."""

import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
import xarray as xr
from fastapi import APIRouter, Depends, Query, Request
from fastapi import Path as PathValue
from fastapi.responses import FileResponse, StreamingResponse
from numpy.typing import NDArray
from pydantic import BaseModel
from sqlalchemy import select
from starlette.background import BackgroundTask

from stommel.archive import schema
from stommel.archive.readers import dive_of
from stommel.archive.times import GREATEST_TIME as LATEST
from stommel.archive.times import microseconds
from stommel.archive.whereabouts.dive_ends import told_dive, with_true_ends
from stommel.data.files import csv_of_pieces, write_netcdf_pieces
from stommel.data.variables import BY_NAME
from stommel.data.water_masses import density_lines
from stommel.products.record import SampleRecords
from stommel.products.samples import trajectory
from stommel.station.web.access import Viewer
from stommel.station.web.errors import refusal
from stommel.station.web.found import Line, TheStation

router = APIRouter(prefix="/api", tags=["data"])

MOST_POINTS = 20_000
"""Of a T-S diagram; of more every second, third ... is shown."""
_NO_PLACE = {"latitude": None, "longitude": None}
Sampled = Literal[
    "temperature", "conductivity", "practical_salinity", "absolute_salinity", "conservative_temperature", "density",
    "potential_density_anomaly", "sound_speed",
]  # fmt: skip
Begin = Annotated[float, Query(ge=0, le=LATEST, description="From when on [s since 1970].")]
End = Annotated[float, Query(ge=0, le=LATEST, description="Until when [s since 1970].")]


def _in_order(begin: Begin = 0.0, end: End = LATEST) -> None:
    if end < begin:
        raise refusal(422, "the range ends before it begins", key="end", value=end, allowed=f"at least {begin:.10g}")


InOrder = Depends(_in_order)


def _records(request: Request, station: TheStation) -> SampleRecords:
    """Kept with the application: what was read stays read."""
    state = request.app.state
    if not hasattr(state, "sample_records"):
        state.sample_records = SampleRecords(station.archive)
    records: SampleRecords = state.sample_records
    return records


Records = Annotated[SampleRecords, Depends(_records)]


class FlownDive(BaseModel):
    """A dive that the vehicle reported."""

    dive: int
    t_begin: float
    t_end: float | None
    latitude_begin: float | None
    longitude_begin: float | None
    latitude_end: float | None
    longitude_end: float | None
    greatest_depth_m: float | None
    current_north_m_s: float | None
    current_east_m_s: float | None
    energy_j: float | None


class Dive(FlownDive):
    """A dive as the vehicle told it, and what follows."""

    distance_m: float | None
    """Made good: between its ends, on the ellipsoid [m]."""


class ProfileLine(BaseModel):
    """A profile as a list shows it; null is what is not known."""

    number: int
    """From 1; a profile keeps its number."""
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


class Profile(BaseModel):
    """A profile: its line in the list, and its samples."""

    about: ProfileLine
    units: dict[str, str]
    values: dict[str, list[float | None]]
    """By variable, `depth` and `time` [s since 1970] among them."""


class SectionColumn(BaseModel):
    """A profile of a section: means of its samples."""

    profile_number: int
    profile_direction: int
    """1 down, -1 up."""
    time: float
    """Mean [s since 1970]."""
    latitude: float | None
    longitude: float | None
    distance: float | None
    """Along the track from the first profile of the stretch of time [m]; null where its place is not known."""


class Section(BaseModel):
    """A variable in cells of depth, a column for each profile."""

    variable: str
    words: str
    unit: str
    cell_m: float
    stride: int
    """Of so many profiles one is shown, at regular steps."""
    depth_m: list[float]
    """Middles of the cells."""
    profiles: list[SectionColumn]
    values: list[list[float | None]]
    """Means, by profile, then depth."""
    samples: list[list[int]]
    """Of how many samples each is the mean."""


class DensityLine(BaseModel):
    """A line of equal potential density anomaly."""

    level: float
    absolute_salinity: list[float]
    conservative_temperature: list[float]


class Diagram(BaseModel):
    """Conservative Temperature against Absolute Salinity."""

    samples: int
    """In range; of many only some are given, of very many those of some profiles."""
    absolute_salinity: list[float]
    conservative_temperature: list[float]
    depth_m: list[float]
    t: list[float]
    profile: list[int]
    lines: list[DensityLine]


@router.get("/vehicles/{vehicle}/dives", dependencies=[InOrder])
def read_dives(line: Line, station: TheStation, _user: Viewer, begin: Begin = 0.0, end: End = LATEST) -> list[Dive]:
    """Dives that began between two times."""
    d = schema.dives.c
    with station.archive.reading() as connection:
        rows = connection.execute(
            select(schema.dives)
            .where((d.vehicle_id == line.vehicle) & d.t_begin_us.between(microseconds(begin), microseconds(end)))
            .order_by(d.t_begin_us)
        )
        return [Dive(**told_dive(with_true_ends(dive_of(row)))) for row in rows]


@router.get("/vehicles/{vehicle}/profiles", dependencies=[InOrder])
def read_profiles(
    line: Line, records: Records, _user: Viewer, begin: Begin = 0.0, end: End = LATEST
) -> list[ProfileLine]:
    """Profiles that have samples between two times; each keeps its number."""
    return [ProfileLine(**row._asdict()) for row in records.lines(line.vehicle, begin, end)]


@router.get("/vehicles/{vehicle}/profiles/{number}")
def read_profile(
    line: Line, records: Records, _user: Viewer, number: Annotated[int, PathValue(ge=1, le=1_000_000)]
) -> Profile:
    """Samples of one profile."""
    found = records.profile(line.vehicle, number)
    if found is None:
        raise refusal(404, f"there is no profile {number}", key="number", value=number)
    about, samples = found
    names = [str(name) for name in samples.data_vars if name in BY_NAME]
    return Profile(
        about=ProfileLine(**about._asdict()),
        units={name: BY_NAME[name].units for name in names},
        values={name: _plain(samples[name].values) for name in [*names, "time"]},
    )


@router.get("/vehicles/{vehicle}/section", dependencies=[InOrder])
def read_section(
    line: Line,
    records: Records,
    _user: Viewer,
    variable: Sampled = "conservative_temperature",
    begin: Begin = 0.0,
    end: End = LATEST,
    cell_m: Annotated[float, Query(ge=0.1, le=100.0, description="Height of a cell [m].")] = 1.0,
) -> Section:
    """A variable in cells of depth by profile: means of the samples in each cell."""
    try:
        made, stride = records.section(line.vehicle, variable, begin, end, cell_m)
    except ValueError as error:
        raise refusal(422, str(error), key="cell_m", value=cell_m) from None
    columns = {str(name): _plain(made[name].values) for name in made.data_vars if made[name].dims == ("profile",)}
    return Section(
        variable=variable,
        words=BY_NAME[variable].long_name,
        unit=BY_NAME[variable].units,
        cell_m=cell_m,
        stride=stride,
        depth_m=made["depth"].values.tolist(),
        profiles=[
            SectionColumn.model_validate({**_NO_PLACE, **dict(zip(columns, row, strict=True))})
            for row in zip(*columns.values(), strict=True)
        ],
        values=[_plain(row) for row in made[variable].values],
        samples=made["samples_in_cell"].values.tolist(),
    )


@router.get("/vehicles/{vehicle}/ts", dependencies=[InOrder])
def read_water_masses(line: Line, records: Records, _user: Viewer, begin: Begin = 0.0, end: End = LATEST) -> Diagram:
    """Conservative Temperature against Absolute Salinity, with lines of equal potential density."""
    names = ("absolute_salinity", "conservative_temperature", "depth", "time", "profile_number")
    read = [[piece[name].values for name in names] for piece in records.thinned(line.vehicle, begin, end, names)]
    columns = [np.concatenate(parts) for parts in zip(*read, strict=True)]
    good = np.isfinite(columns[0]) & np.isfinite(columns[1])
    stride = max(1, -(-int(good.sum()) // MOST_POINTS))
    S, T, depth, t, profile = (column[good][::stride] for column in columns)
    lines = density_lines(_margin(S), _margin(T)) if S.size else ()
    return Diagram(
        samples=records.count(line.vehicle, begin, end),
        absolute_salinity=S.tolist(),
        conservative_temperature=T.tolist(),
        depth_m=np.nan_to_num(depth).tolist(),
        t=t.tolist(),
        profile=profile.tolist(),
        lines=[
            DensityLine(
                level=found.level,
                absolute_salinity=found.absolute_salinity.tolist(),
                conservative_temperature=found.conservative_temperature.tolist(),
            )
            for found in lines
        ],
    )


@router.get("/vehicles/{vehicle}/data.csv", response_class=StreamingResponse, dependencies=[InOrder])
def download_csv(
    line: Line, station: TheStation, records: Records, _user: Viewer, begin: Begin = 0.0, end: End = LATEST
) -> StreamingResponse:
    """Samples between two times with everything derived, as CSV with the units in its head."""
    pieces = (trajectory(station.archive, line.vehicle, each) for each in records.pieces(line.vehicle, begin, end))
    return StreamingResponse(_utf8(pieces), media_type="text/csv", headers=_attachment(line.vehicle, "csv"))


@router.get("/vehicles/{vehicle}/data.nc", response_class=FileResponse, dependencies=[InOrder])
def download_netcdf(
    line: Line, station: TheStation, records: Records, _user: Viewer, begin: Begin = 0.0, end: End = LATEST
) -> FileResponse:
    """Samples between two times with everything derived, as CF NetCDF."""
    pieces = (trajectory(station.archive, line.vehicle, each) for each in records.pieces(line.vehicle, begin, end))
    folder = tempfile.TemporaryDirectory(prefix="stommel-")
    path = Path(folder.name) / "data.nc"
    write_netcdf_pieces(pieces, path)
    return FileResponse(
        path,
        media_type="application/x-netcdf",
        headers=_attachment(line.vehicle, "nc"),
        background=BackgroundTask(folder.cleanup),
    )


def _attachment(vehicle: int, ending: str) -> dict[str, str]:
    return {"Content-Disposition": f'attachment; filename="vehicle-{vehicle}.{ending}"'}


def _utf8(pieces: Iterator[xr.Dataset]) -> Iterator[bytes]:
    for text in csv_of_pieces(pieces):
        yield text.encode()


def _margin(values: NDArray[np.float64]) -> tuple[float, float]:
    """Range of values and a little beyond."""
    low, high = float(values.min()), float(values.max())
    margin = max(0.05 * (high - low), 0.05)
    return max(low - margin, 0.0) if low >= 0.0 else low - margin, high + margin


def _plain(values: NDArray[Any]) -> list[Any]:
    """Values as JSON has them: what is no number is null."""
    if values.dtype.kind != "f":
        found: list[Any] = values.tolist()
        return found
    return [None if value != value else value for value in values.tolist()]  # noqa: PLR0124
