"""The dives of a flight, as the archive keeps those of a vehicle."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.control.dive_cycle import ASCENT, DESCENT, DRIFT, INFLECTION
from stommel.simulation.flight import Flown
from stommel.simulation.results.energy import energy_of
from stommel.simulation.results.events import dives_begun

Array = NDArray[np.float64]

_UNDER_WATER = (DESCENT, DRIFT, INFLECTION, ASCENT)


class FlownDive(NamedTuple):
    """One dive; times in seconds since 1970 UTC, places in degrees."""

    dive: int
    """From 1."""
    t_begin: float
    t_end: float
    latitude_begin: float
    longitude_begin: float
    latitude_end: float
    longitude_end: float
    greatest_depth_m: float
    current_north_m_s: float | None
    """Depth-averaged, as the vehicle found it at the surface; none for a dive without a surfacing of its own."""
    current_east_m_s: float | None
    energy_j: float | None
    """From its beginning to that of the next; none where the vehicle's file does not tell energy."""


class _Curves(NamedTuple):
    """Columns of the record, each in one piece: a dive looks at them often."""

    time: Array
    depth: Array
    spent: Array | None


def dives_of(flown: Flown) -> list[FlownDive]:
    """Every dive of a flight, in order."""
    begins = np.flatnonzero(dives_begun(flown.events["phase"], flown.events["reason"]))
    found = {int(row["dive"]): row for row in flown.surfacings}
    ends = [*begins[1:], len(flown.events)][: len(begins)]
    curves = _Curves(flown.record["time"].copy(), flown.record["depth"].copy(), energy_curve(flown))
    start = flown.mission.scenario.start_seconds
    return [
        _dive(number, flown.events[first : last + 1], flown.record[-1], curves, found.get(number), start)
        for number, (first, last) in enumerate(zip(begins, ends, strict=True), 1)
    ]


def _dive(
    number: int, events: NDArray[np.void], final: np.void, curves: _Curves, surfacing: np.void | None, start: float
) -> FlownDive:
    """One dive by its events, of which the first begins it; those of the next dive, if there is one, end it."""
    begin, later = events[0], events[1:]
    above = later[~np.isin(later["phase"], _UNDER_WATER)]
    end = above[0] if len(above) else later[-1] if len(later) else final
    until = float(later[-1]["time"]) if len(later) else float(curves.time[-1])
    rows = slice(*np.searchsorted(curves.time, (begin["time"], end["time"])))
    deepest = max(float(begin["depth"]), *(float(row["depth"]) for row in later), *curves.depth[rows].tolist(), 0.0)
    used = None if curves.spent is None else np.diff(np.interp((begin["time"], until), curves.time, curves.spent))
    return FlownDive(
        dive=number,
        t_begin=start + float(begin["time"]),
        t_end=start + float(end["time"]),
        latitude_begin=float(np.degrees(begin["latitude"])),
        longitude_begin=float(np.degrees(begin["longitude"])),
        latitude_end=float(np.degrees(end["latitude"])),
        longitude_end=float(np.degrees(end["longitude"])),
        greatest_depth_m=deepest,
        current_north_m_s=None if surfacing is None else float(surfacing["current_north"]),
        current_east_m_s=None if surfacing is None else float(surfacing["current_east"]),
        energy_j=None if used is None else float(used[0]),
    )


def energy_curve(flown: Flown) -> Array | None:
    """Energy that has left the battery by each row of the record [J]; None where it is not known."""
    if not np.isfinite(flown.plant.battery.energy):
        return None
    total: Array = np.sum(list(energy_of(flown).values()), axis=0)
    return total
