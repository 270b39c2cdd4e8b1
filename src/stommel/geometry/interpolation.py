"""Values between the points of a table (compiled)."""

import numpy as np

from stommel.compilation import inlined


@inlined
def interpolated(x: float, grid: np.ndarray, values: np.ndarray) -> float:
    """Value at `x`, straight between the points of an ascending grid; the ends hold."""
    if x <= grid[0]:
        first: float = values[0]
        return first
    for k in range(1, len(grid)):
        if x <= grid[k]:
            share = (x - grid[k - 1]) / (grid[k] - grid[k - 1])
            between: float = values[k - 1] + share * (values[k] - values[k - 1])
            return between
    last: float = values[-1]
    return last
