"""The station itself: its name, its clock and who asks."""

import time
from typing import Any

from fastapi import APIRouter, Request
from pydantic import BaseModel

from stommel import __version__
from stommel.station.people.roles import Role
from stommel.station.web.access import Somebody, Viewer

router = APIRouter(prefix="/api", tags=["station"])


class Asking(BaseModel):
    """Who asks."""

    name: str
    role: Role


class StationInfo(BaseModel):
    """What everybody may know of the station."""

    name: str
    version: str
    now: float
    user: Asking | None
    login_required: bool
    demo: bool


@router.get("/station")
def read_station(request: Request, user: Somebody) -> StationInfo:
    """Name, version and time of the station, who asks, and whether people must log in."""
    state = request.app.state
    return StationInfo(
        name=state.station.settings.name,
        version=__version__,
        now=time.time(),
        user=None if user is None else Asking(name=user.name, role=user.role),
        login_required=state.exposure.login_required,
        demo=state.station.settings.demo,
    )


@router.get("/openapi.json", include_in_schema=False)
def read_openapi(request: Request, _user: Viewer) -> dict[str, Any]:
    """The OpenAPI document of this API."""
    document: dict[str, Any] = request.app.openapi()
    return document
