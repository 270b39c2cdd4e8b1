"""How an instrument does, as the monitoring of the vehicle reads it."""

from dataclasses import dataclass
from enum import StrEnum


@dataclass(frozen=True, slots=True)
class Health:
    """What a driver knows about its instrument."""

    instrument: str
    """`compass`, `gnss` or `ctd`."""
    state: StrEnum
    """One of the states of that instrument."""
    last_reading: float
    """Time of the last reading [s], minus infinity before the first."""
    good: int
    """Frames understood."""
    bad: int
    """Frames refused and runs of bytes that were no frame."""
    reason: str
    """Why it gives no readings, in words; empty while it does."""
