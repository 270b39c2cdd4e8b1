"""Missions of a vehicle: what it holds, what it was given by whom, and giving it another."""

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from fastapi import APIRouter, Path, Query
from pydantic import BaseModel, ConfigDict, Field, model_validator

from stommel.archive.times import GREATEST_TIME
from stommel.plans.flown import current_of_last_dive
from stommel.plans.kept_preview import KeptPreview, kept_preview
from stommel.plans.plan import StationPlan
from stommel.plans.preview.previews import Flight
from stommel.plans.problems import plan_from
from stommel.plans.resolving import resolved
from stommel.station.station import Station
from stommel.station.vehicles.line import VehicleLine
from stommel.station.web.access import Holder, Viewer
from stommel.station.web.errors import refusal
from stommel.station.web.found import Line, TheStation
from stommel.vehicle import builtin_names

router = APIRouter(prefix="/api", tags=["missions"])

MOST_ORDERS = 1_000_000
LEAST_VALID, MOST_VALID, USUAL = 60.0, 604_800.0, 86_400.0
Validity = Annotated[float, Field(ge=LEAST_VALID, le=MOST_VALID, allow_inf_nan=False)]

Past = Annotated[
    float | None, Query(ge=0.0, le=GREATEST_TIME, allow_inf_nan=False, description="Seconds since 1970.")
]  # fmt: skip


MissionState = Literal[
    "waiting", "sending", "aboard", "replaced", "refused", "failed", "interrupted", "cancelled", "superseded", "expired"
]  # fmt: skip


class Mission(BaseModel):
    """A mission; times are of the vehicle's clock [s since 1970]."""

    id: int
    vehicle: int
    t: float
    user: str | None
    """Who gave it; null: it was found aboard."""
    name: str
    sha256: str
    state: MissionState
    words: str
    """Why, or what was last told of it."""
    expires: float | None
    """Until when it is tried; null where that is over."""


class MissionStep(BaseModel):
    """What a mission was from a time on."""

    t: float
    user: str | None
    state: str
    words: str


class MissionDetail(Mission):
    """A mission with its orders and what became of it."""

    orders: str
    plan: dict[str, Any] | None
    history: list[MissionStep]


class Waypoint(BaseModel):
    """A waypoint [deg], and within which distance it is reached."""

    latitude: float
    longitude: float
    radius_m: float


class Corner(BaseModel):
    """A corner of a geofence [deg]."""

    latitude: float
    longitude: float


class UploadProgress(BaseModel):
    """Bytes."""

    done: int
    of: int
    seconds_left: float | None


class MissionOnItsWay(Mission):
    """A mission that waits, or is being sent."""

    progress: UploadProgress | None
    """Null while it waits."""


class RollBackOnItsWay(BaseModel):
    """The vehicle shall fly the mission before its present one again, and has not said yet that it does."""

    user: str
    expires: float
    """Until when it is tried [s since 1970]."""


class MissionAboard(BaseModel):
    """Which mission a vehicle holds, and what is on its way; null where that is not known."""

    number: int | None
    name: str | None
    sha256: str | None
    """Empty for none."""
    previous_sha256: str | None
    """Of the mission before, to which it can be rolled back; empty for none."""
    t: float | None
    """When the vehicle said so [s since 1970]."""
    missing: str | None
    """Why something is not known, or what the last request came to."""
    waypoints: list[Waypoint]
    geofence: list[Corner]
    """Of the plan out of which the orders were made; empty where there is none."""
    depth_m: float | None
    mission: Mission | None
    """Of these orders, where the station has them."""
    upload: MissionOnItsWay | None
    roll_back: RollBackOnItsWay | None
    waiting: int
    """Requests about missions that are not over."""


class NewMission(BaseModel):
    """Orders as a text, or a plan out of which they are made."""

    model_config = ConfigDict(extra="forbid")

    orders: Annotated[str, Field(min_length=1, max_length=MOST_ORDERS)] | None = None
    plan: dict[str, Any] | None = None
    job: Annotated[str, Field(min_length=1, max_length=64, pattern=r"^[0-9a-f]+$")] | None = None
    """Preview of the plan, of which track, dives and totals are kept to compare."""
    preview: KeptPreview | None = None
    """What a preview told, in place of a `job` that the station has forgotten."""
    valid_for_s: Validity = USUAL

    @model_validator(mode="after")
    def _one_of_them(self) -> "NewMission":
        if (self.orders is None) == (self.plan is None):
            raise ValueError("give orders, or a plan, and not both")
        if self.job is not None and self.preview is not None:
            raise ValueError("give the job of a preview, or what it told, and not both")
        return self


class RollBack(BaseModel):
    """How long it is tried."""

    model_config = ConfigDict(extra="forbid")

    valid_for_s: Validity = USUAL


