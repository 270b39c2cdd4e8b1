"""Every sample of some channels as arrays, in pieces of bounded size."""

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from sqlalchemy import select

from stommel.archive.archive import Archive
from stommel.archive.schema import channels, samples
from stommel.archive.times import microseconds

PIECE = 10_000
"""Samples that are read at once."""
_POINT = np.dtype([("t_us", np.int64), ("value", np.float64)])


class SamplePiece(NamedTuple):
    """Samples of one channel in the order of time."""

    key: str
    t_us: NDArray[np.int64]
    value: NDArray[np.float64]


def kept_channels(archive: Archive, vehicle: int) -> list[str]:
    """Keys of the channels of which a vehicle has samples, in their order."""
    of = samples.c
    any_sample = select(of.t_us).where(of.vehicle_id == vehicle, of.channel_id == channels.c.id).exists()
    with archive.reading() as connection:
        return list(connection.execute(select(channels.c.key).where(any_sample).order_by(channels.c.key)).scalars())


def sample_pieces(
    archive: Archive, vehicle: int, keys: Sequence[str], begin: float, end: float, size: int = PIECE
) -> Iterator[SamplePiece]:
    """The samples from `begin` to `end` [s since 1970], channel by channel as they are named, `size` at most at once.

    Each piece is read for itself: a reader who takes hours holds up nobody.
    """
    for key in keys:
        first, last = microseconds(begin), microseconds(end)
        while first <= last:
            piece = _piece(archive, vehicle, key, first, last, size)
            if piece.t_us.size:
                yield piece
            if piece.t_us.size < size:
                break
            first = int(piece.t_us[-1]) + 1


def _piece(archive: Archive, vehicle: int, key: str, first: int, last: int, size: int) -> SamplePiece:
    of = samples.c
    number = select(channels.c.id).where(channels.c.key == key).scalar_subquery()
    query = (
        select(of.t_us, of.value)
        .where(of.vehicle_id == vehicle, of.channel_id == number, of.t_us.between(first, last))
        .order_by(of.t_us)
        .limit(size)
    )
    with archive.reading() as connection:
        cursor: Any = connection.execute(query).cursor
        found = np.fromiter(cursor, _POINT)
    return SamplePiece(key, np.ascontiguousarray(found["t_us"]), np.ascontiguousarray(found["value"]))
