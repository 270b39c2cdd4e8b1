"""Dives in the records of a log: from leaving the surface to the first decision at it."""

import math
from collections.abc import Callable
from typing import Any

from stommel.archive.logs.channels import Fields
from stommel.archive.rows import DiveRow

AFLOAT = ("surface", "recovery")
"""Phases of a vehicle that floats, by the words of the log."""
Dated = Callable[[float], float]


class DiveFinder:
    """Finds the dives of a file, of which the first may have begun in the file before.

    Parameters
    ----------
    phases
        Words of the phases by number, as the log describes them.
    dated
        Seconds since 1970 at a time of the log [s].
    """

    def __init__(self, phases: tuple[str, ...], dated: Dated) -> None:
        self._phases, self._dated = phases, dated
        self._afloat: bool | None = None
        self._dive: DiveRow | None = None
        """Under way, or the last, whose end is not all known."""
        self._before: DiveRow | None = None
        """The dive before the one under way, if this file has seen its end."""
        self._current: tuple[float, float] | None = None
        """By the last record of navigation."""
        self._place: Fields = {}
        """The last record of navigation."""
        self._used = self._used_before = math.nan
        """Energy by the last record of the battery, and before the dive [J]."""
        self._seeks_place = False
        """Whether the place of the dive's end is not known yet."""
        self.number: int | None = None
        """Of the dive, or the last one; None before the first decision."""
        self.found: dict[tuple[int, float], DiveRow] = {}
        """What is new of dives since it was emptied, by number and begin."""
        self.seen: set[tuple[int, float]] = set()
        """All of the file."""

    def decision(self, fields: Fields) -> None:
        """Take where in the dive cycle the vehicle is."""
        phase = int(fields["phase"])
        afloat = phase < len(self._phases) and self._phases[phase] in AFLOAT
        first = max(0, int(fields["dives"]) - int(fields["dives_here"]) + 1)
        if not afloat and self._afloat is not False and fields["submerged_since"] > 0.0:
            self._begin(first, fields, is_seen=self._afloat is True)
        elif afloat and self._afloat is False and self._dive is not None:
            energy = self._used - self._used_before
            self._told(t_end=self._dated(fields["t"]), energy_j=energy if math.isfinite(energy) else None)
            self._seeks_place = True
        self._afloat = afloat
        self.number = int(fields["dives"]) if afloat else first

    def _begin(self, number: int, fields: Fields, *, is_seen: bool) -> None:
        place = self._place
        if self._dive is not None and is_seen and place:
            self._seeks_place = False
        self._before = self._dive if is_seen else None
        self._dive = DiveRow(number, self._dated(fields["submerged_since"]))
        self._used_before = self._used if is_seen else math.nan
        if is_seen and place:
            self._told(latitude_begin=place["latitude"], longitude_begin=place["longitude"])
        else:
            self._told()

    def navigation(self, fields: Fields) -> None:
        """Take where the vehicle believes to be; what a position by GPS makes more certain is where the dive ended.

        The mean current of a dive is known when the vehicle leaves the surface after it: then it becomes another.
        """
        place = {name: math.degrees(fields[name]) for name in ("latitude", "longitude")} | {"sigma": fields["sigma"]}
        better = bool(self._place) and place["sigma"] < self._place["sigma"]
        if self._seeks_place and better:
            self._seeks_place = False
            self._told(latitude_end=place["latitude"], longitude_end=place["longitude"])
        self._place = place
        current = fields["current_north"], fields["current_east"]
        before, self._current = self._current, current
        if before not in (None, current) and self._before is not None and all(map(math.isfinite, current)):
            north, east = current
            self._note(self._before._replace(current_north_m_s=north, current_east_m_s=east))
            self._before = None

    def battery(self, fields: Fields) -> None:
        """Take what was used so far."""
        self._used = float(fields["energy_used"])

    def _told(self, **more: Any) -> None:
        assert self._dive is not None
        self._dive = self._dive._replace(**more)
        self._note(self._dive)

    def _note(self, dive: DiveRow) -> None:
        self.found[dive.dive, dive.t_begin] = dive
        self.seen.add((dive.dive, dive.t_begin))
