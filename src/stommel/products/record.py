"""The record of a vehicle's samples, numbered once over its whole time; read in pieces, of what is asked for alone."""

from bisect import bisect_left, bisect_right
from collections import defaultdict
from collections.abc import Collection, Iterator, Sequence
from threading import Lock

import numpy as np
import xarray as xr

from stommel.archive.archive import Archive
from stommel.archive.ctd_reading import PIECE, CtdPiece, count_between, ctd_pieces
from stommel.archive.times import microseconds, seconds
from stommel.data.derived import DERIVED
from stommel.data.gridding import MOST_CELLS, joined, section
from stommel.data.profiles import with_numbers
from stommel.data.summaries import ProfileSummary
from stommel.geometry.geodesics import lengths_along
from stommel.products.index import ProfileIndex
from stommel.products.kept_profiles import Found
from stommel.products.samples import samples_of

MOST_COLUMNS = 800
"""Profiles of a section: more than a picture shows. Of more every second, third ... is taken."""
MOST_READ = 400_000
"""Samples of which those of a diagram are chosen; of more only every second, third ... profile is read."""


class SampleRecords:
    """Gives the samples of each vehicle; what is known of its profiles is kept, and only what is new is read."""

    def __init__(self, archive: Archive) -> None:
        self._archive = archive
        self._locks: defaultdict[int, Lock] = defaultdict(Lock)
        self._indices: dict[int, ProfileIndex] = {}

    def profiles(self, vehicle: int) -> list[Found]:
        """All profiles of a vehicle, in the order of time and of their numbers, from 1."""
        with self._locks[vehicle]:
            index = self._indices.get(vehicle)
            if index is None:
                index = self._indices[vehicle] = ProfileIndex(self._archive, vehicle)
            return index.profiles()

    def lines(self, vehicle: int, begin: float, end: float) -> list[ProfileSummary]:
        """Of the profiles that have samples between two times [s since 1970]."""
        return [found.line for found in self._touching(vehicle, microseconds(begin), microseconds(end))]

    def profile(self, vehicle: int, number: int) -> tuple[ProfileSummary, xr.Dataset] | None:
        """Line and samples of one profile; None if there is none of this number."""
        found = self.profiles(vehicle)
        if not 1 <= number <= len(found):
            return None
        one = found[number - 1]
        pieces = list(self._read(vehicle, one.first_us, one.last_us, [one], DERIVED))
        return one.line, xr.concat(pieces, "obs", combine_attrs="override") if len(pieces) > 1 else pieces[0]

    def pieces(self, vehicle: int, begin: float, end: float) -> Iterator[xr.Dataset]:
        """Samples between two times [s since 1970] with all that is derived; a bounded number at a time, at least one.

        The first may be empty.
        """
        first, last = microseconds(begin), microseconds(end)
        return self._read(vehicle, first, last, self._touching(vehicle, first, last), DERIVED)

    def count(self, vehicle: int, begin: float, end: float) -> int:
        """How many samples there are between two times [s since 1970]."""
        with self._archive.reading() as connection:
            return count_between(connection, vehicle, microseconds(begin), microseconds(end))

    def thinned(self, vehicle: int, begin: float, end: float, wanted: Collection[str]) -> Iterator[xr.Dataset]:
        """Samples between two times; where there are very many, those of every second, third ... profile."""
        first, last = microseconds(begin), microseconds(end)
        found = self._touching(vehicle, first, last)
        stride = max(1, -(-self.count(vehicle, begin, end) // MOST_READ))
        if stride == 1 or len(found) < stride:
            yield from self._read(vehicle, first, last, found, wanted)
            return
        for one in found[::stride]:
            yield from self._read(vehicle, max(first, one.first_us), min(last, one.last_us), [one], wanted)

    def section(self, vehicle: int, variable: str, begin: float, end: float, cell_m: float) -> tuple[xr.Dataset, int]:
        """A variable in cells of depth between two times [s since 1970], and of how many profiles one is shown.

        `distance` tells how far along the track each lies: through the mean positions of all profiles, shown or not.

        Raises
        ------
        ValueError
            The cell is out of range, or there would be more than `MOST_CELLS`.
        """
        first, last = microseconds(begin), microseconds(end)
        found = self._touching(vehicle, first, last)
        stride = max(1, -(-len(found) // MOST_COLUMNS))
        chosen = found[::stride]
        deepest = max((one.line.greatest_depth_m or 0.0 for one in chosen), default=0.0)
        if cell_m > 0.0 and len(chosen) * deepest / cell_m > MOST_CELLS:
            raise ValueError(
                f"{len(chosen)} profiles to {deepest:.0f} m: at most {MOST_CELLS} cells; take larger cells"
            )
        wanted = ["depth", variable]
        made = [
            section(samples, variable, cell_m=cell_m)
            for group in _groups(chosen)
            for samples in [self._of_group(vehicle, first, last, group, wanted, whole=stride == 1)]
        ]
        return _along_track(joined(made), found), stride

    def _of_group(
        self, vehicle: int, first: int, last: int, group: Sequence[Found], wanted: Collection[str], *, whole: bool
    ) -> xr.Dataset:
        """Samples of some profiles; neighbours are read at once."""
        if not group:
            spans = [(first, first - 1)]
        elif whole:
            spans = [(max(first, group[0].first_us), min(last, group[-1].last_us))]
        else:
            spans = [(max(first, one.first_us), min(last, one.last_us)) for one in group]
        read = [piece for span in spans for piece in ctd_pieces(self._archive, vehicle, *span)]
        return with_numbers(samples_of(self._archive, vehicle, CtdPiece.joined(read), wanted), _numbered(group))

    def _read(
        self, vehicle: int, first: int, last: int, found: Sequence[Found], wanted: Collection[str]
    ) -> Iterator[xr.Dataset]:
        begins = [one.first_us for one in found]
        ends = [one.last_us for one in found]
        for piece in ctd_pieces(self._archive, vehicle, first, last):
            samples = samples_of(self._archive, vehicle, piece, wanted)
            inside = slice(0, 0)
            if piece.t_us.size:
                inside = slice(bisect_left(ends, piece.t_us[0]), bisect_right(begins, piece.t_us[-1]))
            yield with_numbers(samples, _numbered(found[inside]))

    def _touching(self, vehicle: int, first: int, last: int) -> list[Found]:
        found = self.profiles(vehicle)
        begin = bisect_left(found, first, key=lambda one: one.last_us)
        return found[begin : bisect_right(found, last, key=lambda one: one.first_us)]


def _numbered(found: Sequence[Found]) -> list[tuple[int, int, float, float]]:
    return [(one.line.number, one.line.direction, seconds(one.first_us), seconds(one.last_us)) for one in found]


def _along_track(columns: xr.Dataset, found: Sequence[Found]) -> xr.Dataset:
    """Columns of a section with their distance along the track from the first of the profiles [m]."""
    places = np.array([(one.line.latitude, one.line.longitude) for one in found], dtype=np.float64).reshape(-1, 2)
    along = dict(zip((one.line.number for one in found), lengths_along(*places.T), strict=True))
    distance = [along[number] for number in columns["profile_number"].values.tolist()]
    about = {"long_name": "distance along the track", "units": "m"}
    return columns.assign(distance=("profile", np.array(distance, dtype=np.float64), about))


def _groups(found: Sequence[Found]) -> Iterator[Sequence[Found]]:
    """Neighbours of whose samples so many are held at once; at least one group."""
    begin = count = 0
    for place, one in enumerate(found):
        if count and count + one.line.samples > PIECE:
            yield found[begin:place]
            begin, count = place, 0
        count += one.line.samples
    yield found[begin:]
