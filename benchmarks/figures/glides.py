"""A hundred thousand glides that a designer might ask for, all different."""

import numpy as np
from numpy.typing import NDArray

GLIDES = 100_000


def speeds_and_pitches() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Speeds [m/s] and pitch angles [rad] of `GLIDES` distinct pairs: slow to fast, shallow to steep, dives only."""
    speeds, pitches = np.meshgrid(np.linspace(0.2, 0.8, 250), np.deg2rad(np.linspace(-60.0, -20.0, GLIDES // 250)))
    return speeds.ravel(), pitches.ravel()
