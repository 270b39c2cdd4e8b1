"""A station with vehicle 1, whose radio is silent, and the simulator behind it: its processes serve a whole module."""

from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

from stommel.plans.preview.previews import Previews
from stommel.station.station import Station
from stommel.station.web.app import create_app
from tests.station.stations import station as silent_station
from tests.support.station_served import served


@pytest.fixture(scope="module")
def previews() -> Iterator[Previews]:
    found = Previews()
    yield found
    found.close()


@pytest.fixture
def station(tmp_path: Path, previews: Previews) -> Iterator[Station]:
    with silent_station(tmp_path, "tcp:127.0.0.1:9", start=False) as station:
        station.previews = previews
        yield station


@pytest.fixture
def client(station: Station) -> Iterator[httpx.Client]:
    with served(create_app(station)) as address, httpx.Client(base_url=address, timeout=120.0) as client:
        yield client
