"""GPS weeks and seconds, and UTC as seconds since 1 January 1970."""

import math

GPS_EPOCH = 315964800.0
"""6 January 1980 in seconds since 1970."""
WEEK = 604800.0
WEEK_MS = 604_800_000
ROLL_OVER = 1024
"""Weeks after which the ten bits of the satellites' own count begin anew."""
LEAP_SECONDS = 18.0
"""GPS time ahead of UTC since 2017 [s]."""


def week_and_ms(utc: float, leap: float = LEAP_SECONDS) -> tuple[int, int]:
    """GPS week and milliseconds in it, 0 to 604 799 999."""
    total = round((utc + leap - GPS_EPOCH) * 1000.0)
    return divmod(total, WEEK_MS)


def utc_of(week: int, ms: float, leap: float = LEAP_SECONDS) -> float:
    """Seconds since 1970 of a GPS week and the milliseconds in it."""
    return GPS_EPOCH + week * WEEK + ms / 1000.0 - leap


def unrolled(utc: float, earliest: float) -> float:
    """Time of a receiver that has lost count of the roll-overs: 1024 weeks later until it is not before `earliest`."""
    missing = (earliest - utc) / (ROLL_OVER * WEEK)
    return utc + math.ceil(missing) * ROLL_OVER * WEEK if missing > 0.0 else utc
