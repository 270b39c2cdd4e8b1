"""What a vehicle had told in a stretch of time, and what was known of it at a moment."""

from collections.abc import Mapping

from sqlalchemy import Connection, func, select

from stommel.archive.schema import channels, samples, texts
from stommel.archive.times import microseconds, seconds

Sample = tuple[str, float, float]
MOST_SAMPLES = 10_000
"""That are read at once."""
_SHORTEST_US = 1000
"""A stretch that is not halved again."""


def is_told(key: str) -> bool:
    """Whether a channel comes from the vehicle; those of the link are measured here, also while it is silent."""
    return not key.startswith("link_")


def last_told(latest: Mapping[str, tuple[float, float]]) -> float | None:
    """When the vehicle told something last; None where it never did."""
    return max((t for key, (t, _) in latest.items() if is_told(key)), default=None)


def channel_keys(connection: Connection, vehicle: int) -> dict[int, str]:
    """Channels of which a vehicle has told something: number and key."""
    has_some = (
        select(samples.c.t_us)
        .where(samples.c.vehicle_id == vehicle, samples.c.channel_id == channels.c.id)
        .correlate(channels)
        .limit(1)
        .exists()
    )
    rows = connection.execute(select(channels.c.id, channels.c.key).where(has_some))
    return {row.id: row.key for row in rows}


def values_at(connection: Connection, vehicle: int, known: dict[int, str], t: float) -> dict[str, tuple[float, float]]:
    """Time and value of the newest sample of each channel at a time [s since 1970]."""
    found = {}
    for number, key in known.items():
        newest = (
            select(samples.c.t_us, samples.c.value)
            .where(
                samples.c.vehicle_id == vehicle, samples.c.channel_id == number, samples.c.t_us <= microseconds(t)
            )
            .order_by(samples.c.t_us.desc())
            .limit(1)
        )  # fmt: skip
        row = connection.execute(newest).one_or_none()
        if row is not None:
            found[key] = (seconds(row.t_us), row.value)
    return found


def samples_between(
    connection: Connection, vehicle: int, known: dict[int, str], begin: float, end: float
) -> tuple[list[Sample], float]:
    """Samples after a time and up to another in the order of time, and up to when they are all.

    Where there are more than are read at once, it is a shorter stretch.
    """
    begin_us, end_us = microseconds(begin), microseconds(end)
    while True:
        query = select(samples.c.channel_id, samples.c.t_us, samples.c.value).where(
            samples.c.vehicle_id == vehicle, samples.c.channel_id.in_(list(known)), samples.c.t_us > begin_us,
            samples.c.t_us <= end_us,
        )  # fmt: skip
        is_short = end_us - begin_us <= _SHORTEST_US
        rows = connection.execute(query if is_short else query.limit(MOST_SAMPLES + 1)).all()
        if is_short or len(rows) <= MOST_SAMPLES:
            break
        end_us = begin_us + (end_us - begin_us) // 2
    found = [(known[row.channel_id], seconds(row.t_us), row.value) for row in sorted(rows, key=lambda row: row.t_us)]
    return found, seconds(end_us)


def next_after(connection: Connection, vehicle: int, known: dict[int, str], t: float) -> float | None:
    """When the vehicle told something first after a time [s since 1970]; None where it did not."""
    firsts = [
        select(func.min(samples.c.t_us))
        .where(
            samples.c.vehicle_id == vehicle, samples.c.channel_id == number, samples.c.t_us > microseconds(t)
        )
        .scalar_subquery()
        for number, key in known.items()
        if is_told(key)
    ]  # fmt: skip
    if not firsts:
        return None
    found = [each for each in connection.execute(select(*firsts)).one() if each is not None]
    return seconds(min(found)) if found else None


def texts_between(connection: Connection, vehicle: int, begin: float, end: float) -> list[tuple[float, int, str]]:
    """Time, severity and words of what the vehicle said after a time and up to another; at most as many as are read."""
    query = (
        select(texts.c.t_us, texts.c.severity, texts.c.words)
        .where(texts.c.vehicle_id == vehicle, texts.c.t_us > microseconds(begin), texts.c.t_us <= microseconds(end))
        .order_by(texts.c.t_us, texts.c.id)
        .limit(MOST_SAMPLES)
    )
    return [(seconds(row.t_us), row.severity, row.words) for row in connection.execute(query)]
