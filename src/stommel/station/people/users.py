"""The people of a station and their roles."""

from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import Protocol

from sqlalchemy import Connection, func, select

from stommel.archive.schema import sessions, tokens, users
from stommel.archive.times import microseconds, seconds
from stommel.station.people.errors import PeopleError, UnknownPersonError
from stommel.station.people.names import checked_name, spelled
from stommel.station.people.passwords import checked_password, hashed
from stommel.station.people.roles import Role


class Database(Protocol):
    """What people need of the archive."""

    def reading(self) -> AbstractContextManager[Connection]:
        """Connection to read with."""

    def writing(self) -> AbstractContextManager[Connection]:
        """Connection of one transaction, committed at its end."""

    @property
    def is_written(self) -> bool:
        """Whether somebody writes just now."""


@dataclass(frozen=True)
class Person:
    """Somebody with a name at this station; `added` in seconds since 1970."""

    name: str
    role: Role
    added: float
    disabled: bool


Changed = Callable[[Connection, Person], None]
"""Writes what follows from a change, in its transaction, of the person as they are after it."""


class Users:
    """People, added and changed by whoever looks after the station."""

    def __init__(self, archive: Database, clock: Callable[[], float]) -> None:
        self._archive, self._clock = archive, clock

    def everybody(self) -> list[Person]:
        """All of them by name, those too who may not log in at present."""
        with self._archive.reading() as connection:
            return [_person(row) for row in connection.execute(select(users).order_by(users.c.name))]

    def admins(self) -> int:
        """How many may log in and look after the station."""
        return sum(_looks_after(person) for person in self.everybody())

    def require(self, name: str) -> Person:
        """Somebody of that name.

        Raises
        ------
        UnknownPersonError
            There is nobody.
        """
        with self._archive.reading() as connection:
            return _must_be_there(connection, spelled(name))

    def known(self, name: str) -> tuple[Person, str] | None:
        """Somebody and the hash of the password; nothing if nobody has the name."""
        with self._archive.reading() as connection:
            row = connection.execute(select(users).where(users.c.name == spelled(name))).one_or_none()
        return None if row is None else (_person(row), row.password_hash)

    def add(self, name: str, password: str, role: Role) -> Person:
        """Add somebody.

        Raises
        ------
        PeopleError
            The name is taken or cannot be, or the password is too weak.
        """
        plain = checked_name(name)
        secret = hashed(checked_password(password, plain))
        added = microseconds(self._clock())
        with self._archive.writing() as connection:
            if connection.execute(select(users.c.name).where(users.c.name == plain)).one_or_none():
                raise PeopleError(f"there is somebody named {plain} already", "name", plain, "another name")
            connection.execute(
                users.insert().values(name=plain, password_hash=secret, role=role.value, added_us=added, disabled=False)
            )
        return Person(plain, role, seconds(added), False)

    def change(
        self,
        name: str,
        *,
        role: Role | None = None,
        disabled: bool | None = None,
        password: str | None = None,
        changed: Changed | None = None,
    ) -> Person:
        """Change a role, keep somebody out or let them in again, or set a new password; what is None stays.

        A new password and keeping somebody out end all their sessions. `changed` writes in the same transaction.

        Raises
        ------
        UnknownPersonError
            Nobody has the name.
        PeopleError
            The password is too weak, or nobody would be left to look after the station.
        """
        plain = spelled(name)
        values: dict[str, object] = {}
        if role is not None:
            values["role"] = role.value
        if disabled is not None:
            values["disabled"] = disabled
        if password is not None:
            values["password_hash"] = hashed(checked_password(password, plain))
        with self._archive.writing() as connection:
            before = _must_be_there(connection, plain)
            if values:
                connection.execute(users.update().where(users.c.name == plain).values(values))
            after = _person(connection.execute(select(users).where(users.c.name == plain)).one())
            if _looks_after(before) and not _looks_after(after):
                _somebody_looks_after(connection)
            if disabled or password is not None:
                connection.execute(sessions.delete().where(sessions.c.user == plain))
            if changed is not None:
                changed(connection, after)
        return after

    def remove(self, name: str, changed: Changed | None = None) -> None:
        """Remove somebody with their sessions and tokens; what they did stays in the audit log.

        `changed` writes in the same transaction.

        Raises
        ------
        UnknownPersonError
            Nobody has the name.
        PeopleError
            Nobody would be left to look after the station.
        """
        plain = spelled(name)
        with self._archive.writing() as connection:
            person = _must_be_there(connection, plain)
            connection.execute(sessions.delete().where(sessions.c.user == plain))
            connection.execute(tokens.delete().where(tokens.c.user == plain))
            connection.execute(users.delete().where(users.c.name == plain))
            if _looks_after(person):
                _somebody_looks_after(connection)
            if changed is not None:
                changed(connection, person)


def _person(row: object) -> Person:
    return Person(row.name, Role(row.role), seconds(row.added_us), row.disabled)  # type: ignore[attr-defined]


def _must_be_there(connection: Connection, name: str) -> Person:
    row = connection.execute(select(users).where(users.c.name == name)).one_or_none()
    if row is None:
        raise UnknownPersonError(f"nobody is named {name[:64]}", "name", name[:64], "the name of somebody here")
    return _person(row)


def _looks_after(person: Person) -> bool:
    return person.role is Role.ADMIN and not person.disabled


def _somebody_looks_after(connection: Connection) -> None:
    """Refuse a change by which people are left, but no admin among them."""
    active = select(func.count()).select_from(users).where(users.c.disabled.is_(False))
    left = connection.execute(active.where(users.c.role == Role.ADMIN.value)).scalar_one()
    if not left and connection.execute(select(func.count()).select_from(users)).scalar_one():
        raise PeopleError(
            "this is the last admin; make somebody else admin first", "role", None, "one admin at least who may log in"
        )
