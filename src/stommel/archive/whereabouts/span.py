"""Over which stretch of time a track is shown: the last day, the mission, all."""

from typing import Literal

from sqlalchemy import select

from stommel.archive.archive import Archive
from stommel.archive.schema import mission_history, missions
from stommel.archive.times import microseconds, seconds
from stommel.archive.whereabouts.told import end_of_told

DAY = 86_400.0
ABOARD = "aboard"

TrackSpan = Literal["day", "mission", "all"]


def span_of(archive: Archive, vehicle: int, span: TrackSpan, until: float) -> tuple[float, float]:
    """Begin and end of a track, none of which lies after a time [s since 1970].

    A vehicle that is silent keeps its track: `day` is the last day of which positions are known. `mission` begins
    where the vehicle switched to the mission that it held then, and is no shorter than `day`; of a mission that was
    found aboard, or where it is not known which one, it is all.

    Raises
    ------
    ArchiveError
        The archive fails.
    """
    told = end_of_told(archive, vehicle, until)
    if told is None:
        return until, until
    first, last = told
    begin = {"day": last - DAY, "all": first}.get(span)
    if begin is None:
        switched = _switched(archive, vehicle, until)
        begin = first if switched is None else min(switched, last - DAY)
    return max(first, begin), last


def _switched(archive: Archive, vehicle: int, until: float) -> float | None:
    """When a vehicle switched to the mission that it held at a time; None where that is not known."""
    of = mission_history.c
    query = (
        select(of.t_us, missions.c.user)
        .join(missions, missions.c.id == of.mission_id)
        .where(missions.c.vehicle_id == vehicle, of.state == ABOARD, of.t_us <= microseconds(until))
        .order_by(of.t_us.desc(), of.id.desc())
        .limit(1)
    )
    with archive.reading() as connection:
        row = connection.execute(query).first()
    return None if row is None or row.user is None else seconds(row.t_us)
