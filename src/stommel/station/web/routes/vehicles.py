"""The vehicles of the station: how each is, its latest values, and its channels."""

from typing import Any, Literal

from fastapi import APIRouter
from pydantic import BaseModel

from stommel.station.alarms.limits import Limit
from stommel.station.alarms.severity import Severity
from stommel.station.channels import CHANNELS, channel_named, is_stale
from stommel.station.shape import shape_of
from stommel.station.states import state_machine
from stommel.station.vehicles.waiting import Waiting
from stommel.station.watching import file_of
from stommel.station.web.access import Viewer
from stommel.station.web.errors import refusal
from stommel.station.web.found import Line, TheStation

router = APIRouter(prefix="/api", tags=["vehicles"])


class VehicleAlarm(BaseModel):
    """An alarm that is raised; times are those of the vehicle's clock [s since 1970]."""

    id: int | None
    """Null while the archive has not taken it."""
    vehicle: int | None
    """Null: of the station itself, whose clock then tells the times; each vehicle's summary has it."""
    key: str
    words: str
    severity: Severity
    raised: float | None
    """Null where the vehicle told of it in a past of which the station kept no alarm."""
    acknowledged: float | None
    acknowledged_by: str | None


class VehiclePosition(BaseModel):
    """The last position that a vehicle told and at which it can have been."""

    latitude: float
    longitude: float
    t: float
    """When [s since 1970]."""
    sigma_m: float | None
    """Standard deviation along one direction."""
    source: Literal["gps", "estimate"]
    """From what it is known."""
    doubt: str | None
    """Why a later one is not believed."""


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
    """Of the last dive that has a position at both ends, over ground."""

    m_s: float
    course_deg: float
    dive: int
    t: float
    """When that dive ended [s since 1970]."""


class Current(BaseModel):
    """Depth-averaged current of a dive."""

    north_m_s: float
    east_m_s: float
    dive: int
    t: float
    """When that dive ended [s since 1970]."""


class VehicleSummary(BaseModel):
    """How a vehicle is; of what is null, `missing` has the reason.

    Times are of its clock, which goes `speed` times as fast as ours.

    - `next_surfacing`: start of this dive, or of the next one, and the mean duration of the last three dives.
    - `speed_made_good`: between the positions at the begin and the end of the last dive that has both, over ground.
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
    position: VehiclePosition | None
    battery: Battery | None
    battery_lasts: Expected | None
    """When it is used up, if it goes on as over the last dives."""
    next_surfacing: Expected | None
    speed_made_good: SpeedMadeGood | None
    current: Current | None
    waypoint_distance_m: float | None
    eta: Moment | None
    missing: dict[str, str]
    told: dict[str, float]
    """When the vehicle told those that do not say it themselves, by name [s since 1970]."""
    holder: str | None
    waiting: Waiting


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
    turn: float | None
    """After which values begin anew, as of a heading."""
    values: dict[int, str] | None
    """What the numbers mean, where they stand for words."""


class StateMachine(BaseModel):
    """States and phases; a transition is from, to, and when."""

    states: list[str]
    transitions: list[tuple[str, str, str]]
    phases: list[str]
    """Of the dive cycle, in the state `mission`."""
    phase_transitions: list[tuple[str, str, str]]


class WingShape(BaseModel):
    """A wing; its place is of the vehicle file, its outline a usual one."""

    x_m: float
    span_m: float
    chord_m: float
    sweep_deg: float


class RudderShape(BaseModel):
    """A rudder."""

    x_m: float
    z_m: float
    height_m: float
    chord_m: float
    travel_deg: float | None


class Shape(BaseModel):
    """How a vehicle looks; x is forward of the centre of buoyancy, z down."""

    name: str
    length_m: float
    diameter_m: float
    overall_length_m: float | None
    profile: list[tuple[float, float]]
    """Place along the body and radius there, from the tail to the nose [m]."""
    wings: WingShape | None
    rudder: RudderShape | None
    antenna_m: list[float] | None
    moving_mass_range_m: tuple[float, float] | None
    moving_mass_neutral_m: float
    bladder_range_ml: tuple[float, float] | None
    bladder_m: list[float] | None
    assumed: list[str]
    """What the vehicle file does not have."""


class VehicleDetail(VehicleSummary):
    """How a vehicle is, and what it has."""

    channels: list[ChannelInfo]
    limits: list[Limit]
    shape: Shape | None


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
    file = file_of(line.settings.model)
    limits = [limit.model_dump() for limit in station.alarms.limits_of(line.vehicle)]
    shape = None if file is None else shape_of(file)
    return VehicleDetail.model_validate(summary | {"channels": _channels(), "limits": limits, "shape": shape})


@router.get("/vehicles/{vehicle}/channels")
def list_channels(_user: Viewer, line: Line) -> list[ChannelInfo]:  # noqa: ARG001 - 404 for what is not there
    """Return what the values of a vehicle are called, and what they mean."""
    return _channels()


@router.get("/vehicles/{vehicle}/states")
def show_states(_user: Viewer, line: Line) -> StateMachine:  # noqa: ARG001 - as above
    """Return the state machine of a vehicle, for a diagram."""
    return StateMachine.model_validate(state_machine())


@router.get("/vehicles/{vehicle}/shape")
def show_shape(_user: Viewer, line: Line) -> Shape:
    """Return how a vehicle looks, from its vehicle file."""
    file = file_of(line.settings.model)
    if file is None:
        raise refusal(404, f"vehicle {line.vehicle} has no vehicle file: {line.settings.model} is none")
    return Shape.model_validate(shape_of(file))


@router.get("/vehicles/{vehicle}/latest")
def show_latest(_user: Viewer, line: Line, station: TheStation) -> Latest:
    """Return the latest value of each channel, and whether it is older than it should be."""
    now = line.clock.now()
    values = {}
    for key, (t, value) in station.hub.values(line.vehicle).items():
        channel = channel_named(key)
        if channel is None:
            continue
        age, period = max(0.0, now - t), line.ingest.periods.of(channel)
        values[key] = LatestValue(t=t, value=value, age_s=age, period_s=period, stale=is_stale(age, period))
    return Latest(now=now, values=values)


def _channels() -> list[ChannelInfo]:
    return [
        ChannelInfo(
            key=each.key, words=each.words, unit=each.unit, group=each.group, standard_name=each.standard_name,
            period_s=each.period_s, low=each.low, high=each.high, turn=each.turn, values=dict(each.values) or None,
        )
        for each in CHANNELS
    ]  # fmt: skip