@router.get("/vehicles/{vehicle}/missions")
def list_missions(
    _user: Viewer, line: Line, station: TheStation, limit: Annotated[int, Query(ge=1, le=500)] = 100
) -> list[Mission]:
    """Return the last missions of a vehicle, the newest first."""
    return [Mission.model_validate(station.missions.told(row)) for row in station.missions.list(line.vehicle, limit)]


@router.get("/vehicles/{vehicle}/missions/{id}")
def show_mission(
    _user: Viewer, line: Line, station: TheStation, id: Annotated[int, Path(ge=1, le=1 << 62)]
) -> MissionDetail:
    """Return a mission with its orders, and what became of it."""
    row, history = station.missions.find(line.vehicle, id)
    whole = station.missions.told(row) | {"orders": row.orders, "plan": row.plan}
    return MissionDetail.model_validate(whole | {"history": [each._asdict() for each in history]})


@router.get("/vehicles/{vehicle}/mission")
def show_mission_aboard(_user: Viewer, line: Line, station: TheStation, at: Past = None) -> MissionAboard:
    """Return which mission the vehicle holds, and what is on its way to it; or which one it held at a time."""
    if at is not None:
        return MissionAboard.model_validate(station.missions.held_at(line.vehicle, at))
    return MissionAboard.model_validate(station.missions.aboard(line.vehicle))


@router.post("/vehicles/{vehicle}/mission", status_code=202)
def upload_mission(user: Holder, line: Line, station: TheStation, new: NewMission) -> Mission:
    """Give the vehicle a mission: kept here first, then sent; it takes it whole, or keeps the one that it has.

    It comes in place of one that waits or is on its way, which is then not sent. Where the station has forgotten the
    job of a preview, nothing is given: hand its result over as `preview`, or preview again.
    """
    plan, orders = new.plan, new.orders or ""
    if plan is not None:
        made = _resolved(station, line, plan)
        plan = made.model_dump(mode="json", exclude_none=True, exclude_unset=True)
        orders = station.previews.orders(made)
    preview = new.preview if new.job is None else _foretold(station.previews.flight(new.job), plan, new.plan)
    kept = None if preview is None else preview.thinned().model_dump(mode="json")
    row = station.missions.upload(line.vehicle, user.name, orders, plan=plan, preview=kept, valid_for_s=new.valid_for_s)
    return Mission.model_validate(station.missions.told(row))


@router.post("/vehicles/{vehicle}/mission/roll-back", status_code=202)
def roll_back_mission(user: Holder, line: Line, station: TheStation, asked: RollBack | None = None) -> MissionAboard:
    """Let the vehicle fly the mission before its present one again."""
    station.missions.roll_back(line.vehicle, user.name, USUAL if asked is None else asked.valid_for_s)
    return MissionAboard.model_validate(station.missions.aboard(line.vehicle))


@router.delete("/vehicles/{vehicle}/missions/{id}")
def take_back_mission(
    user: Holder, line: Line, station: TheStation, id: Annotated[int, Path(ge=1, le=1 << 62)]
) -> Mission:
    """Take back a mission that the vehicle has not switched to; if it may have, the words say so, and it is asked."""
    return Mission.model_validate(station.missions.told(station.missions.take_back(line.vehicle, id, user.name)))


@router.delete("/vehicles/{vehicle}/mission/roll-back")
def take_back_roll_back(user: Holder, line: Line, station: TheStation) -> MissionAboard:
    """Take back that the vehicle shall fly the mission before its present one again."""
    station.missions.take_back_roll_back(line.vehicle, user.name)
    return MissionAboard.model_validate(station.missions.aboard(line.vehicle))


def _resolved(station: Station, line: VehicleLine, plan: dict[str, Any]) -> StationPlan:
    """The plan, with what the station knows of the vehicle filled in."""
    model = line.settings.model
    return resolved(
        plan_from(plan), now=line.clock.now(), vehicles=sorted({*builtin_names(), model}), model=model,
        current=current_of_last_dive(station.archive, line.vehicle),
    )  # fmt: skip


def _foretold(flight: Flight, plan: Mapping[str, Any] | None, given: Mapping[str, Any] | None) -> KeptPreview:
    """What is kept of the flight of a plan, which must be this one but for what the station fills in anew each time."""
    left = {} if given is None else given
    if plan is not None and _as_given(plan, left) != _as_given(flight.plan, left):
        raise refusal(422, "job: is the preview of another plan; preview this one", key="job")
    return kept_preview(flight.result)


def _as_given(plan: Mapping[str, Any], given: Mapping[str, Any]) -> dict[str, Any]:
    """A plan without what was left to the station: when it begins, and the current of the last dive."""
    told, water = dict(plan), dict(plan.get("water", {}))
    if given.get("start_time") is None:
        told.pop("start_time", None)
    if given.get("water", {}).get("current") == "last_dive":
        water = {"ocean": water.get("ocean")}
    return told | {"water": water}
