"""Density of seawater for compiled code: a polynomial fitted to TEOS-10, with its measured error beside it.

TEOS-10 (IOC, SCOR and IAPSO 2010; the 75-term polynomial of Roquet et al. 2015 in `gsw`) is smooth: over the range of
one ocean a product of low polynomials in salinity, temperature and pressure meets it far below what a sensor resolves.
"""

from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stommel.compilation import compiled, inlined
from stommel.errors import StommelError

Range: TypeAlias = tuple[float, float]

TOLERANCE = 1e-5
"""Largest error that `density_table` accepts unless told otherwise [kg/m3]."""

_LARGEST_DEGREES = (9, 13, 7)
_CHECK_POINTS = (31, 41, 31)


class DensityTableError(StommelError):
    """No polynomial meets the wanted error over the wanted range."""


class DensityTable(NamedTuple):
    """Polynomial density over a range of Absolute Salinity, Conservative Temperature and sea pressure.

    Outside the range the arguments are held at its ends: a polynomial does not extrapolate.
    """

    coefficients: NDArray[np.float64]
    """Of the powers of the scaled pressure, salinity and temperature, in this order [kg/m3]."""
    S_A_middle: float
    """Middle of the range of Absolute Salinity [g/kg]."""
    S_A_half: float
    """Half of the range of Absolute Salinity [g/kg]."""
    CT_middle: float
    """Middle of the range of Conservative Temperature [deg C]."""
    CT_half: float
    """Half of the range of Conservative Temperature [deg C]."""
    p_middle: float
    """Middle of the range of sea pressure [dbar]."""
    p_half: float
    """Half of the range of sea pressure [dbar]."""
    largest_error: float
    """Largest difference from gsw.rho on a grid of points that the fit has not seen [kg/m3]."""


@inlined
def density(table: DensityTable, S_A: float, CT: float, p: float) -> float:
    """In-situ density [kg/m3].

    Parameters
    ----------
    table
        From `density_table`.
    S_A
        Absolute Salinity [g/kg].
    CT
        Conservative Temperature [deg C].
    p
        Sea pressure [dbar].
    """
    s = min(max((S_A - table.S_A_middle) / table.S_A_half, -1.0), 1.0)
    t = min(max((CT - table.CT_middle) / table.CT_half, -1.0), 1.0)
    q = min(max((p - table.p_middle) / table.p_half, -1.0), 1.0)
    c = table.coefficients
    rho = 0.0
    # pressure last: the next depth of a column can begin before its pressure, which waits for this one, is known
    for k in range(c.shape[0] - 1, -1, -1):
        layer = 0.0
        for i in range(c.shape[1] - 1, -1, -1):
            row = 0.0
            for j in range(c.shape[2] - 1, -1, -1):
                row = row * t + c[k, i, j]
            layer = layer * s + row
        rho = rho * q + layer
    return rho


@compiled
def densities(
    table: DensityTable,
    S_A: NDArray[np.float64],
    CT: NDArray[np.float64],
    p: NDArray[np.float64],
    out: NDArray[np.float64],
) -> None:
    """Write `density` of each element of three flat arrays into `out` [kg/m3]."""
    for n in range(out.size):
        out[n] = density(table, S_A[n], CT[n], p[n])


def density_table(S_A: Range, CT: Range, p: Range, tolerance: float = TOLERANCE) -> DensityTable:
    """Fit the shortest polynomial that differs from gsw.rho by at most `tolerance` [kg/m3] over the range.

    Parameters
    ----------
    S_A
        Least and greatest Absolute Salinity [g/kg], within 0 to 42.
    CT
        Least and greatest Conservative Temperature [deg C], within -5 to 42.
    p
        Least and greatest sea pressure [dbar], within 0 to 12000.
    tolerance
        Largest error to accept [kg/m3].

    Raises
    ------
    DensityTableError
        The range is not one of seawater, or no polynomial of the largest degrees meets the tolerance.
    """
    ranges = _checked_ranges(S_A, CT, p)
    degrees = [1, 2, 1]
    table = _fitted(ranges, degrees)
    while table.largest_error > tolerance:
        trials = [
            _fitted(ranges, [*degrees[:axis], degrees[axis] + 1, *degrees[axis + 1 :]])
            for axis in range(3)
            if degrees[axis] < _LARGEST_DEGREES[axis]
        ]
        if not trials:
            raise DensityTableError(
                f"density table: an error of {tolerance:g} kg/m3 cannot be reached over this range; "
                f"the least is {table.largest_error:.2g} kg/m3"
            )
        table = min(trials, key=lambda trial: trial.largest_error)
        pressure, *others = table.coefficients.shape
        degrees = [n - 1 for n in (*others, pressure)]
    return table


def _checked_ranges(S_A: Range, CT: Range, p: Range) -> list[Range]:
    allowed = (("S_A", S_A, (0.0, 42.0), "g/kg"), ("CT", CT, (-5.0, 42.0), "deg C"), ("p", p, (0.0, 12000.0), "dbar"))
    ranges = []
    for name, (low, high), (least, most), unit in allowed:
        if not (least <= low <= high <= most):
            raise DensityTableError(
                f"density table: {name} from {low:g} to {high:g} {unit}: must be a range within {least:g} to {most:g}"
            )
        # a range of no width still needs one to be scaled by
        ranges.append((low, high) if high - low > 1e-3 else (max(low - 0.5, least), min(high + 0.5, most)))
    return ranges


def _fitted(ranges: Sequence[Range], degrees: Sequence[int]) -> DensityTable:
    """Interpolate gsw.rho at Chebyshev points, and measure the error between them."""
    scaled = [np.cos(np.pi * (np.arange(n + 1) + 0.5) / (n + 1)) for n in degrees]
    coefficients = _gsw_density(ranges, scaled)
    for axis, x in enumerate(scaled):
        inverse = np.linalg.inv(np.vander(x, increasing=True))
        coefficients = np.moveaxis(np.tensordot(inverse, coefficients, axes=(1, axis)), 0, axis)
    check = [np.linspace(-1.0, 1.0, n) for n in _CHECK_POINTS]
    error = float(np.abs(_polynomial(coefficients, check) - _gsw_density(ranges, check)).max())
    middle = [0.5 * (low + high) for low, high in ranges]
    half = [0.5 * (high - low) for low, high in ranges]
    pressure_first = np.ascontiguousarray(np.moveaxis(coefficients, 2, 0))
    return DensityTable(pressure_first, middle[0], half[0], middle[1], half[1], middle[2], half[2], error)


def _polynomial(coefficients: NDArray[np.float64], scaled: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
    powers = [np.vander(x, n, increasing=True) for x, n in zip(scaled, coefficients.shape, strict=True)]
    value: NDArray[np.float64] = np.einsum("ai,bj,ck,ijk->abc", *powers, coefficients, optimize=True)
    return value


def _gsw_density(ranges: Sequence[Range], scaled: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
    import gsw  # noqa: PLC0415 - compiled code that only reads a table does not need it

    axes = [
        np.clip(0.5 * (low + high) + 0.5 * (high - low) * x, low, high)
        for (low, high), x in zip(ranges, scaled, strict=True)
    ]
    value: NDArray[np.float64] = gsw.rho(*np.meshgrid(*axes, indexing="ij"))
    return value
