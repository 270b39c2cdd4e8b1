"""The newest sample of each channel."""

from sqlalchemy import Connection, and_, func, select

from stommel.archive.schema import channels, samples
from stommel.archive.times import seconds


def latest_values(connection: Connection, vehicle: int) -> dict[str, tuple[float, float]]:
    """Time [s since 1970] and value of the newest sample of each channel of a vehicle, by key."""
    other = samples.alias()
    newest = (
        select(func.max(other.c.t_us))
        .where(other.c.vehicle_id == vehicle, other.c.channel_id == channels.c.id)
        .correlate(channels)
        .scalar_subquery()
    )
    sample = and_(samples.c.vehicle_id == vehicle, samples.c.channel_id == channels.c.id, samples.c.t_us == newest)
    query = select(channels.c.key, samples.c.t_us, samples.c.value).select_from(channels).join(samples, sample)
    return {key: (seconds(t_us), value) for key, t_us, value in connection.execute(query)}
