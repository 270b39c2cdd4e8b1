"""The first twenty flights of `stommel sitl campaign`, whole: two hours each, with random faults.

Oracle: the rules of `stommel.sitl.campaign.verdict`. The campaign of 500 is the command with `--runs 500`.
"""

import pytest

from stommel.simulation.scenario.mission import Mission
from stommel.sitl.campaign.flight import fly_with, with_seed
from stommel.sitl.campaign.run import TRIAL, load_kit
from stommel.sitl.campaign.verdict import PASSED, UNSURVIVABLE

LOST = {12: "pump_dead"}
"""Seeds that no pilot survives, and what of: the pump of 12 dies in the middle of its first descent, for ever."""


@pytest.mark.parametrize("seed", range(1, 21))
def test_every_vehicle_comes_home_or_no_pilot_could_bring_it(seed: int, trial: Mission) -> None:
    found = fly_with(with_seed(trial, seed), load_kit(TRIAL).faults_of(seed))
    assert found.verdict == (UNSURVIVABLE if seed in LOST else PASSED), found
    assert found.why.partition(":")[0] == LOST.get(seed, "")
