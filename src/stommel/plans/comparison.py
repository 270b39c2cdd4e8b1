"""Planned against flown: the dives that the simulator predicted beside those that the vehicle reported."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from stommel.geometry.geodesics import leg

Row = Mapping[str, Any]
"""A dive, as the archive and a preview have it."""


class Difference(NamedTuple):
    """Flown less predicted; None where one of them is not known."""

    end_s: float | None
    """How much later the dive ended."""
    duration_s: float | None
    distance_m: float | None
    """Between the places where it ended."""
    depth_m: float | None
    energy_j: float | None


class ComparedDive(NamedTuple):
    """One dive of a mission, counted from its first."""

    dive: int
    predicted: Row | None
    flown: Row | None
    difference: Difference | None
    """None where there is only one of them."""


def compared(predicted: Sequence[Row], flown: Sequence[Row], begin: float) -> list[ComparedDive]:
    """Put dives side by side, by their numbers in the mission.

    Parameters
    ----------
    predicted
        Dives of a preview, in order.
    flown
        Dives of the vehicle, in order; those that began before the mission are left out. The number of the first that
        began in it is the mission's first, so that a dive that was never reported shifts no other.
    begin
        When the vehicle was told the mission [s since 1970].
    """
    mine = [row for row in flown if row["t_begin"] is not None and row["t_begin"] >= begin]
    before = int(mine[0]["dive"]) - 1 if mine else 0
    theirs = {int(row["dive"]): row for row in predicted}
    ours = {int(row["dive"]) - before: row for row in mine}
    return [
        ComparedDive(number, theirs.get(number), ours.get(number), _difference(theirs.get(number), ours.get(number)))
        for number in sorted({*theirs, *ours})
    ]


def _difference(predicted: Row | None, flown: Row | None) -> Difference | None:
    if predicted is None or flown is None:
        return None
    return Difference(
        end_s=_less(flown.get("t_end"), predicted.get("t_end")),
        duration_s=_less(_duration(flown), _duration(predicted)),
        distance_m=_apart(predicted, flown),
        depth_m=_less(flown.get("greatest_depth_m"), predicted.get("greatest_depth_m")),
        energy_j=_less(flown.get("energy_j"), predicted.get("energy_j")),
    )


def _apart(predicted: Row, flown: Row) -> float | None:
    """Distance between the places where both dives ended."""
    ends = [row.get(f"{name}_end") for row in (predicted, flown) for name in ("latitude", "longitude")]
    places = [float(value) for value in ends if value is not None]
    return leg(*places).distance_m if len(places) == len(ends) else None


def _duration(row: Row) -> float | None:
    return _less(row.get("t_end"), row.get("t_begin"))


def _less(one: float | None, other: float | None) -> float | None:
    return None if one is None or other is None else float(one) - float(other)
