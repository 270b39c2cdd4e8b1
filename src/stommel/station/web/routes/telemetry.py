"""Every sample of what a vehicle sent, as files: the channels and the time that somebody looks at."""

import tempfile
from collections.abc import Iterator
from itertools import chain
from pathlib import Path
from typing import Annotated

from fastapi import APIRouter, Query
from fastapi.responses import FileResponse, StreamingResponse
from starlette.background import BackgroundTask

from stommel.archive.sample_pieces import SamplePiece, kept_channels, sample_pieces
from stommel.archive.telemetry_file import HEAD, lines_of
from stommel.archive.times import GREATEST_TIME
from stommel.data.files import write_netcdf_pieces
from stommel.station.station import Station
from stommel.station.telemetry import telemetry_pieces
from stommel.station.web.access import Viewer
from stommel.station.web.asked import asked_channels
from stommel.station.web.found import Line, TheStation
from stommel.station.web.routes.data import Begin, End, InOrder

router = APIRouter(prefix="/api", tags=["series"])

Channels = Annotated[
    str | None,
    Query(min_length=1, max_length=2000, description="Keys, with commas between them; all there are if left out."),
]


@router.get("/vehicles/{vehicle}/telemetry.csv", response_class=StreamingResponse, dependencies=[InOrder])
def download_csv(
    line: Line, station: TheStation, _user: Viewer, channels: Channels = None, begin: Begin = 0.0,
    end: End = GREATEST_TIME,
) -> StreamingResponse:  # fmt: skip
    """Every sample of some channels between two times, as CSV: a line a sample, channel by channel."""
    pieces = sample_pieces(station.archive, line.vehicle, _keys(channels, station, line.vehicle), begin, end)
    first = list(zip(range(1), pieces, strict=False))  # an archive that fails is told before anything is sent
    text = _utf8(chain((piece for _, piece in first), pieces))
    return StreamingResponse(text, media_type="text/csv", headers=_attachment(line.vehicle, "csv"))


@router.get("/vehicles/{vehicle}/telemetry.nc", response_class=FileResponse, dependencies=[InOrder])
def download_netcdf(
    line: Line, station: TheStation, _user: Viewer, channels: Channels = None, begin: Begin = 0.0,
    end: End = GREATEST_TIME,
) -> FileResponse:  # fmt: skip
    """Every sample of some channels between two times, as CF NetCDF: a variable a channel, at the times of all."""
    keys = _keys(channels, station, line.vehicle)
    folder = tempfile.TemporaryDirectory(prefix="stommel-")
    path = Path(folder.name) / "telemetry.nc"
    try:
        write_netcdf_pieces(telemetry_pieces(station.archive, line.vehicle, keys, begin, end), path)
    except BaseException:
        folder.cleanup()
        raise
    return FileResponse(
        path,
        media_type="application/x-netcdf",
        headers=_attachment(line.vehicle, "nc"),
        background=BackgroundTask(folder.cleanup),
    )


def _keys(channels: str | None, station: Station, vehicle: int) -> list[str]:
    if channels is None:
        return kept_channels(station.archive, vehicle)
    return [channel.key for channel in asked_channels(channels)]


def _utf8(pieces: Iterator[SamplePiece]) -> Iterator[bytes]:
    yield HEAD.encode()
    for piece in pieces:
        yield lines_of(piece).encode()


def _attachment(vehicle: int, ending: str) -> dict[str, str]:
    return {"Content-Disposition": f'attachment; filename="vehicle-{vehicle}-telemetry.{ending}"'}
