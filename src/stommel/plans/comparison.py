"""Planned against flown: the dives that the simulator predicted beside those that the vehicle reported."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from stommel.geometry.geodesics import Place, leg
from stommel.plans.predicted_track import PredictedTrack

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
    predicted_way_m: float | None
    flown_way_m: float | None
    """From where it began to where it ended, straight over ground."""
    off_track_m: float | None
    """How far the flown one ended from the nearest point of the predicted track; None where that is not known."""


def compared(
    predicted: Sequence[Row], flown: Sequence[Row], begin: float, track: PredictedTrack | None = None
) -> list[ComparedDive]:
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
    track
        The predicted one; None: it is not known.
    """
    mine = [row for row in flown if row["t_begin"] is not None and row["t_begin"] >= begin]
    before = int(mine[0]["dive"]) - 1 if mine else 0
    theirs = {int(row["dive"]): row for row in predicted}
    ours = {int(row["dive"]) - before: row for row in mine}
    numbers = sorted({*theirs, *ours})
    ends = [_place(ours.get(number), "end") for number in numbers]
    off = [None] * len(numbers) if track is None else track.off(ends)
    return [_row(number, theirs.get(number), ours.get(number), far) for number, far in zip(numbers, off, strict=True)]


def _row(number: int, predicted: Row | None, flown: Row | None, off_track_m: float | None) -> ComparedDive:
    difference = None if predicted is None or flown is None else _difference(predicted, flown)
    return ComparedDive(number, predicted, flown, difference, _way(predicted), _way(flown), off_track_m)


def _place(row: Row | None, side: str) -> Place | None:
    """Where a dive has its `begin` or `end`; None where that is not known."""
    if row is None or row.get(f"latitude_{side}") is None or row.get(f"longitude_{side}") is None:
        return None
    return Place(float(row[f"latitude_{side}"]), float(row[f"longitude_{side}"]))


def _distance(one: Place | None, other: Place | None) -> float | None:
    """Distance of two places [m]; None where one is not known."""
    return None if one is None or other is None else leg(*one, *other).distance_m


def _way(row: Row | None) -> float | None:
    return _distance(_place(row, "begin"), _place(row, "end"))


def _difference(predicted: Row, flown: Row) -> Difference:
    return Difference(
        end_s=_less(flown.get("t_end"), predicted.get("t_end")),
        duration_s=_less(_duration(flown), _duration(predicted)),
        distance_m=_distance(_place(predicted, "end"), _place(flown, "end")),
        depth_m=_less(flown.get("greatest_depth_m"), predicted.get("greatest_depth_m")),
        energy_j=_less(flown.get("energy_j"), predicted.get("energy_j")),
    )


def _duration(row: Row) -> float | None:
    return _less(row.get("t_end"), row.get("t_begin"))


def _less(one: float | None, other: float | None) -> float | None:
    """The first less the second; None where one is not known."""
    return None if one is None or other is None else float(one) - float(other)
