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
        value = float((time - np.datetime64(0, "s")) / np.timedelta64(1, "ns")) * 1e-9
    elif isinstance(time, datetime):
        value = _of_date(time)
    elif isinstance(time, str):
        try:
            value = _of_date(datetime.fromisoformat(time.strip()))
        except (ValueError, OverflowError):
            raise TimeError(f"time = {time!r}: must be like 2016-02-01T12:00:00 (UTC)") from None
    else:
        value = float(time)
    if not np.isfinite(value):
        raise TimeError(f"time = {time}: must be a date, or a finite number of seconds since 1970-01-01")
    return value


def _of_date(date: datetime) -> float:
    return (date if date.tzinfo else date.replace(tzinfo=UTC)).timestamp()


def text(time: float) -> str:
    """ISO 8601 text of seconds since 1970-01-01 UTC; words for no limit."""
    if not np.isfinite(time):
        return "always"
    try:
        date = datetime.fromtimestamp(round(time), UTC)
    except (ValueError, OverflowError, OSError):
        return f"{time:g} s after 1970-01-01"
    return date.strftime("%Y-%m-%dT%H:%M:%SZ")
