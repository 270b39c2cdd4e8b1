"""What the samples of a channel come to in each minute and each ten minutes, kept up with the samples themselves.

A month at 1 Hz is 2.6 million samples, 43 200 minutes or 4 320 times ten: long ranges are drawn from the cells.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import NamedTuple

from sqlalchemy import Connection, Table, select

from stommel.archive.schema import minutes, samples, ten_minutes
from stommel.archive.times import MINUTE_US
from stommel.archive.upserting import insert_rows

Place = tuple[int, int]
"""Channel and number of the cell."""
Point = tuple[int, float]
"""Time [us] and value of a sample."""


@dataclass(frozen=True)
class Level:
    """Cells of one width."""

    table: Table
    width_us: int


LEVELS = (Level(minutes, MINUTE_US), Level(ten_minutes, 10 * MINUTE_US))
"""From fine to coarse."""


class Cell(NamedTuple):
    """One stretch of one channel; the columns of its table after the key."""

    samples: int
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
        """The cell of the samples of both, of which those of `later` are all later."""
        low = later if later.low < self.low else self
        high = later if later.high > self.high else self
        return Cell(
            self.samples + later.samples, self.total + later.total,
            self.first_t_us, self.first, later.last_t_us, later.last,
            low.low_t_us, low.low, high.high_t_us, high.high,
        )  # fmt: skip


def cell_of(points: Sequence[Point]) -> Cell:
    """The cell of at least one sample, in order of time; of equal extremes the first."""
    (first_t, first), (last_t, last) = points[0], points[-1]
    low_t, low, high_t, high, total = first_t, first, first_t, first, 0.0
    for t_us, value in points:
        total += value
        if value < low:
            low_t, low = t_us, value
        elif value > high:
            high_t, high = t_us, value
    return Cell(len(points), total, first_t, first, last_t, last, low_t, low, high_t, high)


def keep_up(connection: Connection, vehicle: int, new: dict[int, list[Point]]) -> None:
    """Bring all cells up to date with samples that have just been written.

    Parameters
    ----------
    connection
        In the transaction that wrote them.
    vehicle
        Its number.
    new
        By channel, in order of time, no time twice.
    """
    for level in LEVELS:
        _keep_up(connection, vehicle, level, _placed(new, level.width_us))


def _placed(new: dict[int, list[Point]], width_us: int) -> dict[Place, list[Point]]:
    return {
        (channel, number): list(points)
        for channel, all_points in new.items()
        for number, points in groupby(all_points, lambda point: point[0] // width_us)
    }


def _keep_up(connection: Connection, vehicle: int, level: Level, new: dict[Place, list[Point]]) -> None:
    """Join what is added at a cell's end with what was there; make others from all their samples again."""
    known = _known(connection, vehicle, level.table, new)
    rows = []
    for place, points in new.items():
        old = known.get(place)
        if old is None:
            cell = cell_of(points)
        elif points[0][0] > old.last_t_us:
            cell = old.joined(cell_of(points))
        else:
            cell = cell_of(_all_points(connection, vehicle, place, level.width_us))
        rows.append((vehicle, *place, *cell))
    insert_rows(connection, level.table, tuple(level.table.c.keys()), rows, "replace")


def _known(connection: Connection, vehicle: int, table: Table, places: Iterable[Place]) -> dict[Place, Cell]:
    """The cells that are there already, at these places."""
    channels = sorted({channel for channel, _ in places})
    found: dict[Place, Cell] = {}
    for begin, end in _runs(sorted({number for _, number in places})):
        query = select(table).where(
            table.c.vehicle_id == vehicle, table.c.channel_id.in_(channels), table.c[2].between(begin, end)
        )
        for _, channel, number, *cell in connection.execute(query):
            found[channel, number] = Cell(*cell)
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


def _all_points(connection: Connection, vehicle: int, place: Place, width_us: int) -> list[Point]:
    channel, number = place
    query = (
        select(samples.c.t_us, samples.c.value)
        .where(
            samples.c.vehicle_id == vehicle,
            samples.c.channel_id == channel,
            samples.c.t_us >= number * width_us,
            samples.c.t_us < (number + 1) * width_us,
        )
        .order_by(samples.c.t_us)
    )
    return [(t_us, value) for t_us, value in connection.execute(query)]
