"""Times as people read them."""

from datetime import UTC, datetime


def day(at: float | None) -> str:
    """The day of a time, for people."""
    return "never" if at is None else datetime.fromtimestamp(at, UTC).strftime("%Y-%m-%d")
