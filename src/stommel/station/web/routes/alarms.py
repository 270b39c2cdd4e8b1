"""Alarms, their limits, and alerts to people who are away."""

from typing import Annotated, Any

from fastapi import APIRouter, Path, Query
from pydantic import BaseModel, ConfigDict, Field

from stommel.station.alarms.history import AlarmError
from stommel.station.alarms.limits import Limit, LimitValues
from stommel.station.alarms.severity import Severity
from stommel.station.channels import channel_named
from stommel.station.web.access import Admin, Pilot, Viewer
from stommel.station.web.errors import refusal
from stommel.station.web.found import Line, TheStation

router = APIRouter(prefix="/api", tags=["alarms"])

GREATEST_NUMBER = (1 << 53) - 1
"""Of a row; beyond it JSON's numbers are not exact."""
AlarmNumber = Annotated[int, Path(ge=1, le=GREATEST_NUMBER)]
ChannelKey = Annotated[str, Path(min_length=1, max_length=80, description="Key of a channel, as `depth_m`.")]


class AlarmRow(BaseModel):
    """One raising of an alarm; times are those of the vehicle's clock [s since 1970]."""

    id: int | None
    """Null while the archive has not taken it."""
    vehicle: int | None
    """Null: of the station itself."""
    key: str
    words: str
    severity: Severity
    raised: float
    cleared: float | None
    acknowledged: float | None
    acknowledged_by: str | None
    value: float | None
    note: str | None


class KeptLimit(Limit):
    """A limit as the archive has it."""

    changed: float
    """When somebody set it, by the station's clock [s since 1970]."""
    changed_by: str
    """Who did."""


class Acknowledgement(BaseModel):
    """What is said to an alarm."""

    model_config = ConfigDict(extra="forbid")

    note: Annotated[str, Field(max_length=2000)] = ""


class AlertInfo(BaseModel):
    """How people who are away are told."""

    ways: list[str]
    least_severity: Severity
    quiet_s: float
    cleared: bool


class AlertTried(BaseModel):
    """What became of a test along one way."""

    way: str
    sent: bool
    reason: str


@router.get("/alarms")
def read_alarms(
    _user: Viewer,
    station: TheStation,
    vehicle: Annotated[int | None, Query(ge=1, le=250, description="Of this one, and of the station itself.")] = None,
    is_open: Annotated[bool | None, Query(alias="open", description="True: still raised; false: over.")] = None,
    acknowledged: Annotated[bool | None, Query(description="Whether somebody has acknowledged them.")] = None,
    before: Annotated[int | None, Query(ge=1, le=GREATEST_NUMBER, description="The last alarm of a page.")] = None,
    limit: Annotated[int, Query(ge=1, le=1000)] = 200,
) -> list[AlarmRow]:
    """Alarms of all vehicles or one, and of the station itself, the newest first."""
    found = station.alarms.history.listed(
        vehicle=vehicle, is_open=is_open, is_acknowledged=acknowledged, before=before, limit=limit
    )
    return [AlarmRow(**alarm.as_row()) for alarm in found]


@router.post("/alarms/{alarm}/acknowledge")
def acknowledge_alarm(user: Pilot, alarm: AlarmNumber, body: Acknowledgement, station: TheStation) -> AlarmRow:
    """Say that you have seen an alarm, and what you do about it; it stays open until its cause is gone."""
    try:
        seen = station.alarms.acknowledge(alarm, user.name, body.note.strip())
    except AlarmError as error:
        raise refusal(409 if error.is_known else 404, str(error), key="alarm", value=alarm) from None
    return AlarmRow(**seen.as_row())


@router.get("/vehicles/{vehicle}/limits")
def read_limits(_user: Viewer, line: Line, station: TheStation) -> list[KeptLimit]:
    """Limits of a vehicle's channels, and who set each."""
    return [
        KeptLimit(**kept.limit.model_dump(), changed=kept.changed, changed_by=kept.changed_by)
        for kept in station.alarms.set_limits(line.vehicle)
    ]


@router.put("/vehicles/{vehicle}/limits/{channel}")
def put_limit(user: Pilot, channel: ChannelKey, body: LimitValues, line: Line, station: TheStation) -> Limit:
    """Set the limit of a channel, in place of the one before."""
    if channel_named(channel) is None:
        raise refusal(404, "there is no such channel", key="channel", value=channel, allowed="a key of /channels")
    limit = Limit(channel=channel, **body.model_dump())
    station.alarms.put_limit(line.vehicle, limit, user.name)
    return limit


@router.delete("/vehicles/{vehicle}/limits/{channel}", status_code=204)
def delete_limit(user: Pilot, channel: ChannelKey, line: Line, station: TheStation) -> None:
    """Watch a channel no more; its alarm ends."""
    if not station.alarms.remove_limit(line.vehicle, channel, user.name):
        raise refusal(404, "this channel has no limit", key="channel", value=channel)


@router.get("/alerts")
def read_alerts(_user: Viewer, station: TheStation) -> AlertInfo:
    """How people who are away are told of alarms; it is set in station.toml."""
    settings = station.settings.alerts
    told: dict[str, Any] = settings.model_dump(include={"least_severity", "quiet_s", "cleared"})
    return AlertInfo(ways=station.alarms.alerts.ways, **told)


@router.post("/alerts/test")
def send_test_alert(user: Admin, station: TheStation) -> list[AlertTried]:
    """Send a word along every way now, and tell what became of it."""
    return [AlertTried(**tried._asdict()) for tried in station.alarms.alerts.test(user.name)]
