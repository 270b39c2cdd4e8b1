"""A mission so far: time, energy and way of the dives that are over, flown against predicted."""

from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

from stommel.plans.comparison import ComparedDive, Row, less, place_of, way_between


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


def so_far(rows: Iterable[ComparedDive]) -> SoFar | None:
    """Add up the dives of a comparison; None where none was both predicted and flown."""
    both = [(row.dive, row.predicted, row.flown) for row in rows if row.predicted is not None and row.flown is not None]
    if not both:
        return None
    pairs = [(predicted, flown) for _, predicted, flown in both]
    return SoFar(both[0][0], both[-1][0], _time(pairs), _sum(pairs, _energy), _sum(pairs, _way))


Pairs = Sequence[tuple[Row, Row]]


def _time(pairs: Pairs) -> Total | None:
    over = [pair for pair in pairs if all(row.get("t_end") is not None for row in pair)]
    if not over:
        return None
    predicted, flown = (
        float(last["t_end"]) - float(first["t_begin"]) for first, last in zip(pairs[0], over[-1], strict=True)
    )
    return Total(len(over), predicted, flown, flown - predicted)


def _sum(pairs: Pairs, tell: Callable[[Row], float | None]) -> Total | None:
    told = [(tell(predicted), tell(flown)) for predicted, flown in pairs]
    known = [(one, other) for one, other in told if one is not None and other is not None]
    if not known:
        return None
    predicted, flown = (sum(column) for column in zip(*known, strict=True))
    return Total(len(known), predicted, flown, flown - predicted)


def _energy(row: Row) -> float | None:
    return less(row.get("energy_j"), 0.0)


def _way(row: Row) -> float | None:
    return way_between(place_of(row, "begin"), place_of(row, "end"))
