"""The people of a station, together: users, sessions, tokens, tries, audit log, and who holds command."""

import threading
import time
from collections.abc import Callable

from sqlalchemy import Connection

from stommel.station.people.afterwards import Later, at_once
from stommel.station.people.attempts import Attempts
from stommel.station.people.audit import Audit
from stommel.station.people.errors import WrongLoginError
from stommel.station.people.holders import Hold, Holders
from stommel.station.people.names import LONGEST_NAME, spelled
from stommel.station.people.passwords import verified
from stommel.station.people.roles import Role, User
from stommel.station.people.sessions import Sessions
from stommel.station.people.tokens import Tokens
from stommel.station.people.users import Database, Person, Users


class People:
    """Everything that the station knows of people.

    Parameters
    ----------
    archive
        Where it is kept.
    clock
        Seconds since 1970 at the station.
    told
        Hears who holds command of a vehicle from now on; None where nobody does.
    later
        Writes down when somebody came, without letting them wait.
    """

    def __init__(
        self, archive: Database, *, clock: Callable[[], float] = time.time,
        told: Callable[[int, Hold | None], None] | None = None, later: Later = at_once,
    ) -> None:  # fmt: skip
        self.users = Users(archive, clock)
        self.sessions = Sessions(archive, clock, later)
        self.tokens = Tokens(archive, clock, later)
        self.audit = Audit(archive, clock)
        self.holders = Holders(archive, clock, told or _nobody_hears)
        self.attempts = Attempts()
        self._one_at_a_time = threading.Lock()

    def log_in(self, name: str, password: str, address: str) -> tuple[User, str]:
        """Check a password and begin a session; returns the secret of the session.

        Raises
        ------
        WrongLoginError
            Name and password do not belong together.
        TooManyTriesError
            There were too many wrong ones before.
        """
        person = self.confirm(name, password, address)
        secret = self.sessions.begin(person.name, address)
        self.audit.record("log in", user=person.name, address=address)
        return User(person.name, person.role, "session"), secret

    def confirm(self, name: str, password: str, address: str) -> Person:
        """Check a password, one try at a time: argon2 takes 64 MB, and no try may slip past the count of the others.

        Raises
        ------
        WrongLoginError
            Name and password do not belong together.
        TooManyTriesError
            There were too many wrong ones before.
        """
        plain = spelled(name)[:LONGEST_NAME]
        with self._one_at_a_time:
            self.attempts.check(plain, address)
            known = self.users.known(plain)
            right = verified(password, None if known is None else known[1])
            if known is not None and right and not known[0].disabled:
                self.attempts.succeeded(plain, address)
                return known[0]
            self.attempts.failed(plain, address)
        self.audit.record("log in refused", user=None, address=address, detail={"name": plain})
        raise WrongLoginError("name and password do not belong together")

    def by_token(self, secret: str, address: str) -> User | None:
        """For whom a token speaks; wrong ones count as tries from the address.

        Raises
        ------
        TooManyTriesError
            There were too many wrong ones before.
        """
        user = self.tokens.user_of(secret)
        if user is None:
            self.attempts.check(None, address)
            self.attempts.failed(None, address)
        return user

    def change(
        self, name: str, *, role: Role | None = None, disabled: bool | None = None, password: str | None = None
    ) -> Person:
        """As `Users.change`; who may no longer fly gives up command, in the same transaction."""
        with self.holders.leaving() as leave:

            def changed(connection: Connection, person: Person) -> None:
                if person.disabled or not person.role.may(Role.PILOT):
                    leave(connection, person.name)

            return self.users.change(name, role=role, disabled=disabled, password=password, changed=changed)

    def remove(self, name: str) -> None:
        """As `Users.remove`; what the person held is free, in the same transaction."""
        with self.holders.leaving() as leave:
            self.users.remove(name, lambda connection, person: leave(connection, person.name))


def _nobody_hears(_vehicle: int, _hold: Hold | None) -> None:
    """Where nothing shows who holds command."""
