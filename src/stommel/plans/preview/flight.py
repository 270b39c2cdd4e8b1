"""A plan flown in the simulator, and what a page needs of the flight."""

from collections.abc import Callable, Mapping, Sequence
from math import ceil
from typing import Any

import numpy as np
from numpy.typing import NDArray
from tsdownsample import MinMaxDownsampler

from stommel.geometry.geodesics import offsets
from stommel.plans.plan import StationPlan
from stommel.plans.preview.dives import FlownDive, dives_of, energy_curve
from stommel.plans.preview.mission import mission_of
from stommel.plans.way import first_outside
from stommel.simulation.flight import Flown, fly_mission
from stommel.simulation.results.summary import summary

Array = NDArray[np.float64]

MOST_POINTS = 2000
"""Of a curve; at most twice as many after the reduction keeps both ends of each piece."""
MOST_DIVES = 2000
"""Listed; of more, every so many."""
_PATH_DIVES = 3
"""Shown as in Fig. 17."""
_COMPLETE = ("mission complete", "time over")
_ORDINARY = ("bottom ahead", "waypoint reached", "swept away")
"""Events that end no flight."""


def previewed(plan: StationPlan, progress: Callable[[float], None] | None = None) -> dict[str, Any]:
    """Fly a plan; `progress` is called with the share that is flown, and may raise to end it.

    Raises
    ------
    StommelError
        The plan is impossible, or the vehicle cannot fly the dives that it asks for.
    """
    flown = fly_mission(mission_of(plan), progress=progress)
    row, dives, track = summary(flown), dives_of(flown), _track(flown)
    left = first_outside(plan.geofence, track)
    return {
        "verdict": row["verdict"],
        "outcome": row["outcome"],
        "t_begin": flown.mission.scenario.start_seconds,
        "duration_s": row["days"] * 86400.0,
        "energy_j": None if row["energy_wh"] is None else 3600.0 * sum(row["energy_wh"].values()),
        "battery_left_share": row["battery_left_share"],
        "distance_m": 1e3 * row["distance_over_ground_km"],
        "surfacings": row["surfacings"],
        "dive_count": len(dives),
        "dives": [dive._asdict() for dive in _some(dives, MOST_DIVES)],
        "waypoints": _waypoints(row),
        "track": track,
        "series": _series(flown),
        "path": _path(flown, dives),
        "left_geofence": left,
        "warnings": _warnings(plan, flown, row, left),
    }


def _some(items: Sequence[FlownDive], most: int) -> Sequence[FlownDive]:
    return items[:: max(1, ceil(len(items) / most))]


def _waypoints(row: dict[str, Any]) -> list[dict[str, Any]]:
    keys = ("number", "reached", "reached_utc", "closest_m")
    return [{key: each[key] for key in keys} for each in row["waypoints"]]


def _track(flown: Flown) -> list[dict[str, float]]:
    record, start = flown.record, flown.mission.scenario.start_seconds
    rows = record[:: max(1, ceil(len(record) / MOST_POINTS))]
    if len(record) and rows[-1]["time"] != record[-1]["time"]:
        rows = np.append(rows, record[-1:])
    return [
        {
            "t": start + float(r["time"]),
            "lat": float(np.degrees(r["latitude"])),
            "lon": float(np.degrees(r["longitude"])),
        }
        for r in rows
    ]


def _series(flown: Flown) -> dict[str, list[float]]:
    """Curves over time; the same moments for all, chosen so that no dive loses its depth."""
    record, start = flown.record, flown.mission.scenario.start_seconds
    rows = record[_moments(record["depth"])]
    spent = energy_curve(flown)
    curves = {
        "t": start + rows["time"],
        "depth_m": rows["depth"],
        "pitch_deg": np.degrees(rows["pitch"]),
        "ballast_ml": 1e6 * rows["ballast"],
        "bottom_depth_m": rows["bottom_depth"],
    }
    if spent is not None:
        curves["energy_j"] = np.interp(rows["time"], record["time"], spent)
    return {name: np.round(curve, 6).tolist() for name, curve in curves.items()}


def _moments(depth: Array) -> NDArray[np.intp]:
    if len(depth) <= MOST_POINTS:
        return np.arange(len(depth))
    chosen = MinMaxDownsampler().downsample(  # type: ignore[no-untyped-call]
        np.ascontiguousarray(depth), n_out=MOST_POINTS
    )
    return np.unique(np.concatenate([[0], chosen.astype(np.intp), [len(depth) - 1]]))


def _path(flown: Flown, dives: list[FlownDive]) -> dict[str, list[float]]:
    """Depth over the way made good through the first dives, as in Fig. 17 of the paper."""
    if not dives:
        return {"distance_m": [], "depth_m": []}
    record, start = flown.record, flown.mission.scenario.start_seconds
    begin, end = (t - start for t in (dives[0].t_begin, dives[:_PATH_DIVES][-1].t_end))
    rows = record[slice(*np.searchsorted(record["time"], (begin, end)))]
    if not len(rows):
        return {"distance_m": [], "depth_m": []}
    latitude, longitude = np.degrees(rows["latitude"]), np.degrees(rows["longitude"])
    east, north = offsets(latitude, longitude, float(latitude[0]), float(longitude[0]))
    distance = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(east), np.diff(north)))])
    kept = _moments(rows["depth"])
    return {"distance_m": np.round(distance[kept], 2).tolist(), "depth_m": np.round(rows["depth"][kept], 3).tolist()}


def _warnings(plan: StationPlan, flown: Flown, row: dict[str, Any], left: Mapping[str, float] | None) -> list[str]:
    found = []
    if row["outcome"] not in _COMPLETE:
        why = "; ".join(name for name in row["events"] if name not in _ORDINARY)
        early = f"the flight ends early, after {row['days']:.3g} of {plan.duration_days:g} days: {row['outcome']}"
        found.append(f"{early} ({why})" if why else early)
    if row["swept_away"]:
        found.append("the current is stronger than the vehicle: a waypoint only went farther away")
    elif plan.waypoints and not plan.guidance.repeat and row["waypoints_reached"] < row["waypoints_planned"]:
        found.append(row["verdict"])
    if left is not None:
        hours = (left["t"] - flown.mission.scenario.start_seconds) / 3600.0
        found.append(f"the predicted track leaves the geofence after {hours:.1f} hours")
    return found
