"""Times as users write them, and seconds since 1970-01-01 UTC, which everything inside uses."""

from datetime import UTC, datetime
from typing import TypeAlias

import numpy as np

from stommel.errors import StommelError

Time: TypeAlias = float | str | datetime | np.datetime64
"""Seconds since 1970-01-01 UTC, an ISO 8601 text, or a date; without a zone it is UTC."""


class TimeError(StommelError):
    """Text that is no time."""


def seconds(time: Time) -> float:
    """Seconds since 1970-01-01 UTC.

    Raises
    ------
    TimeError
        The text is not ISO 8601.
    """
    if isinstance(time, np.datetime64):
        return float((time - np.datetime64(0, "s")) / np.timedelta64(1, "ns")) * 1e-9
    if isinstance(time, str):
        try:
            time = datetime.fromisoformat(time.strip())
        except ValueError:
            raise TimeError(f"time = {time!r}: must be like 2016-02-01T12:00:00 (UTC)") from None
    if isinstance(time, datetime):
        return (time if time.tzinfo else time.replace(tzinfo=UTC)).timestamp()
    value = float(time)
    if not np.isfinite(value):
        raise TimeError(f"time = {value}: must be a finite number of seconds since 1970-01-01")
    return value


def text(time: float) -> str:
    """ISO 8601 text of seconds since 1970-01-01 UTC; words for no limit."""
    if not np.isfinite(time):
        return "always"
    return datetime.fromtimestamp(round(time), UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
