"""Who asks, and whether they may: dependencies of the routes.

A route names the least role that it needs: `user: Viewer`, `user: Pilot`, `user: Admin`, or `user: Holder` where it
commands the vehicle of its path.
"""

from typing import Annotated

from fastapi import Depends, Path
from starlette.requests import HTTPConnection

from stommel.station.people.roles import LOCAL, Role, User
from stommel.station.web.errors import refusal

VehicleNumber = Annotated[int, Path(ge=1, le=250, description="Number of the vehicle on the radio.")]


def somebody(connection: HTTPConnection) -> User | None:
    """Who asks; nobody where a login is needed and there is none."""
    return LOCAL


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
    return user


Viewer = Annotated[User, Depends(viewer)]
Pilot = Annotated[User, Depends(pilot)]
Admin = Annotated[User, Depends(admin)]
Holder = Annotated[User, Depends(holder_of)]


def _at_least(role: Role, user: User | None) -> User:
    if user is None:
        raise refusal(401, "log in first")
    if not user.role.may(role):
        raise refusal(403, f"this needs the role {role}; {user.name} is {user.role}")
    return user
