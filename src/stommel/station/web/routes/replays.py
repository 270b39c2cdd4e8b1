"""Replays: what a vehicle told in the past, told again over the live socket as vehicle `replay:ID`."""

from typing import Annotated

from fastapi import APIRouter, Depends, Path
from pydantic import BaseModel, ConfigDict, Field

from stommel.archive.times import GREATEST_TIME
from stommel.station.people.roles import Role, User
from stommel.station.replay.course import LEAST_SPEED, MOST_SPEED
from stommel.station.replay.replay import Replay
from stommel.station.replay.replays import NothingReceivedError, ReplayError
from stommel.station.web.access import Viewer
from stommel.station.web.errors import refusal
from stommel.station.web.found import TheStation, line_to
from stommel.station.web.routes.vehicles import VehicleSummary

router = APIRouter(prefix="/api", tags=["replays"])

SHORTEST = 1.0
"""Of a stretch of time [s]."""
Time = Annotated[float, Field(ge=0, le=GREATEST_TIME, allow_inf_nan=False)]
Speed = Annotated[float, Field(ge=LEAST_SPEED, le=MOST_SPEED, allow_inf_nan=False)]


class NewReplay(BaseModel):
    """What shall be told again, from `begin` to `end` by the vehicle's clock [s since 1970]."""

    model_config = ConfigDict(extra="forbid")

    vehicle: Annotated[int, Field(ge=1, le=250)]
    begin: Time
    end: Time
    speed: Speed = 1.0
    """Times real time."""


class ReplayChange(BaseModel):
    """What shall be otherwise; what is left out stays."""

    model_config = ConfigDict(extra="forbid")

    speed: Speed | None = None
    paused: bool | None = None
    at: Time | None = None
    """Goes on from this time, between begin and end."""
    skip_silence: bool | None = None
    """Whether it goes on at what came next, where nothing was received for a while."""


class Silence(BaseModel):
    """A stretch in which nothing was received."""

    begin: float
    end: float
    is_last: bool
    """Whether nothing more was received before the end of the replay."""


class ReplayState(BaseModel):
    """How far a replay has come; times are those of the vehicle [s since 1970]."""

    replay: str
    """It is vehicle `replay:...` of the live socket."""
    vehicle: int
    user: str
    begin: float
    end: float
    at: float
    speed: float
    paused: bool
    """Also at its end."""
    ended: bool
    """Nobody can go on with it."""
    reason: str
    """Why nothing comes; empty while all is well."""
    skip_silence: bool
    silence: Silence | None
    """In which the replay is now."""
    summary: VehicleSummary
    """How the vehicle was, as of the last second."""


def replay_of(
    _user: Viewer, station: TheStation, replay: Annotated[str, Path(min_length=1, max_length=40)]
) -> Replay:  # fmt: skip
    """The replay of the path."""
    found = station.replays.named(replay)
    if found is None:
        raise refusal(404, "this replay is over; begin another", key="replay", value=replay)
    return found


OneReplay = Annotated[Replay, Depends(replay_of)]


@router.get("/replays")
def read_replays(_user: Viewer, station: TheStation) -> list[ReplayState]:
    """All replays that go on."""
    return [ReplayState(**state) for state in station.replays.states()]


@router.post("/replays", status_code=201)
def begin_replay(user: Viewer, body: NewReplay, station: TheStation) -> ReplayState:
    """Begin a replay; it ends by itself when nobody has listened to it for a minute."""
    line_to(body.vehicle, station)
    if body.end - body.begin < SHORTEST:
        raise refusal(422, "a replay ends after it begins", key="end", value=body.end, allowed="a second after begin")
    try:
        replay = station.replays.begin(user.name, body.vehicle, body.begin, body.end, body.speed)
    except NothingReceivedError as error:
        raise refusal(
            422, str(error), key="begin", value=body.begin, allowed="a stretch with something in it"
        ) from None
    except ReplayError as error:
        raise refusal(409, str(error)) from None
    return ReplayState(**replay.state())


@router.get("/replays/{replay}")
def read_replay(_user: Viewer, found: OneReplay) -> ReplayState:
    """How far a replay has come."""
    return ReplayState(**found.state())


@router.put("/replays/{replay}")
def change_replay(user: Viewer, found: OneReplay, body: ReplayChange) -> ReplayState:
    """Go on faster or slower, stand still, or jump."""
    _require_own(user, found)
    begin, end = found.state()["begin"], found.state()["end"]
    if body.at is not None and not begin <= body.at <= end:
        allowed = f"{begin:.3f} to {end:.3f}"
        raise refusal(422, "this time is not in the replay", key="at", value=body.at, allowed=allowed)
    found.change(body.speed, body.paused, body.at, body.skip_silence)
    return ReplayState(**found.state())


@router.delete("/replays/{replay}", status_code=204)
def end_replay(user: Viewer, found: OneReplay) -> None:
    """End a replay."""
    _require_own(user, found)
    found.stop()


def _require_own(user: User, replay: Replay) -> None:
    if replay.user != user.name and not user.role.may(Role.ADMIN):
        raise refusal(403, f"this is the replay of {replay.user}; begin one of your own")
