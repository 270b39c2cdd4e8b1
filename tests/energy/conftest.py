"""The study of the vehicle, computed once."""

import pytest

from stommel.design.endurance import EnergyStudy, energy_study
from stommel.vehicle import Vehicle


@pytest.fixture(scope="session")
def study(zju: Vehicle) -> EnergyStudy:
    return energy_study(zju)
