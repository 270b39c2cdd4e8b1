"""The station itself: its name, its clock and who asks."""

import time
from typing import Annotated, Any

from fastapi import APIRouter, Depends, Request
from pydantic import BaseModel

from stommel import __version__
from stommel.station.people.roles import User
from stommel.station.web.access import Viewer, somebody

router = APIRouter(prefix="/api", tags=["station"])


class Person(BaseModel):
    """Who asks."""

    name: str
    role: str


class StationInfo(BaseModel):
    """What everybody may know of the station."""

    name: str
    version: str
    now: float
    user: Person | None
    login_required: bool
    demo: bool


@router.get("/station")
def read_station(request: Request, user: Annotated[User | None, Depends(somebody)]) -> StationInfo:
    """Name, version and time of the station, who asks, and whether people must log in."""
    state = request.app.state
    return StationInfo(
        name=getattr(state.station.settings, "name", "stommel"),
        version=__version__,
        now=time.time(),
        user=None if user is None else Person(name=user.name, role=user.role),
        login_required=state.exposure.login_required,
        demo=bool(getattr(state.station.settings, "demo", False)),
    )


@router.get("/openapi.json", include_in_schema=False)
def read_openapi(request: Request, _user: Viewer) -> dict[str, Any]:
    """The OpenAPI document of this API."""
    document: dict[str, Any] = request.app.openapi()
    return document
