"""Parameters of a vehicle: what each is, what it was, and setting it."""

from typing import Annotated, Literal

from fastapi import APIRouter, Path, Query
from pydantic import BaseModel, ConfigDict, Field

from stommel.station.web.access import Holder, Pilot, Viewer
from stommel.station.web.found import Line, TheStation

router = APIRouter(prefix="/api", tags=["parameters"])

Component = Annotated[int, Path(ge=0, le=255, description="Component of the vehicle.")]
ParameterName = Annotated[str, Path(pattern="^[A-Z0-9_]{1,16}$", description="Name of the parameter.")]


class Parameter(BaseModel):
    """A parameter as it is known."""

    name: str
    kind: str
    value: float | None
    """null: the vehicle has not told it."""
    default: float
    low: float
    high: float
    unit: str
    words: str
    since: float | None
    """When this value was first seen, by the vehicle's clock [s since 1970]."""
    user: str | None
    """Who has set it; null where the vehicle had it so."""


class ComponentParameters(BaseModel):
    """Parameters of one component."""

    component: int
    name: str
    state: Literal["known", "silent", "being_read"]
    whole: bool
    """Whether the last refreshing brought all of them up to date."""
    reason: str
    parameters: list[Parameter]


class MissingComponent(BaseModel):
    """A component that has told nothing."""

    component: int
    name: str
    reason: str


class Refreshing(BaseModel):
    """How far a refreshing is."""

    done: int
    of: int
    seconds_left: float | None


class ParameterWrite(BaseModel):
    """A value that somebody sets; it waits for the vehicle, and after a restart the vehicle is asked what it holds."""

    ticket: int
    component: int
    name: str
    value: float
    user: str
    t: float
    state: Literal["waiting", "done", "refused", "failed"]
    words: str
    holds: float | None
    """Value that holds aboard, as far as the vehicle said."""


class ParameterAnswer(BaseModel):
    """All parameters of a vehicle."""

    refreshing: Refreshing | None
    components: list[ComponentParameters]
    missing: list[MissingComponent]
    notes: list[str]
    writes: list[ParameterWrite]
    """The newest first."""


class NewValue(BaseModel):
    """A value to set."""

    model_config = ConfigDict(extra="forbid")

    value: Annotated[float, Field(ge=-1e12, le=1e12, allow_inf_nan=False)]


class PastValue(BaseModel):
    """A value that a parameter had from a time on, by the vehicle's clock [s since 1970]."""

    component: int
    name: str
    value: float
    kind: str
    t: float
    user: str | None
    source: str


class Done(BaseModel):
    """It has begun."""

    done: bool = True


@router.get("/vehicles/{vehicle}/parameters")
def list_parameters(_user: Viewer, line: Line, station: TheStation) -> ParameterAnswer:
    """Return all parameters of a vehicle as they are known."""
    return ParameterAnswer.model_validate(station.parameters.known(line.vehicle))


@router.post("/vehicles/{vehicle}/parameters/refresh", status_code=202)
def refresh_parameters(_user: Pilot, line: Line, station: TheStation) -> Done:
    """Ask the vehicle for its parameters; what has not changed costs one message."""
    station.parameters.refresh(line.vehicle)
    return Done()


@router.put("/vehicles/{vehicle}/parameters/{component}/{name}", status_code=202)
def set_parameter(
    user: Holder, line: Line, station: TheStation, component: Component, name: ParameterName, new: NewValue
) -> ParameterWrite:
    """Begin to set a parameter; it is held against its range, and what becomes of it is told as it happens."""
    write = station.parameters.write(line.vehicle, user.name, component, name, new.value)
    return ParameterWrite.model_validate(write.told())


@router.get("/vehicles/{vehicle}/parameters/{component}/{name}/history")
def show_parameter_history(
    _user: Viewer,
    line: Line,
    station: TheStation,
    component: Component,
    name: ParameterName,
    limit: Annotated[int, Query(ge=1, le=1000)] = 100,
) -> list[PastValue]:
    """Return what a parameter was, the newest first."""
    rows = station.parameters.history(line.vehicle, component, name, limit)
    return [PastValue.model_validate(row._asdict()) for row in rows]
