"""What stands beside the curves of a mission's page: the outcome in numbers, and the waypoints as a table."""

from collections.abc import Iterator, Sequence
from html import escape

import numpy as np
import xarray as xr

from stommel.geometry.geodesics import line_length
from stommel.simulation.pictures.extracts import dives_in, values
from stommel.simulation.results.energy import DRAINS
from stommel.simulation.results.verdict import duration, length

_WATT_HOUR = 3600.0
_SHOWN = 12
"""Waypoints in the table; of more the first."""


def facts_table(dataset: xr.Dataset) -> str:
    """Outcome, time, depth, way and energy as rows of HTML."""
    return _table([], _facts(dataset))


def _facts(dataset: xr.Dataset) -> Iterator[tuple[str, str]]:
    first, last = (moment(dataset["time"].values[k]) for k in (0, -1))
    latitude, longitude = values(dataset, "latitude"), values(dataset, "longitude")
    days = float((dataset["time"].values[-1] - dataset["time"].values[0]) / np.timedelta64(1, "s")) / 86400.0
    yield "Outcome", str(dataset.attrs["outcome"])
    yield "Time, UTC", f"{first} to {last}, {duration(days)}"
    yield "Dives", f"{dives_in(dataset)}, deepest {values(dataset, 'depth').max():.1f} m"
    made_good = line_length(latitude[[0, -1]], longitude[[0, -1]])
    yield "Way", f"{length(line_length(latitude, longitude))} over ground, {length(made_good)} made good"
    stored = float(dataset.attrs["battery_energy_j"]) / _WATT_HOUR
    if np.isfinite(stored):
        used = sum(values(dataset, f"energy_{name}")[-1] for name in DRAINS) / _WATT_HOUR
        yield "Battery", f"{used:.2f} of {stored:.1f} Wh used, {max(0.0, 1.0 - used / stored):.0%} left"


def moment(time: np.datetime64) -> str:
    """A time to the minute, as 2026-07-01 00:00."""
    return str(np.datetime_as_string(time, unit="m")).replace("T", " ")


def waypoint_table(dataset: xr.Dataset) -> str:
    """Waypoints with when they were reached, how near the vehicle came, and how far it is; nothing where none is."""
    count = dataset.sizes["waypoint"]
    if not count:
        return ""
    rows = [_waypoint(dataset, k) for k in range(min(count, _SHOWN))]
    more = f"<p>and {count - _SHOWN} more; the NetCDF file has all</p>" if count > _SHOWN else ""
    radius = length(float(dataset["acceptance_radius"]))
    title = f"<h2>Waypoints, radius {escape(radius)}</h2>"
    return title + _table(["", "reached, UTC", "nearest", "to go"], rows) + more


def _waypoint(dataset: xr.Dataset, k: int) -> tuple[str, str, str, str]:
    after, nearest, away = (
        float(dataset[name].values[k])
        for name in ("waypoint_reached_after", "waypoint_closest_approach", "waypoint_distance")
    )
    reached = np.isfinite(after)
    when = moment(dataset["time"].values[0] + np.timedelta64(round(after), "s")) if reached else "no"
    return str(k + 1), when, length(nearest) if np.isfinite(nearest) else "–", "–" if reached else length(away)


def _table(columns: Sequence[str], rows: "Iterator[tuple[str, ...]] | list[tuple[str, str, str, str]]") -> str:
    head = "".join(f"<th>{escape(name)}</th>" for name in columns)
    body = "".join(f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in rows)
    return f"<table>{f'<thead><tr>{head}</tr></thead>' if head else ''}<tbody>{body}</tbody></table>"
