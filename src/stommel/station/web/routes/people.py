"""People: logging in and out, users, tokens, the audit log, and who holds command of a vehicle."""

from typing import Annotated, Any

from anyio import CapacityLimiter, to_thread
from fastapi import APIRouter, Path, Query, Request, Response
from pydantic import BaseModel, ConfigDict, Field

from stommel.station.people.errors import TooManyTriesError
from stommel.station.people.holders import LONGEST_REASON, Hold
from stommel.station.people.names import LONGEST_NAME
from stommel.station.people.passwords import LONGEST
from stommel.station.people.people import People
from stommel.station.people.roles import Role, User
from stommel.station.people.sessions import LONGEST_S
from stommel.station.people.tokens import LONGEST_DAYS, Token
from stommel.station.people.users import Person
from stommel.station.web.access import (
    Admin,
    Pilot,
    VehicleNumber,
    Viewer,
    address_of,
    cookie_name,
    no_vehicle,
)
from stommel.station.web.errors import refusal

router = APIRouter(prefix="/api", tags=["people"])

MOST_WAITING = 20
"""Logins that may wait for each other; each takes argon2 a tenth of a second."""

Name = Annotated[str, Field(min_length=1, max_length=LONGEST_NAME)]
Password = Annotated[str, Field(min_length=1, max_length=LONGEST)]
NameInPath = Annotated[str, Path(min_length=1, max_length=LONGEST_NAME)]
RowNumber = Annotated[int, Path(ge=1, le=2**53)]


class _Body(BaseModel):
    model_config = ConfigDict(extra="forbid")


class Login(_Body):
    """Name and password."""

    name: Name
    password: Password


class NewPassword(_Body):
    """The present password and the one from now on."""

    password: Password
    new_password: Password


class NewUser(_Body):
    """Somebody to add."""

    name: Name
    password: Password
    role: Role


class UserChange(_Body):
    """What changes of somebody; what is left out stays."""

    role: Role | None = None
    disabled: bool | None = None
    password: Password | None = None


class NewToken(_Body):
    """A token to make."""

    name: Annotated[str, Field(min_length=1, max_length=80)]
    role: Role
    days: Annotated[float, Field(gt=0, le=LONGEST_DAYS)] = 90.0
    user: Name | None = None


class Take(_Body):
    """How to take command."""

    by_force: bool = False
    reason: Annotated[str, Field(max_length=LONGEST_REASON)] = ""


class LoggedIn(BaseModel):
    """Who is logged in."""

    name: str
    role: Role


class TokenMade(BaseModel):
    """A token, with its secret for the only time."""

    token: Token
    secret: str


class HolderInfo(BaseModel):
    """Who commands the vehicle; null where nobody does."""

    holder: Hold | None


class AuditEntry(BaseModel):
    """One action of somebody; `t` in seconds since 1970."""

    entry: int
    t: float
    user: str | None
    address: str | None
    action: str
    vehicle: int | None
    detail: Any


class _Waiting:
    """Logins one after the other, and not too many that wait."""

    def __init__(self) -> None:
        self.one = CapacityLimiter(1)

    def check(self) -> None:
        if self.one.statistics().tasks_waiting >= MOST_WAITING:
            raise TooManyTriesError("too many people log in at once; try again in a few seconds", 5.0)


def _people(request: Request) -> People:
    people: People = request.app.state.station.people
    return people


@router.post("/session")
async def log_in(login: Login, request: Request, response: Response) -> LoggedIn:
    """Log in; the cookie of the answer is the session."""
    if not hasattr(request.app.state, "logins"):
        request.app.state.logins = _Waiting()
    waiting: _Waiting = request.app.state.logins
    waiting.check()
    people, address = _people(request), address_of(request)
    user, secret = await to_thread.run_sync(
        lambda: people.log_in(login.name, login.password, address), limiter=waiting.one
    )
    response.set_cookie(
        cookie_name(request), secret, max_age=int(LONGEST_S), path="/", httponly=True, samesite="strict",
        secure=request.url.scheme == "https",
    )  # fmt: skip
    return LoggedIn(name=user.name, role=user.role)


@router.delete("/session", status_code=204)
def log_out(request: Request, response: Response) -> None:
    """Log out; does nothing where nobody is logged in."""
    name = cookie_name(request)
    secret = request.cookies.get(name)
    if secret:
        _people(request).sessions.end(secret)
    response.delete_cookie(name, path="/", httponly=True, samesite="strict", secure=request.url.scheme == "https")


