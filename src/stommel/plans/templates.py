"""Plans to begin with."""

from typing import Any, NamedTuple

from stommel.geometry.geodesics import Place, travel
from stommel.plans.expected_water import ocean_at, room_at

DEFAULT_START = Place(28.70, 126.10)
"""On the shelf of the East China Sea."""


class Template(NamedTuple):
    """A plan to begin with."""

    name: str
    words: str
    plan: dict[str, Any]


def templates(
    vehicle: str, start: Place | None, deepest: float, around: dict[str, Any] | None = None
) -> list[Template]:
    """Plans to begin with.

    Parameters
    ----------
    vehicle
        Name of the vehicle's file.
    start
        Where the vehicle is; None: it is not known.
    deepest
        That the vehicle may dive [m].
    around
        Other values of all of them, as the density in which the vehicle is neutral.
    """
    here = DEFAULT_START if start is None else start
    common = {"vehicle": vehicle, "start": place_row(here), "water": {"ocean": ocean_at(here)}} | (around or {})
    shelf, slope = (min(deepest, room_at(here, wanted)) for wanted in (70.0, 180.0))
    return [
        Template(name, words, common | plan)
        for name, words, plan in (
            _shelf_round(here, shelf), _section(here, slope), _long_and_frugal(here, slope), _stay_here(here, shelf),
        )
    ]  # fmt: skip


def _shelf_round(here: Place, depth: float) -> Template:
    return Template(
        "shelf round",
        f"Rounds of four waypoints on the shelf, dives to {depth:g} m, a short call after each.",
        {
            "name": "Rounds on the shelf",
            "duration_days": 2.0,
            "waypoints": [place_row(travel(*here, bearing, 4e3)) for bearing in (135.0, 225.0, 315.0, 45.0)],
            "guidance": {"acceptance_radius_m": 500.0, "repeat": True},
            "dives": {"depth_m": depth, "pitch_deg": 30.0, "speed_m_s": 0.5, "least_altitude_m": 10.0},
            "surface": {"session_s": 180.0},
        },
    )


def _section(here: Place, depth: float) -> Template:
    return Template(
        "section",
        f"A section of two legs, dives to {depth:g} m, a call after each.",
        {
            "name": "A section",
            "duration_days": 5.0,
            "waypoints": [place_row(travel(*here, bearing, 20e3)) for bearing in (90.0, 180.0)],
            "guidance": {"acceptance_radius_m": 1000.0},
            "dives": {"depth_m": depth, "pitch_deg": 35.0, "speed_m_s": 0.5, "least_altitude_m": 15.0},
            "surface": {"session_s": 240.0},
        },
    )


def _long_and_frugal(here: Place, depth: float) -> Template:
    dives = {"depth_m": depth, "pitch_deg": 40.0, "speed_m_s": 0.4, "least_altitude_m": 15.0, "per_surfacing": 100}
    return Template(
        "long and frugal",
        f"Weeks at sea: steep, slow dives to {depth:g} m, a call every six hours.",
        {
            "name": "Long and frugal",
            "duration_days": 20.0,
            "waypoints": [place_row(travel(*here, 90.0, 100e3))],
            "guidance": {"acceptance_radius_m": 2000.0},
            "dives": dives,
            "surface": {"session_s": 300.0, "every_hours": 6.0},
            "abort": {"battery_share": 0.1, "dive_hours": 12.0},
        },
    )


def _stay_here(here: Place, depth: float) -> Template:
    return Template(
        "stay here",
        f"Keep the place: to and fro over two kilometres, dives to {depth:g} m.",
        {
            "name": "Stay here",
            "duration_days": 3.0,
            "waypoints": [place_row(travel(*here, bearing, 1000.0)) for bearing in (0.0, 180.0)],
            "guidance": {"acceptance_radius_m": 300.0, "repeat": True},
            "dives": {"depth_m": depth, "pitch_deg": 30.0, "speed_m_s": 0.5, "least_altitude_m": 10.0},
            "surface": {"session_s": 180.0},
        },
    )


def place_row(place: Place) -> dict[str, float]:
    """A place as a plan has it."""
    return {"latitude_deg": round(place.latitude_deg, 5), "longitude_deg": round(place.longitude_deg, 5)}
