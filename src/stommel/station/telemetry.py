"""Telemetry as a CF trajectory: channels side by side at the times of all of them, a piece at a time."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stommel.archive.archive import Archive
from stommel.archive.sample_pieces import PIECE, SamplePiece, sample_pieces
from stommel.archive.times import seconds
from stommel.data.files import TIME
from stommel.data.variables import BY_NAME
from stommel.products.positions import positions
from stommel.products.samples import trajectory
from stommel.station.channels import channel_named

ROWS = 16_384
"""Times of a piece."""
_UNITS: Mapping[str, str] = {
    "": "1", "deg": "degree", "degC": "degree_Celsius", "m/s": "m s-1", "S/m": "S m-1", "B": "byte", "B/s": "byte s-1",
}  # fmt: skip
"""As UDUNITS names what people write otherwise."""
_PLACE = ("latitude", "longitude")


def telemetry_pieces(
    archive: Archive, vehicle: int, keys: Sequence[str], begin: float, end: float, size: int = PIECE
) -> Iterator[xr.Dataset]:
    """Samples from `begin` to `end` [s since 1970] as data sets along `obs`, at least one; the first may be empty.

    Each channel is a variable, no number at times that it has no sample of.
    """
    sources = [sample_pieces(archive, vehicle, [key], begin, end, size) for key in keys]
    is_first = True
    for t_us, values in _side_by_side(sources):
        yield _dataset(archive, vehicle, keys, t_us, values)
        is_first = False
    if is_first:
        yield _dataset(archive, vehicle, keys, np.empty(0, np.int64), np.empty((len(keys), 0)))


class _Ahead:
    """The next samples of one channel."""

    def __init__(self, pieces: Iterator[SamplePiece]) -> None:
        self._pieces = pieces
        self.t_us = np.empty(0, np.int64)
        self.value = np.empty(0)
        self.read()

    def read(self) -> None:
        """Take the next piece where nothing is left of the one before."""
        if not self.t_us.size and (piece := next(self._pieces, None)) is not None:
            _, self.t_us, self.value = piece

    def taken(self, until_us: int) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
        """Those up to a time, which are left out from then on."""
        count = int(np.searchsorted(self.t_us, until_us, "right"))
        found = self.t_us[:count], self.value[:count]
        self.t_us, self.value = self.t_us[count:], self.value[count:]
        self.read()
        return found


def _side_by_side(sources: Sequence[Iterator[SamplePiece]]) -> Iterator[tuple[NDArray[np.int64], NDArray[np.float64]]]:
    """Times in order, and what each channel has at them; of each channel one piece is held."""
    ahead = [_Ahead(source) for source in sources]
    while known := [each.t_us[-1] for each in ahead if each.t_us.size]:
        parts = [each.taken(int(min(known))) for each in ahead]
        times = np.unique(np.concatenate([t_us for t_us, _ in parts]))
        for first in range(0, times.size, ROWS):
            rows = times[first : first + ROWS]
            table = np.full((len(parts), rows.size), np.nan)
            for column, (t_us, value) in zip(table, parts, strict=True):
                inside = slice(*np.searchsorted(t_us, (rows[0], rows[-1] + 1)))
                column[np.searchsorted(rows, t_us[inside])] = value[inside]
            yield rows, table


def _dataset(
    archive: Archive, vehicle: int, keys: Sequence[str], t_us: NDArray[np.int64], values: NDArray[np.float64]
) -> xr.Dataset:
    time = seconds(t_us)
    place = dict(zip(_PLACE, positions(archive, vehicle, time), strict=True))
    made = xr.Dataset(
        {name: ("obs", value, BY_NAME[name].attributes) for name, value in place.items()}
        | {"time": ("obs", time, TIME)}
        | {key: ("obs", column, _attributes(key)) for key, column in zip(keys, values, strict=True)}
    )
    return trajectory(archive, vehicle, made, "Telemetry")


def _attributes(key: str) -> dict[str, Any]:
    """What CF wants beside the values of a channel."""
    channel = channel_named(key)
    if channel is None:
        return {"long_name": key}
    found: dict[str, Any] = {"long_name": channel.words, "units": _UNITS.get(channel.unit, channel.unit)}
    if channel.standard_name and channel.standard_name not in _PLACE:  # the coordinates have these names
        found["standard_name"] = channel.standard_name
    if channel.standard_name == "depth":
        found["positive"] = "down"
    if channel.values:
        found["flag_values"] = np.array(list(channel.values), dtype=np.float64)
        found["flag_meanings"] = " ".join(words.replace(" ", "_") for words in channel.values.values())
    return found
