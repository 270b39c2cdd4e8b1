"""A station with one vehicle that is never heard, and whoever asks it."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from stommel.station.station import Station
from tests.station.client import Client
from tests.station.stations import station as running


@pytest.fixture
def station(tmp_path: Path) -> Iterator[Station]:
    with running(tmp_path, "tcp:127.0.0.1:9", start=False) as made:
        yield made


@pytest.fixture
def client(station: Station) -> Client:
    return Client(station)
