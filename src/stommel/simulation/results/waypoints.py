"""Whether the waypoints were reached: when, missed by how much, how far to the next, and how each leg was flown.

What counts as reached is the software's own account, which goes by the position that it believes; how near the vehicle
came is the truth. Both follow from the record, so that the mission loop writes nothing more for them.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stommel.geometry.geodesics import Place, beside_line, distances, leg, line_length, offsets
from stommel.simulation.flight import Flown

Array = NDArray[np.float64]

SEVERAL = 3
"""A goal recedes when so many surfacings after each other are each farther from it than the one before."""
LEAST_GROWTH = 100.0
"""In all by so much at least [m]: less is noise of the positions."""

_NONE = -1
"""No waypoint was sought any more."""


@dataclass(frozen=True)
class Leg:
    """How the way to a waypoint was flown, in the time in which it was sought."""

    length_m: float
    """From the waypoint before, or from the start."""
    time_s: float
    over_ground_m: float
    made_good_m: float
    """By how much the waypoint came nearer."""
    beside_line_rms_m: float
    """Distance from the rhumb line between the waypoints, along which the vehicle steers; not a number for no line."""
    beside_line_greatest_m: float
    """The greatest, without its sign."""

    @property
    def made_good_m_s(self) -> float:
        """Speed at which the waypoint came nearer; zero where it took no time."""
        return self.made_good_m / self.time_s if self.time_s > 0.0 else 0.0


@dataclass(frozen=True)
class Waypoint:
    """A waypoint, and what became of it."""

    number: int
    """In the plan, from 1; with `repeat` they go on counting."""
    place: Place
    start: Place
    """Of its leg."""
    sought_from_s: float | None
    """Time of the mission; None: another was sought until the end."""
    reached_s: float | None
    """Time by the software's own account, to a row of the record; None: not reached."""
    closest_m: float | None
    """The nearest that the vehicle truly came while it sought this waypoint."""
    to_go_m: float
    """True distance when it was reached, or at the end of the mission."""
    flown: Leg | None
    """None: never sought."""


@dataclass(frozen=True)
class Receding:
    """A stretch of surfacings on which a waypoint only went farther away: the current was stronger."""

    number: int
    since_s: float
    """Time of the nearest of these surfacings."""
    named_s: float
    """Time of the surfacing at which it is sure."""
    until_s: float
    growth_m: float


@dataclass(frozen=True)
class Waypoints:
    """The waypoints of a mission, and what became of them."""

    radius_m: float
    planned: int
    """Waypoints of the plan."""
    repeats: bool
    all: tuple[Waypoint, ...]
    """Of the plan; with `repeat` those that were reached, and the one after them."""
    receding: tuple[Receding, ...]
    sought: NDArray[np.int64]
    """Index in `all` of the waypoint that each row of the record sought; -1: none."""
    distance_m: Array
    """True distance from it; not a number where none was sought."""

    @property
    def reached(self) -> int:
        """How many were reached."""
        return sum(waypoint.reached_s is not None for waypoint in self.all)

    @property
    def next(self) -> Waypoint | None:
        """The one that was sought at the end."""
        return next((waypoint for waypoint in self.all if waypoint.reached_s is None), None)

    @property
    def swept_away(self) -> bool:
        """Whether the one sought at the end went farther and farther away until the last surfacing."""
        return bool(self.receding) and self.next is not None and self.receding[-1].until_s == np.inf

    def missed_by(self, waypoint: Waypoint) -> float | None:
        """How far outside the radius the nearest approach stayed [m]; None: never sought."""
        return None if waypoint.closest_m is None else max(0.0, waypoint.closest_m - self.radius_m)


def waypoints_of(flown: Flown) -> Waypoints:
    """Find out what became of the waypoints of a flown mission."""
    plan = flown.mission.scenario
    track = _Track.of(flown.record)
    places = _sought_places(flown)
    radius, count = plan.guidance.acceptance_radius_m, flown.waypoints_reached
    starts = [Place(plan.start.latitude_deg, plan.start.longitude_deg), *places][: len(places)]
    found: list[Waypoint] = []
    sought, distance = np.full(len(track.time), _NONE), np.full(len(track.time), np.nan)
    first = 0
    for k, (place, start) in enumerate(zip(places, starts, strict=True)):
        if k > count or not len(track.time):
            found.append(Waypoint(k + 1, place, start, None, None, None, _to_go(track, place), None))
            continue
        last = track.reached(first, place, radius) if k < count else len(track.time) - 1
        found.append(_waypoint(track, k + 1, place, start, (first, last), k < count))
        sought[first : last + 1] = k
        distance[first : last + 1] = distances(*track.true(first, last), *place)
        first = last
    receding = tuple(_receding(flown.surfacings, found))
    return Waypoints(radius, len(plan.waypoints), plan.guidance.repeat, tuple(found), receding, sought, distance)


@dataclass(frozen=True)
class _Track:
    """Where the vehicle was and where it believed itself, in degrees."""

    time: Array
    latitude: Array
    longitude: Array
    believed_latitude: Array
    believed_longitude: Array

    @classmethod
    def of(cls, record: NDArray[np.void]) -> "_Track":
        names = ("latitude", "longitude", "reckoned_latitude", "reckoned_longitude")
        return cls(np.ascontiguousarray(record["time"]), *(np.degrees(record[name]) for name in names))

    def true(self, first: int, last: int) -> tuple[Array, Array]:
        return self.latitude[first : last + 1], self.longitude[first : last + 1]

    def reached(self, first: int, place: Place, radius: float) -> int:
        """Row at which the software took a place as reached, from row `first` on.

        It looks every ten seconds. Where the rows are farther apart they may miss its moment: then the nearest row.
        """
        away = distances(self.believed_latitude[first:], self.believed_longitude[first:], *place)
        within = np.flatnonzero(away <= radius)
        return first + int(within[0] if len(within) else np.argmin(away))


