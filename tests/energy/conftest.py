"""The vehicle and its study, computed once."""

import pytest

from stommel.design.endurance import EnergyStudy, energy_study
from stommel.vehicle import Vehicle, load_vehicle


@pytest.fixture(scope="session")
def zju() -> Vehicle:
    return load_vehicle("zju")


@pytest.fixture(scope="session")
def study(zju: Vehicle) -> EnergyStudy:
    return energy_study(zju)
