"""The vehicles of the station: how each is, its latest values, and its channels."""

from typing import Any

from fastapi import APIRouter
from pydantic import BaseModel

from stommel.station.channels import CHANNELS, channel_named, is_stale
from stommel.station.web.access import Viewer
from stommel.station.web.found import Line, TheStation

router = APIRouter(prefix="/api", tags=["vehicles"])


class VehicleAlarm(BaseModel):
    """An alarm that is raised."""

    key: str
    words: str
    severity: str


class Position(BaseModel):
    """Where a vehicle is."""

    latitude: float
    longitude: float
    t: float
    """When [s since 1970]."""
    sigma_m: float | None
    """Standard deviation."""


class Battery(BaseModel):
    """What is left of the battery."""

    share: float | None
    voltage_v: float | None
    t: float


class Expected(BaseModel):
    """When something is expected, and why."""

    t: float
    why: str


class Moment(BaseModel):
    """A time [s since 1970]."""

    t: float


class SpeedMadeGood(BaseModel):
    """Of the last dive, over ground."""

    m_s: float
    course_deg: float


class Current(BaseModel):
    """Depth-averaged current of a dive."""

    north_m_s: float
    east_m_s: float
    dive: int


class VehicleSummary(BaseModel):
    """How a vehicle is; of what is null, `missing` has the reason.

    Times are of its clock, which goes `speed` times as fast as ours.

    - `next_surfacing`: start of this dive, or of the next one, and the mean duration of the last three dives.
    - `speed_made_good`: between the positions at the begin and the end of the last dive, over ground.
    - `current`: depth-averaged, of the last dive that has one, from its drift.
    - `eta`: distance to the waypoint by the rate at which it has become less since the last dive began.
    """

    vehicle: int
    name: str
    model: str
    simulated: bool
    speed: float
    now: float
    heard: bool
    last_contact: float | None
    link_reason: str
    state: str | None
    phase: str | None
    dive: int | None
    waypoint: int | None
    mission: int | None
    alarms: list[VehicleAlarm]
    position: Position | None
    battery: Battery | None
    next_surfacing: Expected | None
    speed_made_good: SpeedMadeGood | None
    current: Current | None
    waypoint_distance_m: float | None
    eta: Moment | None
    missing: dict[str, str]
    holder: str | None


class ChannelInfo(BaseModel):
    """A value over time."""

    key: str
    words: str
    unit: str
    group: str
    standard_name: str
    period_s: float
    low: float
    high: float
    values: dict[int, str] | None = None


class VehicleDetail(VehicleSummary):
    """How a vehicle is, and what it has."""

    channels: list[ChannelInfo]


class LatestValue(BaseModel):
    """The latest value of a channel."""

    t: float
    value: float
    age_s: float
    period_s: float
    stale: bool
    """Whether it is older than it should be."""


class Latest(BaseModel):
    """The latest of everything."""

    now: float
    values: dict[str, LatestValue]


@router.get("/vehicles")
def list_vehicles(_user: Viewer, station: TheStation) -> list[VehicleSummary]:
    """Return how all vehicles are."""
    return [VehicleSummary.model_validate(station.summary(number)) for number in station.vehicles]


@router.get("/vehicles/{vehicle}")
def show_vehicle(_user: Viewer, line: Line, station: TheStation) -> VehicleDetail:
    """Return how a vehicle is, with its channels."""
    summary: dict[str, Any] = station.summary(line.vehicle)
    return VehicleDetail.model_validate(summary | {"channels": _channels()})


@router.get("/vehicles/{vehicle}/channels")
def list_channels(_user: Viewer, line: Line) -> list[ChannelInfo]:  # noqa: ARG001 - 404 for what is not there
    """Return what the values of a vehicle are called, and what they mean."""
    return _channels()


@router.get("/vehicles/{vehicle}/latest")
def show_latest(_user: Viewer, line: Line, station: TheStation) -> Latest:
    """Return the latest value of each channel, and whether it is older than it should be."""
    now = line.clock.now()
    values = {}
    for key, (t, value) in station.hub.values(line.vehicle).items():
        channel = channel_named(key)
        age, period = max(0.0, now - t), 0.0 if channel is None else channel.period_s
        values[key] = LatestValue(t=t, value=value, age_s=age, period_s=period, stale=is_stale(channel, age))
    return Latest(now=now, values=values)


def _channels() -> list[ChannelInfo]:
    return [
        ChannelInfo(
            key=each.key, words=each.words, unit=each.unit, group=each.group, standard_name=each.standard_name,
            period_s=each.period_s, low=each.low, high=each.high, values=dict(each.values) or None,
        )
        for each in CHANNELS
    ]  # fmt: skip