def _sought_places(flown: Flown) -> list[Place]:
    """Waypoints of the plan; with `repeat` those that were reached and the one after them."""
    plan = flown.mission.scenario
    places = [Place(place.latitude_deg, place.longitude_deg) for place in plan.waypoints]
    if not (plan.guidance.repeat and places):
        return places
    laps = flown.waypoints_reached // len(places) + 1
    return (places * laps)[: flown.waypoints_reached + 1]


def _to_go(track: _Track, place: Place) -> float:
    if not len(track.time):
        return float("nan")
    return leg(track.latitude[-1], track.longitude[-1], *place).distance_m


def _waypoint(track: _Track, number: int, place: Place, start: Place, rows: tuple[int, int], reached: bool) -> Waypoint:
    first, last = rows
    latitude, longitude = track.true(first, last)
    east, north = offsets(latitude, longitude, *place)
    away, beside = np.hypot(east, north), beside_line(latitude, longitude, start, place)
    flown = Leg(
        length_m=leg(*start, *place).distance_m,
        time_s=float(track.time[last] - track.time[first]),
        over_ground_m=line_length(latitude, longitude),
        made_good_m=float(away[0] - away[-1]),
        beside_line_rms_m=float(np.sqrt(np.mean(beside**2))),
        beside_line_greatest_m=float(np.abs(beside).max()),
    )
    when = float(track.time[last]) if reached else None
    return Waypoint(number, place, start, float(track.time[first]), when, _nearest(east, north), float(away[-1]), flown)


def _nearest(east: Array, north: Array) -> float:
    """Least distance from the origin of the straight pieces between places, which rows far apart pass by."""
    if len(east) == 1:
        return float(np.hypot(east[0], north[0]))
    de, dn = np.diff(east), np.diff(north)
    length = np.maximum(de**2 + dn**2, 1e-12)
    share = np.clip(-(east[:-1] * de + north[:-1] * dn) / length, 0.0, 1.0)
    return float(np.hypot(east[:-1] + share * de, north[:-1] + share * dn).min())


def _receding(surfacings: NDArray[np.void], waypoints: Sequence[Waypoint]) -> Iterator[Receding]:
    """Stretches of surfacings, each farther from the waypoint that was sought than the one before."""
    time = surfacings["time"]
    for waypoint in waypoints:
        if waypoint.sought_from_s is None:
            continue
        end = np.inf if waypoint.reached_s is None else waypoint.reached_s
        part = surfacings[(time >= waypoint.sought_from_s) & (time <= end)]
        away = distances(np.degrees(part["latitude"]), np.degrees(part["longitude"]), *waypoint.place)
        for low, high in _rises(away):
            if high - low >= SEVERAL and away[high] - away[low] >= LEAST_GROWTH:
                until = np.inf if end == np.inf and high == len(part) - 1 else float(part["time"][high])
                named = float(part["time"][low + SEVERAL])
                growth = float(away[high] - away[low])
                yield Receding(waypoint.number, float(part["time"][low]), named, until, growth)


def _rises(curve: Array) -> Iterator[tuple[int, int]]:
    """First and last index of every stretch on which a curve only rises."""
    up = np.concatenate([[False], np.diff(curve) > 0.0, [False]])
    edges = np.flatnonzero(np.diff(up.astype(int)))
    yield from ((int(low), int(high)) for low, high in edges.reshape(-1, 2))


def as_rows(waypoints: Waypoints, start: float) -> list[dict[str, Any]]:
    """The waypoints for JSON; `start` of the mission [s since 1970-01-01 UTC]."""
    return [_row(waypoints, waypoint, start) for waypoint in waypoints.all]


def _row(waypoints: Waypoints, waypoint: Waypoint, start: float) -> dict[str, Any]:
    flown, reached = waypoint.flown, waypoint.reached_s
    row: dict[str, Any] = {
        "number": waypoint.number,
        "latitude_deg": waypoint.place.latitude_deg,
        "longitude_deg": waypoint.place.longitude_deg,
        "reached": reached is not None,
        "reached_utc": None if reached is None else utc(start + reached),
        "reached_after_hours": None if reached is None else reached / 3600.0,
        "closest_m": waypoint.closest_m,
        "missed_by_m": waypoints.missed_by(waypoint),
        "distance_at_end_m": waypoint.to_go_m if reached is None and np.isfinite(waypoint.to_go_m) else None,
    }
    if flown is None:
        return row | dict.fromkeys(_OF_LEG)
    numbers = (
        flown.length_m / 1e3, flown.time_s / 3600.0, flown.over_ground_m / 1e3, flown.made_good_m / 1e3,
        flown.made_good_m_s, flown.beside_line_rms_m, flown.beside_line_greatest_m,
    )  # fmt: skip
    return row | {key: value if np.isfinite(value) else None for key, value in zip(_OF_LEG, numbers, strict=True)}


_OF_LEG = (
    "leg_length_km", "leg_time_hours", "leg_over_ground_km", "leg_made_good_km", "leg_made_good_m_s",
    "beside_line_rms_m", "beside_line_greatest_m",
)  # fmt: skip


def utc(seconds: float) -> str:
    """A time [s since 1970-01-01 UTC] as 2026-07-01T12:00:00Z."""
    moment = np.datetime64(round(seconds), "s")
    return f"{moment}Z"
