"""Times of people in the archive: integer microseconds since 1970 there, seconds outside."""


def microseconds(seconds: float) -> int:
    """As the archive keeps it."""
    return round(seconds * 1e6)


def seconds(us: int) -> float:
    """As everybody else says it."""
    return us / 1e6
