"""How fast the dives were flown, beside what the plan asked for."""

import numpy as np
from numpy.typing import NDArray

from stommel.control.dive_cycle import ASCENT, DESCENT

STILL_M3 = 1e-7
"""Change of the ballast volume from row to row that is none."""


def flown_speed(record: NDArray[np.void]) -> float | None:
    """Way through the water over the time of descents and ascents while no oil flows [m/s]; None without any."""
    moved = np.abs(np.diff(record["ballast"], prepend=np.nan)) > STILL_M3
    gliding = np.isin(record["phase"], (DESCENT, ASCENT)) & ~moved
    if not gliding.any():
        return None
    rows = record[gliding]
    return float(np.sqrt(rows["u"] ** 2 + rows["v"] ** 2 + rows["w"] ** 2).mean())
