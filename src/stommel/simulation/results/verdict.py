"""Whether the waypoints were reached, in one sentence that fits a line of a terminal."""

from stommel.files.units import counted
from stommel.simulation.results.waypoints import Waypoint, Waypoints, utc

_NEARER = 0.9
"""Whoever has been nearer than this share of the distance at the end has missed the waypoint."""


def verdict(waypoints: Waypoints, start: float, outcome: str) -> str:
    """Say whether the waypoints were reached; `start` of the mission [s since 1970-01-01 UTC]."""
    if not waypoints.planned:
        return f"No waypoints to reach: {outcome}"
    goal = waypoints.next
    if goal is None:
        return f"{_all(waypoints.planned)} on {_when(waypoints.all[-1], start)}"
    if waypoints.planned == 1 and not waypoints.repeats:
        return f"Waypoint not reached, {_distance(waypoints, goal)}: {outcome}"
    lap, in_plan = divmod(goal.number - 1, waypoints.planned)
    away = f"number {in_plan + 1} {_distance(waypoints, goal)}: {outcome}"
    if waypoints.repeats:
        return f"{counted(waypoints.reached, 'waypoint')} reached, in lap {lap + 1} {away}"
    return f"{waypoints.reached} of {counted(waypoints.planned, 'waypoint')} reached, {away}"


def _all(planned: int) -> str:
    return "Waypoint reached" if planned == 1 else f"All {planned} waypoints reached, the last"


def _when(waypoint: Waypoint, start: float) -> str:
    assert waypoint.reached_s is not None
    moment = utc(start + waypoint.reached_s)
    return f"{moment[:10]} {moment[11:16]} UTC, after {duration(waypoint.reached_s / 86400.0)}"


def _distance(waypoints: Waypoints, goal: Waypoint) -> str:
    """How far it is still, and how near the vehicle has been where it was much nearer."""
    away = length(goal.to_go_m)
    if waypoints.swept_away:
        away = f"swept away, {away} off"
    else:
        away = f"{away} to go" if waypoints.planned == 1 else f"is {away} away"
    missed = waypoints.missed_by(goal)
    passed = missed is not None and goal.closest_m is not None and goal.closest_m < _NEARER * goal.to_go_m
    return f"{away} (missed by {length(missed or 0.0)})" if passed else away


def duration(days: float) -> str:
    """A time in the unit that reads well."""
    if days < 0.1:
        return counted(f"{days * 1440.0:.3g}", "minute")
    return counted(f"{days * 24.0:.3g}", "hour") if days < 2.0 else counted(f"{days:.4g}", "day")


def length(metres: float) -> str:
    """A distance in the unit that reads well."""
    return f"{metres:.0f} m" if abs(metres) < 3000.0 else f"{metres / 1e3:.1f} km"
