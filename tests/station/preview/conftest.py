"""A station with the simulator behind it, one process for all tests of a module, and a vehicle 1 of the model zju."""

from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import httpx
import pytest

from stommel.station.preview.previews import Previews
from stommel.station.web.app import create_app
from tests.support.station_served import StandInStation, served

NOW = 1_782_864_000.0
"""2026-07-01T00:00:00Z."""


class PlanningStation(StandInStation):
    """Vehicle 1 lies on the shelf of the East China Sea."""

    def __init__(self, folder: Path, previews: Previews) -> None:
        super().__init__(folder)
        self.previews = previews
        self.vehicles = {1: SimpleNamespace(vehicle=1, settings=SimpleNamespace(model="zju"))}
        self.archive.know(1, "Petrel", "zju")
        self.position: dict[str, float] | None = {"latitude": 28.70, "longitude": 126.10}

    def summary(self, vehicle: int) -> dict[str, Any]:
        return {"vehicle": vehicle, "position": self.position}

    def now(self, vehicle: int | None = None) -> float:
        del vehicle
        return NOW


@pytest.fixture(scope="module")
def previews() -> Iterator[Previews]:
    found = Previews()
    yield found
    found.close()


@pytest.fixture
def station(tmp_path: Path, previews: Previews) -> Iterator[PlanningStation]:
    station = PlanningStation(tmp_path, previews)
    yield station
    station.close()


@pytest.fixture
def client(station: PlanningStation) -> Iterator[httpx.Client]:
    with served(create_app(station)) as address, httpx.Client(base_url=address, timeout=120.0) as client:
        yield client
