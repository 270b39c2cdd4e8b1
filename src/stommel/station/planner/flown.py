"""What the archive knows of the mission that a vehicle flies."""

from collections.abc import Mapping
from typing import Any, NamedTuple

from sqlalchemy import select

from stommel.control.orders_file import parse_orders
from stommel.errors import StommelError
from stommel.station.archive import Archive
from stommel.station.archive.schema import missions
from stommel.station.archive.times import seconds
from stommel.station.planner.resolving import Current


class KeptMission(NamedTuple):
    """A mission that was sent to a vehicle."""

    mission: int
    """Number in the archive."""
    t: float
    """When it was sent [s since 1970]."""
    name: str
    sha256: str
    orders: str
    plan: Mapping[str, Any] | None
    preview: Mapping[str, Any] | None


def latest_mission(archive: Archive, vehicle: int, sha256: str | None = None) -> KeptMission | None:
    """The mission that was sent last, or the last one with this hash; None if there is none."""
    query = select(missions).where(missions.c.vehicle_id == vehicle)
    if sha256 is not None:
        query = query.where(missions.c.sha256 == sha256)
    with archive.reading() as connection:
        row = connection.execute(query.order_by(missions.c.id.desc()).limit(1)).first()
    if row is None:
        return None
    return KeptMission(row.id, seconds(row.t_us), row.name, row.sha256, row.orders, row.plan, row.preview)


def current_of_last_dive(archive: Archive, vehicle: int) -> Current | None:
    """Depth-averaged current of the last dive that found one [m/s]."""
    for dive in reversed(archive.dives(vehicle)):
        if dive.current_east_m_s is not None and dive.current_north_m_s is not None:
            return dive.current_east_m_s, dive.current_north_m_s
    return None


def neutral_density(archive: Archive, vehicle: int) -> float | None:
    """Density in which the vehicle is neutral as it was trimmed, by the orders that were sent last [kg/m3]."""
    mission = latest_mission(archive, vehicle)
    if mission is None:
        return None
    try:
        return parse_orders(mission.orders, mission.name)[1].density_kg_m3
    except StommelError:
        return None
