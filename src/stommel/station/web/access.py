"""Who asks, and whether they may: dependencies of the routes.

A route names the least role that it needs: `user: Viewer`, `user: Pilot`, `user: Admin`, or `user: Holder` where it
commands the vehicle of its path. A route that names none is refused when the application is made.
"""

from collections.abc import Iterable, Iterator
from typing import Annotated

from fastapi import Depends, Path
from fastapi.dependencies.models import Dependant
from fastapi.routing import APIRoute
from starlette.requests import HTTPConnection

from stommel.station.people.people import People
from stommel.station.people.roles import LOCAL, Role, User
from stommel.station.web.errors import refusal
from stommel.station.web.exposure import Exposure

VehicleNumber = Annotated[int, Path(ge=1, le=250, description="Number of the vehicle on the radio.")]
COOKIE, SECURE_COOKIE = "stommel_session", "__Host-stommel_session"
"""Name of the cookie over plain HTTP at the station's own machine, and over TLS."""
PUBLIC = frozenset({("GET", "/api/station"), ("POST", "/api/session"), ("DELETE", "/api/session")})
"""What the page needs before anybody has logged in."""


def cookie_name(connection: HTTPConnection) -> str:
    """Name of the session's cookie; browsers keep one named `__Host-` from other hosts and from plain HTTP."""
    return SECURE_COOKIE if connection.url.scheme in ("https", "wss") else COOKIE


def address_of(connection: HTTPConnection) -> str:
    """From where somebody asks."""
    return connection.client.host if connection.client else "unknown"


def somebody(connection: HTTPConnection) -> User | None:
    """Who asks; nobody where a login is needed and there is none."""
    user, state, scope = _known(connection), connection.state, connection.scope
    state.user = user
    state.action = getattr(scope.get("route"), "name", "").replace("_", " ")
    number = scope.get("path_params", {}).get("vehicle", "")
    state.vehicle = int(number) if str(number).isdecimal() and len(str(number)) < 6 else None
    return user


def gate(connection: HTTPConnection, user: Annotated[User | None, Depends(somebody)]) -> None:
    """Check the role of a route before anything else of it: a stranger learns nothing, not even what is there."""
    role = least_role(connection.scope["route"])
    if role != "public":
        _at_least(_NEEDED[role], user)


def viewer(user: Annotated[User | None, Depends(somebody)]) -> User:
    """Somebody who may look."""
    return _at_least(Role.VIEWER, user)


def pilot(user: Annotated[User | None, Depends(somebody)]) -> User:
    """Somebody who may fly."""
    return _at_least(Role.PILOT, user)


def admin(user: Annotated[User | None, Depends(somebody)]) -> User:
    """Somebody who looks after the station."""
    return _at_least(Role.ADMIN, user)


def holder_of(vehicle: VehicleNumber, connection: HTTPConnection, user: Annotated[User, Depends(pilot)]) -> User:
    """The pilot who holds command of the vehicle; takes it silently where nobody has it."""
    if vehicle not in connection.app.state.station.vehicles:
        raise no_vehicle(vehicle, connection.app.state.station.vehicles)
    people: People = connection.app.state.station.people
    people.holders.need(vehicle, user)
    return user


def no_vehicle(vehicle: int, known: Iterable[int]) -> Exception:
    """What is said of a vehicle that is not there, beside those that are."""
    words, allowed = f"there is no vehicle {vehicle} at this station", ", ".join(map(str, known)) or "none"
    return refusal(404, words, key="vehicle", value=vehicle, allowed=allowed)


Somebody = Annotated[User | None, Depends(somebody)]
Viewer = Annotated[User, Depends(viewer)]
Pilot = Annotated[User, Depends(pilot)]
Admin = Annotated[User, Depends(admin)]
Holder = Annotated[User, Depends(holder_of)]

_ROLES = {viewer: "viewer", pilot: "pilot", admin: "admin", holder_of: "holder"}
_ORDER = ("public", *_ROLES.values())
_NEEDED = {"viewer": Role.VIEWER, "pilot": Role.PILOT, "holder": Role.PILOT, "admin": Role.ADMIN}


def least_role(route: APIRoute) -> str:
    """Least role that a route names: viewer, pilot, admin, holder (a pilot who holds command), or public."""
    named = [_ROLES[call] for call in _calls(route.dependant) if call in _ROLES]
    return max(named, key=_ORDER.index, default="public")


def _calls(dependant: Dependant) -> Iterator[object]:
    yield dependant.call
    for inner in dependant.dependencies:
        yield from _calls(inner)


def _at_least(role: Role, user: User | None) -> User:
    if user is None:
        raise refusal(401, "log in first")
    if not user.role.may(role):
        raise refusal(403, f"this needs the role {role}; {user.name} is {user.role}", allowed=role.value)
    return user


def _known(connection: HTTPConnection) -> User | None:
    exposure: Exposure = connection.app.state.exposure
    kind, _, secret = connection.headers.get("authorization", "").partition(" ")
    if secret:
        people: People = connection.app.state.station.people
        user = people.by_token(secret.strip(), address_of(connection)) if kind.lower() == "bearer" else None
        if user is None:
            raise refusal(401, "this token is unknown or has ended", headers={"WWW-Authenticate": "Bearer"})
        return user
    if not exposure.login_required:
        return LOCAL
    cookie = connection.cookies.get(cookie_name(connection))
    if not cookie:
        return None
    known: User | None = connection.app.state.station.people.sessions.user_of(cookie)
    return known
