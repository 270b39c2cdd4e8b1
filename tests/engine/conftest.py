"""Engines that the tests share."""

import pytest

from stommel.machinery.engine import engine_of, load_engine
from stommel.vehicle import load_vehicle
from stommel.vehicle.schema import Engine


@pytest.fixture(scope="session")
def zju() -> Engine:
    return engine_of(load_vehicle("zju")).engine


@pytest.fixture(scope="session", params=["zju", "slocum-1000m", "high-pressure"])
def any_engine(request: pytest.FixtureRequest, zju: Engine) -> Engine:
    return zju if request.param == "zju" else load_engine(request.param).engine
