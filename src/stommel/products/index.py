"""The profiles of a vehicle by their times, kept up: only those samples are read that may change a profile."""

from collections.abc import Iterable, Iterator

import gsw
import numpy as np
from numpy.typing import NDArray

from stommel.archive.archive import Archive
from stommel.archive.ctd_reading import CtdPiece, changes_since, ctd_pieces
from stommel.archive.times import GREATEST_TIME
from stommel.data.profiles import ways_of
from stommel.data.summaries import ProfileSummary, of_known
from stommel.geometry.longitudes import mean_deg
from stommel.products.kept_profiles import Found, keep, kept
from stommel.products.positions import positions

LONGEST_WAY = 500_000
"""Samples without a turning point, over which nothing is joined: a vehicle that lies still for days."""
_END = round(GREATEST_TIME * 1e6)
Array = NDArray[np.float64]


class ProfileIndex:
    """Profiles of one vehicle; not for two threads at once."""

    def __init__(self, archive: Archive, vehicle: int) -> None:
        self._archive, self._vehicle = archive, vehicle
        self._found, self._change = kept(archive, vehicle)
        self._kept_change = self._change
        """Up to which change the archive keeps what is known here."""
        self._new_us = _END
        """From when on it does not."""
        self.read = 0
        """Samples that were read so far."""

    def profiles(self) -> list[Found]:
        """All of them, in the order of time, as the archive has them now.

        Raises
        ------
        ArchiveError
            It fails.
        """
        with self._archive.reading() as connection:
            changes = changes_since(connection, self._vehicle, self._change)
        if changes is not None:
            same, begin = self._before(changes.first_us)
            later = [found for found in self._found[len(same) :] if found.turned_us >= changes.end_us]
            self._found = [*same, *_counted(self._found_from(begin, later), len(same) + 1)]
            self._change = changes.change
            self._keep(same[-1].first_us + 1 if same else 0)
        return self._found

    def _keep(self, since_us: int) -> None:
        """Let the archive keep what is new; if it does not now, it will with the next change."""
        since_us = self._new_us = min(since_us, self._new_us)
        new = [found for found in self._found if found.first_us >= since_us]
        if keep(self._archive, self._vehicle, new, since_us, self._kept_change, self._change):
            self._kept_change, self._new_us = self._change, _END

    def _before(self, changed_us: int) -> tuple[list[Found], int]:
        """Profiles that stay as they are when nothing before a time has changed, and from when on to read."""
        same = [found for found in self._found if found.is_settled and found.last_us < changed_us]
        while same and not self._is_turned_after(len(same) - 1, changed_us):
            same.pop()
        return same, self._found[len(same)].turned_us if same else 0

    def _is_turned_after(self, place: int, changed_us: int) -> bool:
        """Whether the way of a profile, with what confirmed its end, lies before a time."""
        return place + 1 < len(self._found) and self._found[place + 1].last_us < changed_us

    def _found_from(self, begin: int, later: list[Found]) -> Iterator[Found]:
        """Profiles from a turning point on; from where one of the `later` ones is found again, those."""
        known = {(found.turned_us, found.first_us, found.last_us): k for k, found in enumerate(later)}
        rest: CtdPiece | None = None
        last: list[Found] = []
        for piece in ctd_pieces(self._archive, self._vehicle, begin, _END):
            self.read += piece.t_us.size
            whole = piece if rest is None else CtdPiece.joined([rest, piece])
            found, keep_from = self._in(whole)
            for each in found:
                place = known.get((each.turned_us, each.first_us, each.last_us))
                if each.is_settled and place is not None and later[place].is_settled:
                    yield from later[place:]
                    return
                if each.is_settled:
                    yield each
            last = [each for each in found if not each.is_settled]
            rest = whole.since(keep_from)
        yield from last

    def _in(self, piece: CtdPiece) -> tuple[list[Found], int]:
        """Profiles in samples, and the first sample that must be seen again with later ones."""
        time = piece.time
        ways = ways_of(time, piece.pressure)
        latitude, longitude = positions(self._archive, self._vehicle, time)
        depth = -gsw.z_from_p(piece.pressure, latitude)
        found = []
        for way in ways:
            first, last, direction = way.profile.first, way.profile.last, way.profile.direction
            inside = slice(first, last + 1)
            line = ProfileSummary(
                0, direction, float(time[first]), float(time[last]), last + 1 - first, _dive(piece.dive[first]),
                of_known(latitude[inside], np.mean), of_known(longitude[inside], mean_deg),
                of_known(depth[inside], np.min), of_known(depth[inside], np.max),
            )  # fmt: skip
            found.append(
                Found(int(piece.t_us[first]), int(piece.t_us[last]), int(piece.t_us[way.turned]), way.is_settled, line)
            )
        open_from = [way.turned for way in ways if not way.is_settled]
        settled = [way for way in ways if way.is_settled]
        keep_from = min(open_from) if open_from else settled[-1].profile.last if settled else 0
        if time.size - keep_from > LONGEST_WAY:
            return [each._replace(is_settled=True) for each in found], time.size
        return found, keep_from


def _counted(found: Iterable[Found], first: int) -> list[Found]:
    return [each._replace(line=each.line._replace(number=k)) for k, each in enumerate(found, first)]


def _dive(value: float) -> int | None:
    return int(value) if value > 0.0 else None
