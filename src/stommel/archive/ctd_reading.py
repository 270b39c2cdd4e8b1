"""Reading samples of the CTD as arrays, in pieces of bounded size, and how many there are, without reading them."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from sqlalchemy import Connection, func, select

from stommel.archive.archive import Archive
from stommel.archive.ctd_storing import HOUR_US
from stommel.archive.log_tables import ctd_hours
from stommel.archive.schema import ctd
from stommel.archive.times import seconds

PIECE = 100_000
"""Samples that are read at once."""
Array = NDArray[np.float64]


class CtdPiece(NamedTuple):
    """Samples in the order of time; what the instrument did not say is no number."""

    t_us: NDArray[np.int64]
    dive: Array
    pressure: Array
    """[dbar]"""
    temperature: Array
    """[degC]"""
    conductivity: Array
    """[S/m]"""

    @property
    def time(self) -> Array:
        """Times [s since 1970]."""
        return seconds(self.t_us)

    def since(self, first: int) -> "CtdPiece":
        """Those from one sample on."""
        return CtdPiece(self.t_us[first:], *(column[first:] for column in self[1:]))

    @staticmethod
    def joined(pieces: Sequence["CtdPiece"]) -> "CtdPiece":
        """Some, one after the other; at least one."""
        times, *columns = zip(*pieces, strict=True)
        return CtdPiece(np.concatenate(times), *(np.concatenate(column) for column in columns))


class Changes(NamedTuple):
    """What has changed of a vehicle's samples."""

    change: int
    """Number of the last of them."""
    first_us: int
    """Nothing before has changed."""
    end_us: int
    """Nothing from here on has."""


def changes_since(connection: Connection, vehicle: int, change: int) -> Changes | None:
    """What has changed since a number that was told before, 0 for all; None if nothing has."""
    of = ctd_hours.c
    query = select(func.max(of.change), func.min(of.hour), func.max(of.hour))
    found = connection.execute(query.where(of.vehicle_id == vehicle, of.change > change)).one()
    if found[0] is None:
        return None
    return Changes(int(found[0]), int(found[1]) * HOUR_US, (int(found[2]) + 1) * HOUR_US)


def count_between(connection: Connection, vehicle: int, first_us: int, last_us: int) -> int:
    """How many samples there are from one time to another [us], both included."""
    of, hours = ctd.c, ctd_hours.c
    begin, end = -(-first_us // HOUR_US), (last_us + 1) // HOUR_US
    edges = [(first_us, begin * HOUR_US - 1), (end * HOUR_US, last_us)]
    parts = [(first_us, last_us)] if begin >= end else edges
    total = 0
    for low, high in parts:
        if low <= high:
            query = select(func.count()).where(of.vehicle_id == vehicle, of.t_us.between(low, high))
            total += connection.execute(query).scalar_one()
    if begin < end:
        whole = select(func.sum(hours.count)).where(hours.vehicle_id == vehicle, hours.hour.between(begin, end - 1))
        total += int(connection.execute(whole).scalar() or 0)
    return total


def ctd_pieces(archive: Archive, vehicle: int, first_us: int, last_us: int, size: int = PIECE) -> Iterator[CtdPiece]:
    """Samples from one time to another [us], both included, in pieces of at most `size`; at least one piece.

    Each piece is read for itself: a reader who takes hours holds up nobody.
    """
    begin, is_first = first_us, True
    while True:
        piece = _piece(archive, vehicle, begin, last_us, size)
        if piece.t_us.size or is_first:
            yield piece
        if piece.t_us.size < size:
            return
        begin, is_first = int(piece.t_us[-1]) + 1, False


def _piece(archive: Archive, vehicle: int, first_us: int, last_us: int, size: int) -> CtdPiece:
    of = ctd.c
    query = (
        select(of.t_us, of.dive, of.pressure_dbar, of.temperature_degc, of.conductivity_s_m)
        .where(of.vehicle_id == vehicle, of.t_us.between(first_us, last_us))
        .order_by(of.t_us)
        .limit(size)
    )
    with archive.reading() as connection:
        rows = connection.execute(query).cursor.fetchall()  # plain tuples: a third of the time
    table = np.array(rows, dtype=np.float64).reshape(-1, 5)
    return CtdPiece(table[:, 0].astype(np.int64), *(table[:, k] for k in range(1, 5)))
