"""What a user may have meant by a name that is not known."""

import difflib
from collections.abc import Iterable

_ALIKE = 0.6
"""Least likeness of two names, as difflib counts it."""


def nearest(name: str, known: Iterable[str]) -> str | None:
    """The known name that is most like `name`, whatever its case; None where none is near."""
    by_folded = {word.casefold(): word for word in known}
    found = difflib.get_close_matches(name.casefold(), by_folded, 1, _ALIKE)
    return by_folded[found[0]] if found else None


def did_you_mean(name: str, known: Iterable[str], before: str = "") -> str:
    """End of a clause about an unknown name: a question where a known one is near, else a semicolon.

    `before` stands before the known name, as the table of a dotted key.
    """
    near = nearest(name, known)
    return ";" if near is None else f"; did you mean {before}{near}?"
