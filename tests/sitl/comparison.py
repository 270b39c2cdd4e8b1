"""The same mission in the loop and in the fast simulator: how far their dives are apart."""

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from stommel.control.dive_cycle import DESCENT, SURFACE
from stommel.simulation.flight import Flown
from stommel.simulation.scenario.loading import load_mission
from stommel.simulation.scenario.mission import Mission
from stommel.simulation.scenario.shipped import mission_path

EARTH_RADIUS = 6_371_000.0
WITHOUT_ERRORS = {
    "attitude_noise_deg": 0.0, "heading_noise_deg": 0.0, "pressure_noise_m": 0.0, "gps_noise_m": 0.0,
    "altimeter_noise_m": 0.0, "voltage_noise_v": 0.0, "current_noise_a": 0.0, "internal_pressure_noise_pa": 0.0,
}  # fmt: skip


class Apart(NamedTuple):
    """Differences between two flights of a mission."""

    dives: tuple[int, int]
    """That each has begun."""
    period: float
    """Greatest relative difference of a dive's period."""
    depth: float
    """Greatest difference of a dive's greatest depth [m]."""
    place: float
    """Greatest distance of two surfacings, as a share of the distance made good since the first dive began."""


def mission_of(name: str, seconds: float, *, errors: bool = False) -> Mission:
    """A shipped mission of another length, its sensors without errors."""
    mission = load_mission(mission_path(name))
    changes: dict[str, Any] = {"duration_days": seconds / 86400.0}
    if not errors:
        changes["sensors"] = mission.scenario.sensors.model_copy(update=WITHOUT_ERRORS)
    return replace(mission, scenario=mission.scenario.model_copy(update=changes))


def apart(fast: Flown, loop: Flown) -> Apart:
    """Compare dive by dive; the loop starts later, because it checks itself first."""
    begun = [flown.events[flown.events["phase"] == DESCENT] for flown in (fast, loop)]
    whole = min(len(one) for one in begun) - 1
    periods = [np.diff(one["time"][: whole + 1]) for one in begun]
    depths = [
        np.array([_deepest(flown, one["time"][k], one["time"][k + 1]) for k in range(whole)])
        for flown, one in zip((fast, loop), begun, strict=True)
    ]
    ways = [_ways(flown, one)[:whole] for flown, one in zip((fast, loop), begun, strict=True)]
    made_good = np.hypot(*ways[0].T)
    return Apart(
        (len(begun[0]), len(begun[1])),
        float(np.max(np.abs(periods[1] / periods[0] - 1.0))),
        float(np.max(np.abs(depths[1] - depths[0]))),
        float(np.max(np.hypot(*(ways[1] - ways[0]).T) / made_good)),
    )


def _deepest(flown: Flown, first: float, last: float) -> float:
    within = (flown.record["time"] >= first) & (flown.record["time"] < last)
    return float(flown.record["depth"][within].max())


def _ways(flown: Flown, begun: np.ndarray) -> np.ndarray:
    """North and east of each surfacing after the first dive began, from where that was [m]."""
    start = begun[0]
    surfaced = flown.events[(flown.events["phase"] == SURFACE) & (flown.events["time"] > start["time"])]
    north = surfaced["latitude"] - start["latitude"]
    east = (surfaced["longitude"] - start["longitude"]) * np.cos(start["latitude"])
    return EARTH_RADIUS * np.stack([north, east], axis=-1)
