"""Temperature against salinity, and the lines of equal density among which water masses are read."""

from typing import NamedTuple

import gsw
import numpy as np
from contourpy import contour_generator
from numpy.typing import NDArray

Array = NDArray[np.float64]
_GRID = 60


class DensityLine(NamedTuple):
    """A line of equal potential density."""

    level: float
    """Potential density anomaly to 0 dbar [kg/m3]."""
    absolute_salinity: Array
    """[g/kg]"""
    conservative_temperature: Array
    """[degC]"""


def density_lines(
    salinity: tuple[float, float], temperature: tuple[float, float], levels: int = 8
) -> tuple[DensityLine, ...]:
    """Lines of equal potential density anomaly in a range of salinity [g/kg] and temperature [degC], by TEOS-10.

    Parameters
    ----------
    salinity, temperature
        Lowest and highest.
    levels
        About how many lines, 1 to 30; they lie at round numbers.
    """
    S = np.linspace(*salinity, _GRID)
    T = np.linspace(*temperature, _GRID)
    sigma = gsw.sigma0(*np.meshgrid(S, T))
    lines = contour_generator(S, T, sigma)
    found = []
    for level in round_levels(float(sigma.min()), float(sigma.max()), min(max(levels, 1), 30)):
        for line in lines.lines(level):
            points = np.asarray(line, dtype=np.float64)
            found.append(DensityLine(level, points[:, 0], points[:, 1]))
    return tuple(found)


def round_levels(low: float, high: float, about: int) -> list[float]:
    """Round numbers strictly between two, about so many: steps of 1, 2 or 5 times a power of ten."""
    if not high > low:
        return []
    rough = (high - low) / about
    power = 10.0 ** np.floor(np.log10(rough))
    step = next(power * times for times in (1.0, 2.0, 5.0, 10.0) if power * times >= rough)
    first, last = int(np.floor(low / step)) + 1, int(np.ceil(high / step)) - 1
    return [float(np.round(step * k, 12)) for k in range(first, last + 1)]
