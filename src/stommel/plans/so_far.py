"""A mission so far: time, energy and way of the dives that are over, flown against predicted."""

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from stommel.plans.comparison import ComparedDive, Row


class Total(NamedTuple):
    """A quantity of all dives of which it is known both as predicted and as flown."""

    dives: int
    predicted: float
    flown: float
    difference: float
    """Flown less predicted."""


class SoFar(NamedTuple):
    """Totals of the dives of a mission that were predicted and flown; None of what no dive tells."""

    first: int
    last: int
    """Numbers of these dives in the mission."""
    time_s: Total | None
    """From the begin of the first to the end of the last, with the time at the surface."""
    energy_j: Total | None
    distance_m: Total | None
    """Sum of the ways from begin to end of each dive, straight over ground."""


Pair = tuple[float | None, float | None]
"""A quantity of a dive, predicted and flown."""


def so_far(rows: Iterable[ComparedDive]) -> SoFar | None:
    """Add up the dives of a comparison; None where none was both predicted and flown."""
    both = [(row, row.predicted, row.flown) for row in rows if row.predicted is not None and row.flown is not None]
    if not both:
        return None
    return SoFar(
        both[0][0].dive,
        both[-1][0].dive,
        _time([(predicted, flown) for _, predicted, flown in both]),
        _sum((predicted.get("energy_j"), flown.get("energy_j")) for _, predicted, flown in both),
        _sum((row.predicted_way_m, row.flown_way_m) for row, _, _ in both),
    )


def _time(dives: Sequence[tuple[Row, Row]]) -> Total | None:
    over = [(one["t_end"], other["t_end"]) for one, other in dives if None not in (one["t_end"], other["t_end"])]
    if not over:
        return None
    predicted, flown = (float(end) - float(row["t_begin"]) for row, end in zip(dives[0], over[-1], strict=True))
    return Total(len(over), predicted, flown, flown - predicted)


def _sum(pairs: Iterable[Pair]) -> Total | None:
    known = [(one, other) for one, other in pairs if one is not None and other is not None]
    if not known:
        return None
    predicted, flown = (float(sum(column)) for column in zip(*known, strict=True))
    return Total(len(known), predicted, flown, flown - predicted)
