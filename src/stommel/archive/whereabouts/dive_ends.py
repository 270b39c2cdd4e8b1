"""The ends of dives, of those that can be true, and what lies between them."""

from typing import Any

import numpy as np

from stommel.archive.rows import DiveRow
from stommel.archive.whereabouts.sift import ANYWAY, CERTAIN, FASTEST, SIGMA, is_nowhere, metres_apart
from stommel.geometry.geodesics import Leg, leg


def with_true_ends(dive: DiveRow) -> DiveRow:
    """A dive without the ends at which the vehicle cannot have been: 0, 0, or further apart than it swims."""
    begin, end = (dive.latitude_begin, dive.longitude_begin), (dive.latitude_end, dive.longitude_end)
    wrong = {name for name, (a, b) in (("begin", begin), ("end", end)) if a is None or b is None or _is_nowhere(a, b)}
    if not wrong and dive.t_end is not None:
        ends = [np.array([value], dtype=np.float64) for value in (*begin, *end)]
        far = float(metres_apart(*ends)[0])
        if far > FASTEST * (dive.t_end - dive.t_begin) + ANYWAY + 2.0 * CERTAIN * SIGMA:
            wrong = {"begin", "end"}
    if "begin" in wrong:
        dive = dive._replace(latitude_begin=None, longitude_begin=None)
    return dive._replace(latitude_end=None, longitude_end=None) if "end" in wrong else dive


def made_good(dive: DiveRow) -> Leg | None:
    """Distance and course from where a dive began to where it ended; None where one of them is not known."""
    begin, end = (dive.latitude_begin, dive.longitude_begin), (dive.latitude_end, dive.longitude_end)
    if begin[0] is None or begin[1] is None or end[0] is None or end[1] is None:
        return None
    return leg(begin[0], begin[1], end[0], end[1])


def told_dive(dive: DiveRow) -> dict[str, Any]:
    """A dive as the station tells it: with `distance_m`, its way made good [m]."""
    way = made_good(dive)
    return dive._asdict() | {"distance_m": None if way is None else way.distance_m}


def _is_nowhere(latitude: float, longitude: float) -> bool:
    return bool(is_nowhere(np.array([latitude]), np.array([longitude]))[0])
