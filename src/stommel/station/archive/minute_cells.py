"""What the samples of a channel come to in each minute, kept up with the samples themselves.

A month at 1 Hz is 2.6 million samples and 43 200 minutes: long ranges are drawn from the minutes.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from sqlalchemy import Connection, select

from stommel.station.archive.schema import minutes, samples
from stommel.station.archive.times import MINUTE_US
from stommel.station.archive.upserting import upsert


@dataclass(frozen=True)
class Cell:
    """One minute of one channel; the columns of the table after its key."""

    count: int
    total: float
    first_t_us: int
    first: float
    last_t_us: int
    last: float
    low_t_us: int
    low: float
    high_t_us: int
    high: float

    def joined(self, later: "Cell") -> "Cell":
        """Both this cell and one of the same minute whose samples are all later."""
        low = later if later.low < self.low else self
        high = later if later.high > self.high else self
        return Cell(
            self.count + later.count, self.total + later.total,
            self.first_t_us, self.first, later.last_t_us, later.last,
            low.low_t_us, low.low, high.high_t_us, high.high,
        )  # fmt: skip


Place = tuple[int, int]
"""Channel and minute."""


def cell_of(points: Sequence[tuple[int, float]]) -> Cell:
    """The cell of the samples of one minute, at least one, in order of time; of equal extremes the first."""
    (first_t, first), (last_t, last) = points[0], points[-1]
    low_t, low, high_t, high, total = first_t, first, first_t, first, 0.0
    for t_us, value in points:
        total += value
        if value < low:
            low_t, low = t_us, value
        elif value > high:
            high_t, high = t_us, value
    return Cell(len(points), total, first_t, first, last_t, last, low_t, low, high_t, high)


def keep_up(connection: Connection, vehicle: int, new: dict[Place, list[tuple[int, float]]]) -> None:
    """Bring the minutes up to date with samples that have just been written.

    Parameters
    ----------
    connection
        In the transaction that wrote them.
    vehicle
        Its number.
    new
        By channel and minute, in order of time, no time twice. Minutes to which they are only added at the end are
        joined with what was there; the others are made from all their samples again.
    """
    known = _known(connection, vehicle, new)
    rows = []
    for place, points in new.items():
        old = known.get(place)
        if old is None:
            cell = cell_of(points)
        elif points[0][0] > old.last_t_us:
            cell = old.joined(cell_of(points))
        else:
            cell = cell_of(_all_points(connection, vehicle, place))
        rows.append({"vehicle_id": vehicle, "channel_id": place[0], "minute": place[1], **vars(cell)})
    upsert(connection, minutes, rows)


def _known(connection: Connection, vehicle: int, places: Iterable[Place]) -> dict[Place, Cell]:
    """The cells that are there already, at these places."""
    channels = sorted({channel for channel, _ in places})
    found: dict[Place, Cell] = {}
    for begin, end in _runs(sorted({minute for _, minute in places})):
        query = select(minutes).where(
            minutes.c.vehicle_id == vehicle,
            minutes.c.channel_id.in_(channels),
            minutes.c.minute.between(begin, end),
        )
        for _, channel, minute, *cell in connection.execute(query):
            found[channel, minute] = Cell(*cell)
    return found


def _runs(numbers: list[int]) -> list[tuple[int, int]]:
    """First and last of each run of neighbours."""
    runs: list[tuple[int, int]] = []
    for number in numbers:
        if runs and number == runs[-1][1] + 1:
            runs[-1] = (runs[-1][0], number)
        else:
            runs.append((number, number))
    return runs


def _all_points(connection: Connection, vehicle: int, place: Place) -> list[tuple[int, float]]:
    channel, minute = place
    query = (
        select(samples.c.t_us, samples.c.value)
        .where(
            samples.c.vehicle_id == vehicle,
            samples.c.channel_id == channel,
            samples.c.t_us >= minute * MINUTE_US,
            samples.c.t_us < (minute + 1) * MINUTE_US,
        )
        .order_by(samples.c.t_us)
    )
    return [(t_us, value) for t_us, value in connection.execute(query)]
