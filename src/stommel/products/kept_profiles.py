"""Profiles that were found, kept in the archive, so that a restart seeks none of them again."""

from contextlib import suppress
from typing import NamedTuple

from sqlalchemy import select, update

from stommel.archive.archive import Archive
from stommel.archive.errors import ArchiveError
from stommel.archive.log_tables import profiles
from stommel.archive.schema import vehicles
from stommel.archive.times import seconds
from stommel.archive.upserting import insert_rows
from stommel.data.summaries import ProfileSummary


class Found(NamedTuple):
    """A profile: times [us] of its first and its last sample, and of the turning point before; how it is shown."""

    first_us: int
    last_us: int
    turned_us: int
    is_settled: bool
    """Whether no later sample can change it."""
    line: ProfileSummary
    """Its number is that of its place."""


def kept(archive: Archive, vehicle: int) -> tuple[list[Found], int]:
    """Profiles of a vehicle, and up to which change of its samples they are known."""
    query = select(profiles).where(profiles.c.vehicle_id == vehicle).order_by(profiles.c.first_us)
    with archive.reading() as connection:
        change = connection.execute(select(vehicles.c.profiles_change).where(vehicles.c.id == vehicle)).scalar() or 0
        rows = connection.execute(query).all() if change else []
    found = []
    for number, row in enumerate(rows, 1):
        line = ProfileSummary(
            number, row.direction, seconds(row.first_us), seconds(row.last_us), row.samples, row.dive, row.latitude,
            row.longitude, row.least_depth_m, row.greatest_depth_m,
        )  # fmt: skip
        found.append(Found(row.first_us, row.last_us, row.turned_us, row.settled, line))
    return found, change


def keep(archive: Archive, vehicle: int, new: list[Found], since_us: int, before: int, change: int) -> bool:
    """Keep what was found from a time [us] on; False, and nothing, if somebody else has, or the archive is busy.

    Parameters
    ----------
    archive, vehicle
        Where, and whose.
    new
        All profiles that begin at `since_us` or later.
    since_us
        What was kept of before stays.
    before, change
        Up to which change of the samples they were known, and are now.
    """
    if archive.is_written:
        return False
    with suppress(ArchiveError), archive.writing() as connection:
        v = vehicles.c
        mine = update(vehicles).where(v.id == vehicle, v.profiles_change == before).values(profiles_change=change)
        if not connection.execute(mine).rowcount:
            return False
        old = (profiles.c.vehicle_id == vehicle) & (profiles.c.first_us >= since_us)
        connection.execute(profiles.delete().where(old))
        insert_rows(connection, profiles, tuple(profiles.c.keys()), [_row(vehicle, found) for found in new])
        return True
    return False


def _row(vehicle: int, found: Found) -> tuple[object, ...]:
    line = found.line
    return (
        vehicle, found.first_us, found.last_us, found.turned_us, found.is_settled, line.direction, line.samples,
        line.dive, line.latitude, line.longitude, line.least_depth_m, line.greatest_depth_m,
    )  # fmt: skip
