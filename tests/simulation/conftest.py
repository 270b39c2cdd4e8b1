"""Short missions that several tests fly; compiled code is shared by the process."""

from collections.abc import Callable, Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from stommel.control.dive_cycle import PHASES
from stommel.simulation.flight import Flown, fly_mission
from stommel.simulation.log import REASONS
from stommel.simulation.plant.parameters import CONSUMERS
from stommel.simulation.results.dataset import dataset_of, netcdf_bytes
from stommel.simulation.scenario.loading import mission_from
from stommel.simulation.scenario.mission import Mission

Document = dict[str, Any]

QUIET: Document = {
    "attitude_noise_deg": 0.0,
    "heading_noise_deg": 0.0,
    "pressure_noise_m": 0.0,
    "gps_noise_m": 0.0,
}
"""No noise."""

EXACT: Document = QUIET | {
    "altimeter_noise_m": 0.0,
    "voltage_noise_v": 0.0,
    "current_noise_a": 0.0,
    "internal_pressure_noise_pa": 0.0,
}
"""No noise of any sensor but the CTD."""

Array = NDArray[np.float64]


def mission_document(**changes: Any) -> Document:
    """A day of dives to 100 m in the stratified South China Sea, with other tables or numbers put in their places."""
    document: Document = {
        "name": "test",
        "vehicle": "zju",
        "start_time": "2026-07-01T00:00:00Z",
        "duration_days": 0.25,
        "seed": 1,
        "start": {"latitude_deg": 18.0, "longitude_deg": 116.0},
        "waypoints": [{"latitude_deg": 19.0, "longitude_deg": 117.0}],
        "dives": {"depth_m": 100.0, "pitch_deg": 35.0, "speed_m_s": 0.35},
        "ocean": {"name": "south_china_sea"},
    }
    return document | changes


def made(document: Mapping[str, Any]) -> Mission:
    return mission_from(document, "test.toml", Path())


def flown(**changes: Any) -> Flown:
    return fly_mission(made(mission_document(**changes)))


def file_of(result: Flown) -> bytes:
    return netcdf_bytes(dataset_of(result))


def column(result: Flown, name: str) -> Array:
    """One column of the record; `energy_pump` and its like are the account of one consumer."""
    if name.startswith("energy_"):
        return np.asarray(result.record["energy"][:, CONSUMERS.index(name.removeprefix("energy_"))])
    return np.asarray(result.record[name])


def sampled(result: Flown, name: str) -> Array:
    """One column of the CTD's samples."""
    return np.asarray(result.samples[name])


def surfaced(result: Flown, name: str) -> Array:
    """One column of the list of surfacings."""
    return np.asarray(result.surfacings[name])


def events(result: Flown) -> list[tuple[float, str, str]]:
    """Time [s], phase that began, and reason of every event."""
    rows = zip(*(result.events[name].tolist() for name in ("time", "phase", "reason")), strict=True)
    return [(t, PHASES[int(phase)], REASONS[int(reason)]) for t, phase, reason in rows]


def stays(result: Flown, phase: str) -> list[tuple[float, float]]:
    """Begin and end [s] of every completed stay in a phase; the mission begins at the surface."""
    changes = [(0.0, "surface"), *((t, name) for t, name, _ in events(result))]
    return [(t, then) for (t, name), (then, _) in pairwise(changes) if name == phase]


@pytest.fixture(scope="session")
def quarter_day() -> Flown:
    """The mission of `mission_document`, flown once."""
    return flown()


Fly = Callable[..., Flown]
