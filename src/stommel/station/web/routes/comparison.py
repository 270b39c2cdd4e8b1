"""The mission that a vehicle holds: what was predicted of it, and what became of it."""

from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from fastapi import APIRouter, Query
from pydantic import BaseModel

from stommel.archive.times import GREATEST_TIME
from stommel.archive.whereabouts.dive_ends import with_true_ends
from stommel.archive.whereabouts.track import BY_GPS, read_track
from stommel.errors import FileError
from stommel.geometry.geodesics import Place
from stommel.plans.comparison import compared
from stommel.plans.flown import geofence_of, held_mission
from stommel.plans.kept_preview import KeptPreview, PlannedDive, Prediction, TrackPoint, kept_preview
from stommel.plans.predicted_track import PredictedTrack
from stommel.plans.so_far import so_far
from stommel.plans.way import first_outside
from stommel.station.station import Station
from stommel.station.web.access import Viewer
from stommel.station.web.found import Line, TheStation
from stommel.station.web.routes.data import FlownDive

router = APIRouter(prefix="/api", tags=["plans"])

MOST_COMPARED = 2000
"""Dives of a comparison: the last ones."""
MOST_TRACK = 2000
"""Points of a track that are held against geofence and prediction."""
MOST_FIXES = 500
"""Of which is told how far they lie off the predicted track: the last ones."""

JobName = Annotated[str, Query(min_length=1, max_length=64, pattern=r"^[0-9a-f]+$")]


class DiveDifference(BaseModel):
    """Flown less predicted."""

    end_s: float | None
    duration_s: float | None
    distance_m: float | None
    depth_m: float | None
    energy_j: float | None


class Compared(BaseModel):
    """One dive of the mission, counted from its first."""

    dive: int
    predicted: PlannedDive | None
    flown: FlownDive | None
    difference: DiveDifference | None
    predicted_way_m: float | None
    flown_way_m: float | None
    """From where it began to where it ended, straight over ground."""
    off_track_m: float | None
    """From the place where the flown one ended to the nearest point of the predicted track."""


class Fix(BaseModel):
    """A place where GPS saw the vehicle [s since 1970, deg]."""

    t: float
    lat: float
    lon: float
    off_track_m: float
    """To the nearest point of the predicted track."""


class Total(BaseModel):
    """A quantity of all dives of which it is known both as predicted and as flown."""

    dives: int
    predicted: float
    flown: float
    difference: float
    """Flown less predicted."""


class SoFar(BaseModel):
    """Totals of the dives that were predicted and flown; null of what no dive tells."""

    first: int
    last: int
    """Numbers of these dives in the mission."""
    time_s: Total | None
    """From the begin of the first to the end of the last, with the time at the surface."""
    energy_j: Total | None
    distance_m: Total | None
    """Sum of the ways from begin to end of each dive, straight over ground."""


class Comparison(BaseModel):
    """Planned against flown."""

    mission: str | None
    t: float | None
    """Since when the vehicle holds it [s since 1970]; null where it was found aboard."""
    dives: list[Compared]
    reason: str | None
    """Why there is nothing to compare with."""
    prediction: Prediction | None
    """Null where no preview was kept beside the mission."""
    so_far: SoFar | None
    fixes: list[Fix]
    """The last ones, each with its distance from the predicted track."""
    left_geofence: TrackPoint | None = None
    """Where the vehicle was outside of the geofence of its plan for the first time."""


@router.get("/vehicles/{vehicle}/mission/comparison")
def compare_mission(_user: Viewer, line: Line, station: TheStation, job: JobName | None = None) -> Comparison:
    """Return the mission that the vehicle holds, predicted and flown side by side: track, dives, sums.

    Predicted is what the preview told that was sent with the plan, or the result of `job`.
    """
    held = held_mission(station.archive, line.vehicle)
    if held is None:
        reason = "it is not known which mission the vehicle holds"
        return Comparison(mission=None, t=None, dives=[], reason=reason, prediction=None, so_far=None, fixes=[])
    foretold = _kept(held.preview) if job is None else kept_preview(station.previews.flight(job).result).thinned()
    course = None if foretold is None or not foretold.track else PredictedTrack(_places(foretold.track))
    predicted = [] if foretold is None else [dive.model_dump() for dive in foretold.dives]
    flown = [with_true_ends(row)._asdict() for row in station.archive.dives(line.vehicle)]
    rows = compared(predicted, flown, held.begin, course)
    corners = geofence_of(held.plan)
    track = _track(station, line.vehicle, held.begin) if corners or course is not None else []
    answer = {
        "mission": held.name,
        "t": held.begin or None,
        "dives": rows[-MOST_COMPARED:],
        "reason": _reason(foretold, any(row.flown for row in rows)),
        "prediction": None if foretold is None else foretold.model_dump(exclude={"dives"}),
        "so_far": so_far(rows),
        "fixes": _fixes(track, course),
        "left_geofence": first_outside(corners, (point.model_dump() for point, _ in track)),
    }
    return Comparison.model_validate(answer, from_attributes=True)


def _kept(preview: Mapping[str, Any] | None) -> KeptPreview | None:
    """The preview that was kept beside a mission; None where there is none, or something else in its place."""
    try:
        return None if preview is None else kept_preview(preview)
    except FileError:
        return None


def _reason(foretold: KeptPreview | None, is_begun: bool) -> str | None:
    if foretold is None:
        return "no preview was made of the mission that the vehicle holds; preview its plan to compare"
    return None if is_begun else "the vehicle has reported no dive of this mission yet"


def _places(track: Sequence[TrackPoint]) -> list[Place]:
    return [Place(point.lat, point.lon) for point in track]


def _track(station: Station, vehicle: int, begin: float) -> list[tuple[TrackPoint, bool]]:
    """Where the vehicle was since a time, and whether GPS saw it there."""
    track = read_track(station.archive, vehicle, begin, GREATEST_TIME, MOST_TRACK)
    columns = zip(track.t, track.latitude, track.longitude, track.source, strict=True)
    return [(TrackPoint(t=t, lat=lat, lon=lon), source == BY_GPS) for t, lat, lon, source in columns]


def _fixes(track: Sequence[tuple[TrackPoint, bool]], course: PredictedTrack | None) -> list[Fix]:
    seen = [point for point, by_gps in track if by_gps][-MOST_FIXES:]
    if course is None:
        return []
    away = course.off(_places(seen))
    return [
        Fix(t=point.t, lat=point.lat, lon=point.lon, off_track_m=far)
        for point, far in zip(seen, away, strict=True)
        if far is not None
    ]
