"""Values over time, reduced to what a plot can show; the track; what the vehicle said in words."""

import math
from typing import Annotated, Literal

from fastapi import APIRouter, Query
from pydantic import BaseModel

from stommel.archive.series import FEWEST_POINTS, MOST_POINTS
from stommel.archive.times import GREATEST_TIME
from stommel.archive.whereabouts.span import TrackSpan, span_of
from stommel.archive.whereabouts.track import read_track
from stommel.station.web.access import Viewer
from stommel.station.web.asked import asked_channels
from stommel.station.web.errors import refusal
from stommel.station.web.found import Line, TheStation

router = APIRouter(prefix="/api", tags=["series"])

HOUR = 3600.0
FIRST, LAST = 0.0, GREATEST_TIME
Time = Annotated[float | None, Query(ge=FIRST, le=LAST, allow_inf_nan=False, description="Seconds since 1970.")]
Points = Annotated[int, Query(ge=FEWEST_POINTS, le=MOST_POINTS, description="To be shown, at most.")]


class Curve(BaseModel):
    """What to draw of a channel."""

    t: list[float]
    value: list[float | None]
    """null between two samples that are further apart than usual: a gap is drawn as a gap."""
    samples: int
    """How many there are in the range."""
    reduced: bool
    """Whether some were left out."""


class SeriesAnswer(BaseModel):
    """Channels over a range of time [s since 1970]."""

    begin: float
    end: float
    channels: dict[str, Curve]


class TrackAnswer(BaseModel):
    """Where a vehicle was [deg], how sure that is [m], and from what it is known: `gps` or `estimate`."""

    begin: float
    end: float
    """The range over which it goes [s since 1970]."""
    t: list[float]
    latitude: list[float]
    longitude: list[float]
    sigma_m: list[float | None]
    """Standard deviation along one direction."""
    source: list[str]
    left_out: int
    """Positions at which the vehicle cannot have been, as 0, 0 and leaps faster than 5 m/s; the archive keeps them."""


class Sentence(BaseModel):
    """Something that the vehicle said in words; severity 0 is the worst, 7 the least."""

    t: float
    severity: int
    words: str


@router.get("/vehicles/{vehicle}/series")
def show_series(
    _user: Viewer,
    line: Line,
    station: TheStation,
    channels: Annotated[str, Query(min_length=1, max_length=2000, description="Keys, with commas between them.")],
    begin: Time = None,
    end: Time = None,
    points: Points = 2000,
    method: Literal["minmax", "lttb", "raw"] = "minmax",
) -> SeriesAnswer:
    """Return channels over a range of time; the last hour if no range is given.

    `minmax` keeps the lowest and highest of each stretch, `lttb` the shape, `raw` everything.
    """
    begin, end = _range(line.clock.now(), begin, end)
    curves = {}
    for channel in asked_channels(channels):
        found = station.archive.series(line.vehicle, channel.key, begin, end, points, method, turn=channel.turn)
        value = [None if math.isnan(each) else each for each in found.value.tolist()]
        curves[channel.key] = Curve(t=found.t.tolist(), value=value, samples=found.samples, reduced=found.reduced)
    return SeriesAnswer(begin=begin, end=end, channels=curves)


@router.get("/vehicles/{vehicle}/track")
def show_track(
    _user: Viewer,
    line: Line,
    station: TheStation,
    begin: Time = None,
    end: Time = None,
    points: Points = 2000,
    span: TrackSpan = "day",
) -> TrackAnswer:
    """Return where a vehicle was; without a begin, over a span up to the last position before the end.

    `day` is the last day of which positions are known, `mission` all of the mission that it held at the end and no
    less than a day, `all` everything.
    """
    if begin is None:
        begin, end = span_of(station.archive, line.vehicle, span, min(line.clock.now(), LAST) if end is None else end)
    else:
        begin, end = _range(line.clock.now(), begin, end)
    found = read_track(station.archive, line.vehicle, begin, end, points)
    return TrackAnswer.model_validate(found._asdict() | {"begin": begin, "end": end})


@router.get("/vehicles/{vehicle}/texts")
def list_texts(
    _user: Viewer,
    line: Line,
    station: TheStation,
    begin: Time = None,
    end: Time = None,
    limit: Annotated[int, Query(ge=1, le=10_000)] = 200,
) -> list[Sentence]:
    """Return what the vehicle said in words, the newest last."""
    begin, end = _range(line.clock.now(), FIRST if begin is None else begin, end)
    found = station.archive.texts(line.vehicle, begin=begin, end=end, limit=limit)
    return [Sentence.model_validate(each._asdict()) for each in found]


def _range(now: float, begin: float | None, end: float | None) -> tuple[float, float]:
    end = min(now, LAST) if end is None else end
    begin = max(FIRST, end - HOUR) if begin is None else begin
    if begin > end:
        raise refusal(422, "the range ends before it begins", key="end", value=end, allowed=f"at least {begin:g}")
    return begin, end
