"""What is asked and answered about plans, as JSON."""

from typing import Annotated, Any, Literal

from pydantic import BaseModel, Field

from stommel.plans.fields import PlanField
from stommel.plans.kept_preview import PlannedDive, TrackPoint
from stommel.plans.plan import StationPlan

Number = Annotated[int, Field(ge=1, le=250)]
MOST_ORDERS = 500_000
"""Characters of an orders file."""


class PlanBody(BaseModel):
    """A plan, and the vehicle that it is for."""

    vehicle: Number | None = None
    """Number of the vehicle on the radio; none: of no vehicle yet."""
    plan: dict[str, Any]
    """As `PlanTemplate.plan` has it; what is wrong with it is told key by key."""


class OrdersBody(BaseModel):
    """Text of an orders file."""

    orders: Annotated[str, Field(max_length=MOST_ORDERS)]


class Problem(BaseModel):
    """One thing wrong with a plan."""

    key: str
    value: str
    reason: str
    allowed: str


class Checked(BaseModel):
    """Everything that is wrong with a plan, or its orders."""

    problems: list[Problem]
    warnings: list[str]
    """What a pilot should know, though it can be flown."""
    orders: str | None
    """None where something is wrong."""


class StartedJob(BaseModel):
    """A job that waits or runs."""

    job: str


class JobError(BaseModel):
    """Why a job failed."""

    reason: str
    problems: list[Problem]


class PlannedWaypoint(BaseModel):
    """What becomes of a waypoint."""

    number: int
    reached: bool
    reached_utc: str | None
    closest_m: float | None


class PlannedPath(BaseModel):
    """Depth over the way of the first dives."""

    distance_m: list[float]
    depth_m: list[float]


class Preview(BaseModel):
    """A plan as the simulator flew it."""

    verdict: str
    outcome: str
    t_begin: float
    duration_s: float
    energy_j: float | None
    battery_left_share: float | None
    distance_m: float
    surfacings: int
    dive_count: int
    dives: list[PlannedDive]
    waypoints: list[PlannedWaypoint]
    track: list[TrackPoint]
    series: dict[str, list[float]]
    """`t`, `depth_m`, `pitch_deg`, `ballast_ml`, `bottom_depth_m`, `energy_j`: columns of one length."""
    path: PlannedPath
    left_geofence: TrackPoint | None = None
    """Where the track is outside of the geofence for the first time."""
    warnings: list[str]


class Job(BaseModel):
    """A job, and its result once it is done."""

    job: str
    state: Literal["waiting", "starting", "running", "done", "failed", "cancelled"]
    share: float
    seconds_left: float | None
    result: Preview | None
    error: JobError | None


class OpenedPlan(BaseModel):
    """Orders as the plan that makes them again."""

    plan: StationPlan
    remarks: list[str]
    """What of the orders a plan cannot hold."""


class FlownPlan(OpenedPlan):
    """The plan of the mission that the vehicle holds."""

    mission: str
    sha256: str
    t: float | None
    """Since when it holds it [s since 1970]; null where it was found aboard."""


class PlanTemplate(BaseModel):
    """A plan to begin with."""

    name: str
    words: str
    plan: StationPlan


class PlanTemplates(BaseModel):
    """Plans to begin with, and what a form needs of each value."""

    templates: list[PlanTemplate]
    fields: list[PlanField]
    vehicles: list[str]
    """Vehicle files that a plan may name."""
