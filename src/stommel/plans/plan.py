"""The plan that people edit, on the page or as a file: what a vehicle is told, from where, in what water.

It is JSON in the words of a mission's plan (`stommel.mission.plan.Plan`), with a few keys beside it:

    {"format": 1, "name": "To the shelf break", "vehicle": "zju",
     "start": {"latitude_deg": 28.70, "longitude_deg": 126.10}, "start_time": "2026-07-01T00:00:00Z",
     "duration_days": 3,
     "waypoints": [{"latitude_deg": 28.67, "longitude_deg": 126.13}, {"latitude_deg": 28.6, "longitude_deg": 126.2}],
     "guidance": {"acceptance_radius_m": 500, "repeat": false},
     "dives": {"depth_m": 70, "pitch_deg": 30, "speed_m_s": 0.5, "least_altitude_m": 10, "per_surfacing": 1},
     "surface": {"session_s": 180, "every_hours": null},
     "sampling": {"every_s": 10, "phases": ["descent", "inflection", "ascent"]},
     "abort": {"depth_m": null, "dive_hours": 12, "battery_share": 0.05, "leak": true},
     "geofence": [{"latitude_deg": 28.4, "longitude_deg": 125.9}, ...],
     "water": {"ocean": "east_china_sea", "current": "ocean"}}

Only name, vehicle, start and dives have to be there.
"""

from datetime import UTC, datetime
from typing import Annotated, Literal, Self

from pydantic import Field, field_serializer, model_validator

from stommel.files.fields import Table
from stommel.files.kinds import Moment
from stommel.files.ranges import between
from stommel.mission.plan import Plan, Position

MOST_WAYPOINTS = 200
MOST_CORNERS = 200
LONGEST_DAYS = 365.0

Current = Annotated[float, between(-5, 5)]


class Water(Table):
    """The water that the plan expects: its density sets the ballast, its current moves the predicted track."""

    ocean: Literal[
        "east_china_sea", "south_china_sea", "still", "uniform", "shear", "tide", "gyre", "two_layer", "pool"
    ] = "east_china_sea"
    """An analytic ocean; see `stommel ocean`."""
    current: Literal["ocean", "still", "given", "last_dive"] = "ocean"
    """That of the ocean; none; `north_m_s` and `east_m_s` everywhere; what the vehicle's last dive found."""
    north_m_s: Current = 0.0
    """Of a given current."""
    east_m_s: Current = 0.0
    """Of a given current."""

    @model_validator(mode="after")
    def _is_of_one_kind(self) -> Self:
        if self.current != "given" and (self.north_m_s or self.east_m_s):
            raise ValueError(
                f"water.current = {self.current!r}: must be 'given' where water.north_m_s or water.east_m_s is"
            )
        return self


class StationPlan(Plan):
    """A plan, as the station keeps it."""

    vehicle: Annotated[str, Field(min_length=1, max_length=200)]
    """Name of the vehicle's file."""
    start: Position
    """Where the vehicle is, or will be."""
    start_time: Moment | None = None
    """With its time zone; now if left out."""
    duration_days: Annotated[float, between(0.01, LONGEST_DAYS)] = 20.0
    """The mission expires so long after its start."""
    waypoints: Annotated[tuple[Position, ...], Field(max_length=MOST_WAYPOINTS)] = ()
    """In the order in which they are sought."""
    geofence: Annotated[tuple[Position, ...], Field(max_length=MOST_CORNERS)] = ()
    """Corners of the area that the plan may not leave; none where it is left out."""
    water: Water = Water()
    neutral_density_kg_m3: Annotated[float, between(950, 1100)] | None = None
    """Density of the water in which the vehicle, as it is trimmed, is neutral with no ballast volume; by the water of
    the plan, as before a deployment, if left out."""

    @field_serializer("start_time")
    def _written(self, moment: datetime | None) -> str | None:
        return None if moment is None else moment.astimezone(UTC).isoformat().replace("+00:00", "Z")

    @model_validator(mode="after")
    def _can_be(self) -> Self:
        if self.start_time is not None and self.start_time.tzinfo is None:
            raise ValueError(
                f"start_time = {self.start_time.isoformat()}: needs a time zone, such as {self.start_time.isoformat()}Z"
            )
        if 0 < len(self.geofence) < 3:
            raise ValueError(f"geofence = {len(self.geofence)} corners: must have at least 3, or none")
        return self
