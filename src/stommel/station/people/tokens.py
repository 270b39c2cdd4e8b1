"""Tokens, by which a script speaks for a person, with the person's role or a lesser one."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass

from sqlalchemy import Row, func, select

from stommel.archive.errors import ArchiveError
from stommel.archive.schema import tokens, users
from stommel.archive.times import microseconds, seconds
from stommel.station.people.afterwards import Later, at_once
from stommel.station.people.errors import PeopleError, UnknownPersonError
from stommel.station.people.names import spelled
from stommel.station.people.roles import Role, User
from stommel.station.people.secrets_kept import fingerprint, new_secret
from stommel.station.people.users import Database

PREFIX = "stommel_"
"""By which people, and programs that look for leaked secrets, know one."""
LONGEST_DAYS = 366
MOST = 100
"""Tokens of one person."""
_USED_EVERY_S = 60.0


@dataclass(frozen=True)
class Token:
    """A token without its secret; times in seconds since 1970, None where it never ends or was never used."""

    token: int
    user: str
    name: str
    role: Role
    made: float
    expires: float | None
    last_used: float | None


class Tokens:
    """Made, told once, listed and removed."""

    def __init__(self, archive: Database, clock: Callable[[], float], later: Later = at_once) -> None:
        self._archive, self._clock, self._later = archive, clock, later

    def add(self, user: str, name: str, role: Role, days: float | None) -> tuple[Token, str]:
        """Make a token; the secret is told here and never again.

        Raises
        ------
        UnknownPersonError
            Nobody has the name.
        PeopleError
            The role is above that of the person, or there are too many tokens.
        """
        plain, secret, now = spelled(user), new_secret(PREFIX), self._clock()
        expires = None if days is None else microseconds(now + 86400.0 * days)
        with self._archive.writing() as connection:
            own = connection.execute(select(users.c.role).where(users.c.name == plain)).scalar_one_or_none()
            if own is None:
                raise UnknownPersonError(f"nobody is named {plain[:64]}", "user", plain[:64], "the name of somebody")
            if not Role(own).may(role):
                raise PeopleError(f"{plain} is {own} and cannot lend the role {role}", "role", role.value, own)
            mine = select(func.count()).select_from(tokens).where(tokens.c.user == plain)
            if connection.execute(mine).scalar_one() >= MOST:
                raise PeopleError(f"{plain} has {MOST} tokens; remove one first", "name", name, f"at most {MOST}")
            number = connection.execute(
                tokens.insert()
                .values(
                    hash=fingerprint(secret), user=plain, name=name, role=role.value, made_us=microseconds(now),
                    expires_us=expires,
                )
                .returning(tokens.c.id)
            ).scalar_one()  # fmt: skip
        return Token(number, plain, name, role, now, None if expires is None else seconds(expires), None), secret

    def of(self, user: str | None) -> list[Token]:
        """Tokens of somebody; of everybody if None."""
        query = select(tokens).order_by(tokens.c.id)
        if user is not None:
            query = query.where(tokens.c.user == spelled(user))
        with self._archive.reading() as connection:
            return [_token(row) for row in connection.execute(query)]

    def remove(self, token: int, user: str | None = None) -> None:
        """Remove a token, of that person if one is named.

        Raises
        ------
        UnknownPersonError
            There is no such token.
        """
        which = tokens.delete().where(tokens.c.id == token)
        if user is not None:
            which = which.where(tokens.c.user == spelled(user))
        with self._archive.writing() as connection:
            if not connection.execute(which).rowcount:
                raise UnknownPersonError(f"there is no token {token}", "token", token, "the number of a token of yours")

    def user_of(self, secret: str) -> User | None:
        """For whom a token speaks; nobody if it has ended, is unknown, or the person may no longer log in."""
        now = self._clock()
        with self._archive.reading() as connection:
            row = connection.execute(
                select(tokens, users.c.role.label("own"))
                .join_from(tokens, users, tokens.c.user == users.c.name)
                .where(tokens.c.hash == fingerprint(secret), users.c.disabled.is_(False))
            ).one_or_none()
        if row is None or (row.expires_us is not None and seconds(row.expires_us) <= now):
            return None
        if row.last_used_us is None or now - seconds(row.last_used_us) > _USED_EVERY_S:
            self._later(f"token {row.id}", lambda: self._used(row.id, now))
        return User(row.user, min(Role(row.role), Role(row.own), key=lambda role: role.rank), "token")

    def _used(self, token: int, now: float) -> None:
        with suppress(ArchiveError), self._archive.writing() as connection:  # busy: at the next look
            connection.execute(tokens.update().where(tokens.c.id == token).values(last_used_us=microseconds(now)))


def _token(row: Row[tuple[object, ...]]) -> Token:
    return Token(
        row.id, row.user, row.name, Role(row.role), seconds(row.made_us),
        None if row.expires_us is None else seconds(row.expires_us),
        None if row.last_used_us is None else seconds(row.last_used_us),
    )  # fmt: skip
