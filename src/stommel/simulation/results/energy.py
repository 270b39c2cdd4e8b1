"""What took how much from the battery over time, self-discharge too: one account for summary, file and pictures."""

import numpy as np
from numpy.typing import NDArray

from stommel.simulation.flight import Flown
from stommel.simulation.plant.parameters import CONSUMERS

Array = NDArray[np.float64]

SELF_DISCHARGE = "self_discharge"
DRAINS = (*CONSUMERS, SELF_DISCHARGE)
"""Everything that empties the battery."""


def energy_of(flown: Flown) -> dict[str, Array]:
    """Energy that left the battery until the end of each row's control step, by `DRAINS` [J]."""
    spent = {name: flown.record["energy"][:, k].copy() for k, name in enumerate(CONSUMERS)}
    until = flown.record["time"] + flown.mission.scenario.integration.control_step_s
    return spent | {SELF_DISCHARGE: flown.plant.battery.self_discharge * until}
