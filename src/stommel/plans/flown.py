"""What the archive knows of the mission that a vehicle holds."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from sqlalchemy import func, select

from stommel.archive import Archive
from stommel.archive.schema import mission_history, missions
from stommel.archive.times import seconds
from stommel.control.orders_file import parse_orders
from stommel.errors import StommelError
from stommel.mission.plan import Position
from stommel.plans.problems import PlanError, plan_from
from stommel.plans.resolving import Current

ABOARD = "aboard"
"""State of the mission that the vehicle holds."""


class HeldMission(NamedTuple):
    """The mission that a vehicle holds, as the archive knows it."""

    begin: float
    """Since when the vehicle has it [s since 1970]; 0 of one that was found aboard: all its dives may be of it."""
    name: str
    sha256: str
    orders: str
    plan: Mapping[str, Any] | None
    """That the orders were made of; none where somebody gave orders."""
    preview: Mapping[str, Any] | None
    """What was predicted before it was sent."""


def held_mission(archive: Archive, vehicle: int) -> HeldMission | None:
    """The mission that a vehicle holds; None where that is not known."""
    chosen = select(missions).where(missions.c.vehicle_id == vehicle, missions.c.state == ABOARD)
    with archive.reading() as connection:
        row = connection.execute(chosen.order_by(missions.c.id.desc()).limit(1)).first()
        if row is None:
            return None
        of = mission_history.c
        since = select(func.max(of.t_us)).where(of.mission_id == row.id, of.state == ABOARD)
        taken = connection.execute(since).scalar_one_or_none()
    begin = 0.0 if row.user is None else seconds(row.t_us if taken is None else taken)
    return HeldMission(begin, row.name, row.sha256, row.orders, row.plan, row.preview)


def geofence_of(plan: Mapping[str, Any] | None) -> Sequence[Position]:
    """Corners of the area that a mission may not leave; none of orders, or of a plan that an older station kept."""
    try:
        return () if plan is None else plan_from(plan).geofence
    except PlanError:
        return ()


def current_of_last_dive(archive: Archive, vehicle: int) -> Current | None:
    """Depth-averaged current of the last dive that found one [m/s]."""
    for dive in reversed(archive.dives(vehicle)):
        if dive.current_east_m_s is not None and dive.current_north_m_s is not None:
            return dive.current_east_m_s, dive.current_north_m_s
    return None


def neutral_density(archive: Archive, vehicle: int) -> float | None:
    """Density in which the vehicle is neutral as it was trimmed, by the orders that it holds [kg/m3]."""
    mission = held_mission(archive, vehicle)
    if mission is None:
        return None
    try:
        return parse_orders(mission.orders, mission.name)[1].density_kg_m3
    except StommelError:
        return None
