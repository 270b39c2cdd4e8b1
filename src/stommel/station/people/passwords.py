"""Passwords: what one must be, and argon2 hashes of them."""

import unicodedata
from functools import cache
from typing import TYPE_CHECKING

from stommel.station.people.errors import PeopleError

if TYPE_CHECKING:
    from pwdlib import PasswordHash

SHORTEST, LONGEST = 10, 200
"""Characters of a password."""
_FEWEST = 5
"""Different characters of a password."""


def checked_password(password: str, name: str) -> str:
    """A password that somebody may have.

    Raises
    ------
    PeopleError
        It is too short, too long or too easy; the error does not repeat it.
    """
    allowed = f"{SHORTEST} to {LONGEST} characters, at least {_FEWEST} different ones, without the name"
    if not SHORTEST <= len(password) <= LONGEST:
        raise PeopleError(f"a password has {SHORTEST} to {LONGEST} characters", "password", None, allowed)
    if len(set(password)) < _FEWEST or name in password.casefold():
        raise PeopleError("this password is easily guessed; take a longer one", "password", None, allowed)
    return password


def hashed(password: str) -> str:
    """Argon2 hash with its salt and its settings."""
    return _hasher().hash(_composed(password))


def verified(password: str, known: str | None) -> bool:
    """Whether the password belongs to the hash; takes as long where there is no hash as where there is one."""
    right = len(password) <= LONGEST and _hasher().verify(_composed(password), known or _of_nobody())
    return right and known is not None


@cache
def _hasher() -> "PasswordHash":
    from pwdlib import PasswordHash  # noqa: PLC0415 - loads argon2, which few commands need

    return PasswordHash.recommended()


@cache
def _of_nobody() -> str:
    return _hasher().hash("a password that nobody has")


def _composed(password: str) -> str:
    """The same bytes from every keyboard."""
    return unicodedata.normalize("NFC", password)
