"""Short missions that several tests fly; compiled code is shared by the process."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest

from stommel.simulation.flight import Flown, fly_mission
from stommel.simulation.loading import mission_from
from stommel.simulation.mission import Mission
from stommel.simulation.results import dataset_of, netcdf_bytes

Document = dict[str, Any]

QUIET: Document = {
    "attitude_noise_deg": 0.0,
    "heading_noise_deg": 0.0,
    "pressure_noise_m": 0.0,
    "gps_noise_m": 0.0,
}
"""No noise."""


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


@pytest.fixture(scope="session")
def quarter_day() -> Flown:
    """The mission of `mission_document`, flown once."""
    return flown()


Fly = Callable[..., Flown]
