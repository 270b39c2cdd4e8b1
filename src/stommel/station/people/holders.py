"""Who holds command of a vehicle: one pilot at a time, and everybody sees who."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from threading import Lock

from sqlalchemy import Connection, select

from stommel.archive.schema import holders
from stommel.archive.times import microseconds, seconds
from stommel.station.people.errors import HeldError, PeopleError
from stommel.station.people.roles import Role, User
from stommel.station.people.users import Database

LONGEST_REASON = 500


@dataclass(frozen=True)
class Hold:
    """Who commands a vehicle, since when; `taken_from` and `reason` where it was taken by force."""

    vehicle: int
    user: str
    role: Role
    since: float
    taken_from: str | None = None
    reason: str | None = None


class Holders:
    """Holds of all vehicles; `told` hears of each change, with None where nobody holds any longer."""

    def __init__(self, archive: Database, clock: Callable[[], float], told: Callable[[int, Hold | None], None]) -> None:
        self._archive, self._clock, self._told = archive, clock, told
        self._in_order = Lock()
        """Held from a change until it is told, so that the last that is told is what is so."""

    def of(self, vehicle: int) -> Hold | None:
        """Who commands a vehicle."""
        with self._archive.reading() as connection:
            return _hold(connection, vehicle)

    def need(self, vehicle: int, user: User) -> Hold:
        """Hold of somebody who is about to command; taken silently where nobody has it.

        Raises
        ------
        HeldError
            Somebody else has it.
        """
        with self._archive.reading() as connection:
            now = _hold(connection, vehicle)
        if now is not None and now.user == user.name:
            return now
        return self.take(vehicle, user)

    def take(self, vehicle: int, user: User, reason: str | None = None) -> Hold:
        """Take command; from somebody else only with a reason, and only from somebody of the same or a lesser role.

        Raises
        ------
        HeldError
            Somebody else has it, and no reason was given or their role is the higher one.
        PeopleError
            The reason is too long.
        """
        words = (reason or "").strip()
        if len(words) > LONGEST_REASON:
            raise PeopleError("this reason is too long", "reason", None, f"at most {LONGEST_REASON} characters")
        with self._in_order:
            return self._taken(vehicle, user, words)

    def _taken(self, vehicle: int, user: User, words: str) -> Hold:
        with self._archive.writing() as connection:
            before = _hold(connection, vehicle)
            if before is not None and before.user == user.name:
                return before
            if before is not None:
                _refuse_unless_forced(before, user, words)
                connection.execute(holders.delete().where(holders.c.vehicle_id == vehicle))
            hold = Hold(
                vehicle, user.name, user.role, self._clock(),
                None if before is None else before.user, None if before is None else words,
            )  # fmt: skip
            connection.execute(
                holders.insert().values(
                    vehicle_id=vehicle, user=hold.user, role=hold.role.value, since_us=microseconds(hold.since),
                    taken_from=hold.taken_from, reason=hold.reason,
                )
            )  # fmt: skip
        self._told(vehicle, hold)
        return hold

    def give_up(self, vehicle: int, user: User) -> None:
        """Give up command.

        Raises
        ------
        HeldError
            Somebody else has it.
        """
        with self._in_order:
            with self._archive.writing() as connection:
                now = _hold(connection, vehicle)
                if now is None:
                    return
                if now.user != user.name:
                    raise HeldError(f"{now.user} holds command of vehicle {vehicle}, not {user.name}", now.user)
                connection.execute(holders.delete().where(holders.c.vehicle_id == vehicle))
            self._told(vehicle, None)

    @contextmanager
    def leaving(self) -> Iterator[Callable[[Connection, str], None]]:
        """Let a transaction of others give up all that somebody holds, who may no longer fly; told at the end of it."""
        vehicles: list[int] = []

        def leave(connection: Connection, name: str) -> None:
            vehicles.extend(connection.execute(select(holders.c.vehicle_id).where(holders.c.user == name)).scalars())
            connection.execute(holders.delete().where(holders.c.user == name))

        with self._in_order:
            yield leave
            for vehicle in vehicles:
                self._told(vehicle, None)


def taking(hold: Hold) -> str:
    """How somebody came to hold command, in words."""
    if hold.taken_from is None:
        return "Took command"
    return f"Took command from {hold.taken_from}" + (f": {hold.reason}" if hold.reason else "")


def _hold(connection: Connection, vehicle: int) -> Hold | None:
    row = connection.execute(select(holders).where(holders.c.vehicle_id == vehicle)).one_or_none()
    if row is None:
        return None
    return Hold(vehicle, row.user, Role(row.role), seconds(row.since_us), row.taken_from, row.reason)


def _refuse_unless_forced(before: Hold, user: User, reason: str) -> None:
    since = datetime.fromtimestamp(before.since, UTC).strftime("%d %b %H:%M UTC")
    held = f"{before.user} holds command of vehicle {before.vehicle} since {since}"
    if not user.role.may(before.role):
        raise HeldError(f"{held} as {before.role}; only an {Role.ADMIN} can take it", before.user)
    if not reason:
        raise HeldError(f"{held}; ask for it, or take it with a reason", before.user)
