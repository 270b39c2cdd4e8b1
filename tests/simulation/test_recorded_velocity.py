"""The recorded velocity is the hull's own; oracle: differences of the recorded positions in the body frame."""

import numpy as np

from stommel.geometry.earth import metres_per_radian
from tests.simulation.conftest import EXACT, flown

STEP = 0.2
"""Between rows [s]: short beside the time in which the vehicle answers its drives."""
EVEN = 1e-4
"""By so much less the speed of the drive changes from row to row, it neither starts nor stops [m/s]."""


def test_surge_leaves_out_the_mass_that_moves_in_the_hull() -> None:
    """A mass of 10 kg at 5 mm/s takes up to 0.8 mm/s off a vehicle of 65 kg; the test sees a twentieth of it.

    In water at rest, where the velocity through the water is that over the ground.
    """
    found = flown(
        sensors=EXACT, integration={"control_step_s": STEP}, output_every_s=STEP, duration_days=0.02
    ).record  # fmt: skip
    north_m, east_m = metres_per_radian(float(found["latitude"][0]))
    positions = np.stack([found["latitude"] * north_m, found["longitude"] * east_m, found["depth"]])
    rates = (positions[:, 2:] - positions[:, :-2]) / (2.0 * STEP)
    theta, psi = found["pitch"][1:-1], found["heading"][1:-1]
    ahead = np.stack([np.cos(theta) * np.cos(psi), np.cos(theta) * np.sin(psi), -np.sin(theta)])
    surge = np.sum(ahead * rates, axis=0)
    speed = np.diff(found["moving_mass"]) / STEP
    even = np.abs(np.diff(speed)) < EVEN
    moving = even & (np.abs(speed[1:]) > 4e-3) & (found["depth"][1:-1] > 2.0)
    assert moving.sum() > 100
    assert np.abs(found["u"][1:-1] - surge)[moving].max() < 4e-5
