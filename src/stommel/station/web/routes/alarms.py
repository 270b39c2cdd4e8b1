"""Alarms, their limits, and alerts to people who are away."""

from typing import Annotated, Literal

from fastapi import APIRouter, Path, Query
from pydantic import BaseModel, ConfigDict, Field

from stommel.station.alarms.alarm import Alarm
from stommel.station.alarms.history import AlarmError
from stommel.station.alarms.limits import Limit, LimitValues
from stommel.station.alarms.severity import Severity
from stommel.station.channels import channel_named
from stommel.station.web.access import Admin, Pilot, Viewer
from stommel.station.web.errors import refusal
from stommel.station.web.found import Line, TheStation
from stommel.station.web.words import Words

router = APIRouter(prefix="/api", tags=["alarms"])

RowNumber = Annotated[int, Path(ge=1, le=(1 << 53) - 1)]
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


class AlarmList(BaseModel):
    """Alarms, the newest first."""

    alarms: list[AlarmRow]
    next: str | None
    """Gives the older ones as `before`; null if there are none."""


class Acknowledgement(BaseModel):
    """What was said to an alarm."""

    model_config = ConfigDict(extra="forbid")

    note: Annotated[Words, Field(max_length=2000)] = ""


class AlertWay(BaseModel):
    """A way to people who are away."""

    way: str
    sent: bool
    reason: str


class AlertInfo(BaseModel):
    """How people who are away are told."""

    ways: list[str]
    least_severity: Severity
    quiet_s: float


@router.get("/alarms")
def read_alarms(
    station: TheStation,
    _user: Viewer,
    vehicle: Annotated[int | None, Query(ge=1, le=250)] = None,
    state: Annotated[Literal["open", "over"] | None, Query(description="Whether they are still raised.")] = None,
    open: Annotated[bool | None, Query(description="True: still raised; false: over.")] = None,  # noqa: A002
    acknowledged: bool | None = None,
    before: Annotated[str | None, Query(max_length=40, pattern=r"^\d{1,17}-\d{1,16}$")] = None,
    limit: Annotated[int, Query(ge=1, le=1000)] = 200,
) -> AlarmList:
    """Alarms of all vehicles and of the station itself, the newest first."""
    raise NotImplementedError
