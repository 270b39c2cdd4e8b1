"""Sessions of people in a browser: a secret in a cookie, of which the archive keeps a hash."""

from collections.abc import Callable
from contextlib import suppress

from sqlalchemy import select

from stommel.archive.errors import ArchiveError
from stommel.archive.schema import sessions, users
from stommel.archive.times import microseconds, seconds
from stommel.station.people.afterwards import Later, at_once
from stommel.station.people.roles import Role, User
from stommel.station.people.secrets_kept import fingerprint, new_secret
from stommel.station.people.users import Database

IDLE_S = 12 * 3600.0
"""A session that is not used for so long ends."""
LONGEST_S = 7 * 86400.0
"""And any ends after so long."""
MOST = 50
"""Sessions of one person at once; the oldest ends first."""


class Sessions:
    """Who is logged in."""

    def __init__(self, archive: Database, clock: Callable[[], float], later: Later = at_once) -> None:
        self._archive, self._clock, self._later = archive, clock, later

    def begin(self, name: str, address: str) -> str:
        """Log somebody in; returns the secret, which is told once."""
        secret, now = new_secret(), self._clock()
        with self._archive.writing() as connection:
            connection.execute(sessions.delete().where(sessions.c.expires_us <= microseconds(now)))
            newest = (
                select(sessions.c.id_hash)
                .where(sessions.c.user == name)
                .order_by(sessions.c.made_us.desc())
                .limit(MOST - 1)
            )
            connection.execute(sessions.delete().where(sessions.c.user == name, sessions.c.id_hash.not_in(newest)))
            connection.execute(
                sessions.insert().values(
                    id_hash=fingerprint(secret), user=name, address=address,
                    made_us=microseconds(now), expires_us=microseconds(now + IDLE_S), last_used_us=microseconds(now),
                )
            )  # fmt: skip
        return secret

    def user_of(self, secret: str) -> User | None:
        """Who is logged in with the secret; nobody if the session has ended or the person may no longer log in."""
        now, key = self._clock(), fingerprint(secret)
        with self._archive.reading() as connection:
            row = connection.execute(
                select(sessions.c.made_us, sessions.c.expires_us, users.c.name, users.c.role)
                .join_from(sessions, users, sessions.c.user == users.c.name)
                .where(sessions.c.id_hash == key, users.c.disabled.is_(False))
            ).one_or_none()
        if row is None or seconds(row.expires_us) <= now:
            return None
        until = min(now + IDLE_S, seconds(row.made_us) + LONGEST_S)
        if until - seconds(row.expires_us) >= 3600.0:  # written once in an hour only
            self._later(key, lambda: self._used(key, now, until))
        return User(row.name, Role(row.role), "session")

    def end(self, secret: str) -> None:
        """Log out."""
        with self._archive.writing() as connection:
            connection.execute(sessions.delete().where(sessions.c.id_hash == fingerprint(secret)))

    def _used(self, key: str, now: float, until: float) -> None:
        """Let a session that is used last on."""
        with suppress(ArchiveError), self._archive.writing() as connection:  # busy: at the next look
            connection.execute(
                sessions.update()
                .where(sessions.c.id_hash == key)
                .values(expires_us=microseconds(until), last_used_us=microseconds(now))
            )