@router.put("/session/password", status_code=204)
def change_password(change: NewPassword, request: Request, user: Viewer) -> None:
    """Change one's own password; all sessions of that person end."""
    _in_person(user)
    people = _people(request)
    people.confirm(user.name, change.password, address_of(request))
    people.change(user.name, password=change.new_password)


@router.get("/users")
def list_users(request: Request, _user: Admin) -> list[Person]:
    """Everybody with a name at this station."""
    return _people(request).users.everybody()


@router.post("/users", status_code=201)
def add_user(new: NewUser, request: Request, user: Admin) -> Person:
    """Add somebody."""
    _in_person(user)
    return _people(request).users.add(new.name, new.password, new.role)


@router.patch("/users/{name}")
def change_user(name: NameInPath, change: UserChange, request: Request, user: Admin) -> Person:
    """Change somebody's role, keep them out, let them in again, or set a new password."""
    _in_person(user)
    return _people(request).change(name, role=change.role, disabled=change.disabled, password=change.password)


@router.delete("/users/{name}", status_code=204)
def remove_user(name: NameInPath, request: Request, user: Admin) -> None:
    """Remove somebody; what they did stays in the audit log."""
    _in_person(user)
    _people(request).remove(name)


@router.get("/tokens")
def list_tokens(request: Request, user: Viewer) -> list[Token]:
    """One's own tokens; an admin sees everybody's."""
    return _people(request).tokens.of(None if user.role is Role.ADMIN else user.name)


@router.post("/tokens", status_code=201)
def add_token(new: NewToken, request: Request, user: Viewer) -> TokenMade:
    """Make a token for a script, for oneself; an admin also for others."""
    _in_person(user)
    owner = new.user or user.name
    if owner != user.name and user.role is not Role.ADMIN:
        raise refusal(403, "only an admin makes tokens for others", key="user", value=owner, allowed=user.name)
    token, secret = _people(request).tokens.add(owner, new.name, new.role, new.days)
    return TokenMade(token=token, secret=secret)


@router.delete("/tokens/{token}", status_code=204)
def remove_token(token: RowNumber, request: Request, user: Viewer) -> None:
    """Remove a token of one's own; an admin removes any."""
    _people(request).tokens.remove(token, None if user.role is Role.ADMIN else user.name)


@router.get("/audit")
def read_audit(
    request: Request,
    _user: Admin,
    before: Annotated[int | None, Query(ge=1, le=2**53)] = None,
    limit: Annotated[int, Query(ge=1, le=1000)] = 200,
    user: Annotated[str | None, Query(max_length=LONGEST_NAME)] = None,
    vehicle: Annotated[int | None, Query(ge=1, le=250)] = None,
) -> list[AuditEntry]:
    """Who changed what, the newest first; `before` is the number of the last row that was read."""
    rows = _people(request).audit.entries(before=before, limit=limit, user=user, vehicle=vehicle)
    return [AuditEntry(**row._asdict()) for row in rows]


@router.get("/vehicles/{vehicle}/holder")
def read_holder(vehicle: VehicleNumber, request: Request, _user: Viewer) -> HolderInfo:
    """Who holds command of the vehicle."""
    _there(request, vehicle)
    return HolderInfo(holder=_people(request).holders.of(vehicle))


@router.post("/vehicles/{vehicle}/holder")
def take_command(vehicle: VehicleNumber, take: Take, request: Request, user: Pilot) -> HolderInfo:
    """Take command; from somebody else `by_force` with a reason, which that person sees."""
    _there(request, vehicle)
    if take.by_force and not take.reason.strip():
        raise refusal(422, "say why you take command", key="reason", allowed=f"1 to {LONGEST_REASON} characters")
    reason = take.reason if take.by_force else None
    return HolderInfo(holder=_people(request).holders.take(vehicle, user, reason))


@router.delete("/vehicles/{vehicle}/holder", status_code=204)
def give_up_command(vehicle: VehicleNumber, request: Request, user: Pilot) -> None:
    """Give up command, so that somebody else can take it."""
    _there(request, vehicle)
    _people(request).holders.give_up(vehicle, user)


def _there(request: Request, vehicle: int) -> None:
    if vehicle not in request.app.state.station.vehicles:
        raise no_vehicle(vehicle, request.app.state.station.vehicles)


def _in_person(user: User) -> None:
    """Refuse a script: whoever finds its token shall not make another from it."""
    if user.via == "token":
        raise refusal(403, "a token changes no people, passwords or tokens; log in")
