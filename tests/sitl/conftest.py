import pytest

from stommel.simulation.scenario.mission import Mission
from stommel.sitl.campaign.run import TRIAL
from stommel.sitl.scenario import load_scenario


@pytest.fixture(scope="session")
def trial() -> Mission:
    """The mission that campaigns fly."""
    return load_scenario(TRIAL).mission
