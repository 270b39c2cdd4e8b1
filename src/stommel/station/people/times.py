"""Times of people in the archive: integer microseconds since 1970 there, seconds outside."""

from datetime import UTC, datetime


def microseconds(seconds: float) -> int:
    """As the archive keeps it."""
    return round(seconds * 1e6)


def seconds(us: int) -> float:
    """As everybody else says it."""
    return us / 1e6


def day(at: float | None) -> str:
    """The day of a time, for people."""
    return "never" if at is None else datetime.fromtimestamp(at, UTC).strftime("%Y-%m-%d")
