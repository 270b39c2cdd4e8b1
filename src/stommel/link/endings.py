"""How a request ends, and how far it has come."""

from enum import Enum
from typing import NamedTuple


class Ending(Enum):
    """Ways in which a request ends."""

    WHOLE = "whole"
    REFUSED = "refused"
    FAILED = "failed"


class Progress(NamedTuple):
    """How far a request has come."""

    done: int
    of: int
    """Items, or bytes; 0 while nobody knows."""
    seconds_left: float | None
    """Estimate, at the speed so far; None while there is none."""


def progress(done: int, of: int, elapsed: float) -> Progress:
    """Progress of a request that has run for a time [s]."""
    left = elapsed * (of - done) / done if done > 0 and of >= done else None
    return Progress(done, of, left)
