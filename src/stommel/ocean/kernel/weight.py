"""From the levels of a grid to the depths of a column: density, and the pressure of the water above (compiled)."""

from math import sin

import numpy as np

from stommel.compilation import compiled, inlined
from stommel.ocean.kernel.grid import CT_ROW, QUANTITIES, RHO, SALINITY, TEMPERATURE, P
from stommel.seawater.table import DensityTable, density

PASCAL_PER_DECIBAR = 1.0e4
GRAVITY_PER_METRE = 2.26e-7
"""Relative growth of gravity with depth, as in gsw.grav [1/m]."""


@inlined
def gravity(latitude: float) -> float:
    """Gravity at the sea surface [m/s2], Moritz (2000) as in gsw.grav; latitude in rad."""
    square = sin(latitude) ** 2
    return 9.780327 * (1.0 + (5.2792e-3 + 2.32e-5 * square) * square)


@compiled
def spread(
    depths: np.ndarray,
    profile_depths: np.ndarray,
    profile_rho: np.ndarray,
    table: DensityTable,
    levels: np.ndarray,
    values: np.ndarray,
    dz: float,
    g: float,
) -> None:
    """Interpolate the levels to the column's depths and integrate density to pressure from the surface down."""
    last, k = depths.size - 1, 0
    above, pressure = 0.0, 0.0
    for n in range(values.shape[0]):
        z = n * dz
        while k < last - 1 and depths[k + 1] < z:
            k += 1
        lower = min(k + 1, last)
        share = min(max((z - depths[k]) / (depths[lower] - depths[k]), 0.0), 1.0) if last > 0 else 0.0
        for q in range(TEMPERATURE, QUANTITIES):
            values[n, q] = levels[k, q] + share * (levels[lower, q] - levels[k, q])
        weight = g * (1.0 + GRAVITY_PER_METRE * (z - 0.5 * dz)) * dz if n > 0 else 0.0
        # with the density above, the pressure is some Pa off, which moves the density by about 1e-6 kg/m3
        pressure += weight * above
        if profile_depths.size > 0:
            rho = _profile_density(profile_depths, profile_rho, z)
        else:
            rho = density(table, values[n, SALINITY], values[n, CT_ROW], pressure / PASCAL_PER_DECIBAR)
        pressure += 0.5 * weight * (rho - above)
        above = rho
        values[n, P], values[n, RHO] = pressure, rho


@inlined
def _profile_density(depths: np.ndarray, rho: np.ndarray, z: float) -> float:
    """Density that is given directly, held at the ends of its depths."""
    k = min(max(int(np.searchsorted(depths, z)), 1), depths.size - 1)
    first = max(k - 1, 0)
    share = min(max((z - depths[first]) / (depths[k] - depths[first]), 0.0), 1.0) if k > first else 0.0
    at: float = rho[first] + share * (rho[k] - rho[first])
    return at
