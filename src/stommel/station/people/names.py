"""Names of people: one spelling of each, which cannot be taken for another."""

import re
import unicodedata

from stommel.station.people.errors import PeopleError
from stommel.station.people.roles import LOCAL

LONGEST_NAME = 64
_NAME = re.compile(r"[^\W_][\w.@-]*")
ALLOWED = f"a letter or digit, then letters, digits and . _ - @, at most {LONGEST_NAME} characters; not {LOCAL.name}"


def spelled(name: str) -> str:
    """The one spelling of a name: small letters, composed; whatever else it is."""
    return unicodedata.normalize("NFKC", name).casefold()


def checked_name(name: str) -> str:
    """The one spelling of a name that somebody may have.

    Raises
    ------
    PeopleError
        Nobody may have it.
    """
    plain = spelled(name)
    if len(plain) > LONGEST_NAME or not _NAME.fullmatch(plain) or plain == LOCAL.name:
        raise PeopleError("this is no name for a person", "name", name[:LONGEST_NAME], ALLOWED)
    return plain
