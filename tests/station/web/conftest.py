"""A station of the web door's own tests: on loopback, and one where people log in."""

from collections.abc import Iterator
from contextlib import closing
from functools import cache
from pathlib import Path

import httpx
import pytest

from stommel.station.people import passwords, users
from stommel.station.people.roles import Role
from stommel.station.station import Station
from stommel.station.web.app import create_app
from stommel.station.web.exposure import Exposure
from tests.station.stations import station as silent_station
from tests.support.station_served import PASSWORD, logged_in, served


@pytest.fixture
def station(tmp_path: Path) -> Iterator[Station]:
    """A station with vehicle 1, whose radio is silent."""
    with silent_station(tmp_path, "tcp:127.0.0.1:9", start=False, name="Pier 3") as station:
        yield station


@pytest.fixture
def local(station: Station) -> Iterator[httpx.Client]:
    """At the station's own machine: nobody logs in."""
    with served(create_app(station)) as address, httpx.Client(base_url=address, timeout=60.0) as client:
        yield client


@pytest.fixture(scope="module")
def quay(tmp_path_factory: pytest.TempPathFactory) -> Iterator[httpx.Client]:
    """As `local`, for the tests of a module that change nothing there: one station serves them all."""
    with (
        silent_station(tmp_path_factory.mktemp("quay"), "tcp:127.0.0.1:9", start=False, name="Pier 3") as station,
        served(create_app(station)) as address,
        httpx.Client(base_url=address, timeout=60.0) as client,
    ):
        yield client


_hashed_once = cache(passwords.hashed)
"""Argon2 takes its time, and four people have one password here."""


@pytest.fixture
def address(station: Station, monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """Where people log in: vera views, paul and pia fly, ada looks after the station."""
    monkeypatch.setattr(users, "hashed", _hashed_once)
    for name, role in (("vera", Role.VIEWER), ("paul", Role.PILOT), ("pia", Role.PILOT), ("ada", Role.ADMIN)):
        station.people.users.add(name, PASSWORD, role)
    with served(create_app(station, Exposure(login=True))) as address:
        yield address


@pytest.fixture
def vera(address: str) -> Iterator[httpx.Client]:
    with closing(logged_in(address, "vera")) as client:
        yield client


@pytest.fixture
def paul(address: str) -> Iterator[httpx.Client]:
    with closing(logged_in(address, "paul")) as client:
        yield client


@pytest.fixture
def pia(address: str) -> Iterator[httpx.Client]:
    with closing(logged_in(address, "pia")) as client:
        yield client


@pytest.fixture
def ada(address: str) -> Iterator[httpx.Client]:
    with closing(logged_in(address, "ada")) as client:
        yield client
