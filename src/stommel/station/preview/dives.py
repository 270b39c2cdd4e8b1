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


def dives_of(flown: Flown) -> list[FlownDive]:
    """Every dive of a flight, in order."""
    begins = np.flatnonzero(dives_begun(flown.events["phase"], flown.events["reason"]))
    currents = {int(row["dive"]): row for row in flown.surfacings}
    ends = [*begins[1:], len(flown.events)]
    spent = energy_curve(flown)
    return [
        _dive(flown, number, flown.events[first : last + 1], currents.get(number), spent)
        for number, (first, last) in enumerate(zip(begins, ends, strict=True), 1)
    ]


def _dive(
    flown: Flown, number: int, events: NDArray[np.void], surfacing: np.void | None, spent: Array | None
) -> FlownDive:
    """One dive by its events, of which the first begins it; those of the next dive, if there is one, end it."""
    record, start = flown.record, flown.mission.scenario.start_seconds
    begin, later = events[0], events[1:]
    above = later[~np.isin(later["phase"], _UNDER_WATER)]
    end = above[0] if len(above) else later[-1] if len(later) else record[-1]
    rows = slice(*np.searchsorted(record["time"], (begin["time"], end["time"])))
    depths = record["depth"][rows]
    until = later[-1]["time"] if len(later) else record["time"][-1]
    used = None if spent is None else np.diff(np.interp((begin["time"], until), record["time"], spent))
    return FlownDive(
        dive=number,
        t_begin=start + float(begin["time"]),
        t_end=start + float(end["time"]),
        latitude_begin=float(np.degrees(begin["latitude"])),
        longitude_begin=float(np.degrees(begin["longitude"])),
        latitude_end=float(np.degrees(end["latitude"])),
        longitude_end=float(np.degrees(end["longitude"])),
        greatest_depth_m=float(depths.max()) if len(depths) else float(begin["depth"]),
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
