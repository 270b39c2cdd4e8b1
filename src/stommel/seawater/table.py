"""Properties of seawater for compiled code: polynomials fitted to TEOS-10, each with its measured error beside it.

TEOS-10 (IOC, SCOR and IAPSO 2010; the 75-term polynomial of Roquet et al. 2015 in `gsw`) is smooth: over the range of
one ocean a product of low polynomials in salinity, temperature and pressure meets it far below what a sensor resolves.
Density, speed of sound and freezing temperature are tabulated.
"""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stommel.compilation import compiled, inlined
from stommel.errors import StommelError

Range: TypeAlias = tuple[float, float]

TOLERANCE = 1e-5
"""Largest error that `density_table` accepts unless told otherwise [kg/m3]."""
SOUND_SPEED_TOLERANCE = 1e-3
"""The same of `sound_speed_table` [m/s]."""
FREEZING_TOLERANCE = 1e-3
"""The same of `freezing_table` [deg C]; the salinity's square root at fresh water is what costs degrees."""

_LARGEST_DEGREES = (9, 13, 7)
_CHECK_POINTS = (31, 41, 31)


class DensityTableError(StommelError):
    """No polynomial meets the wanted error over the wanted range."""


class SeawaterTable(NamedTuple):
    """Polynomial of one property over a range of Absolute Salinity, Conservative Temperature and sea pressure.

    Outside the range the arguments are held at its ends: a polynomial does not extrapolate.
    """

    coefficients: NDArray[np.float64]
    """Of the powers of the scaled pressure, salinity and temperature, in this order [unit of the property]."""
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
    """Largest difference from gsw on a grid of points that the fit has not seen [unit of the property]."""


DensityTable: TypeAlias = SeawaterTable
"""Table of in-situ density [kg/m3]."""


@inlined
def tabulated(table: SeawaterTable, S_A: float, CT: float, p: float) -> float:
    """Property of a table: density [kg/m3], speed of sound [m/s] or freezing temperature in situ [deg C].

    Parameters
    ----------
    table
        From `density_table`, `sound_speed_table` or `freezing_table`.
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
    value = 0.0
    # pressure last: the next depth of a column can begin before its pressure, which waits for this one, is known
    for k in range(c.shape[0] - 1, -1, -1):
        layer = 0.0
        for i in range(c.shape[1] - 1, -1, -1):
            row = 0.0
            for j in range(c.shape[2] - 1, -1, -1):
                row = row * t + c[k, i, j]
            layer = layer * s + row
        value = value * q + layer
    return value


@inlined
def density(table: DensityTable, S_A: float, CT: float, p: float) -> float:
    """In-situ density [kg/m3] of a table from `density_table`; the arguments are those of `tabulated`."""
    return tabulated(table, S_A, CT, p)


@compiled
def densities(
    table: SeawaterTable,
    S_A: NDArray[np.float64],
    CT: NDArray[np.float64],
    p: NDArray[np.float64],
    out: NDArray[np.float64],
) -> None:
    """Write `tabulated` of each element of three flat arrays into `out`."""
    for n in range(out.size):
        out[n] = tabulated(table, S_A[n], CT[n], p[n])


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
    import gsw  # noqa: PLC0415 - compiled code that only reads a table does not need it

    return _table(_checked_ranges(S_A, CT, p), gsw.rho, [1, 2, 1], tolerance, "density table", "kg/m3")


def sound_speed_table(S_A: Range, CT: Range, p: Range, tolerance: float = SOUND_SPEED_TOLERANCE) -> SeawaterTable:
    """Fit gsw.sound_speed within `tolerance` [m/s]; arguments and errors are those of `density_table`."""
    import gsw  # noqa: PLC0415 - see density_table

    return _table(_checked_ranges(S_A, CT, p), gsw.sound_speed, [1, 2, 1], tolerance, "sound speed table", "m/s")


def freezing_table(
    S_A: Range, p: Range, saturation: float = 0.0, tolerance: float = FREEZING_TOLERANCE
) -> SeawaterTable:
    """Fit gsw.t_freezing within `tolerance` [deg C]; its value does not depend on the temperature given to it.

    `saturation` is the share of dissolved air, 0 to 1; the other arguments and the errors are those of `density_table`.
    """
    import gsw  # noqa: PLC0415 - see density_table

    if not 0.0 <= saturation <= 1.0:
        raise DensityTableError(f"freezing table: saturation = {saturation:g}: must be between 0 and 1")

    def freezing(S: Any, _: Any, pressure: Any) -> Any:
        return gsw.t_freezing(S, pressure, saturation)

    return _table(_checked_ranges(S_A, (0.0, 1.0), p), freezing, [2, 0, 1], tolerance, "freezing table", "deg C")


def _table(
    ranges: Sequence[Range], exact: Callable[..., Any], start: list[int], tolerance: float, what: str, unit: str
) -> SeawaterTable:
    """Raise the degrees one by one, each time where it helps most, until the error is small enough."""
    degrees = start
    free = [axis for axis in range(3) if start[axis] > 0]
    table = _fitted(ranges, degrees, exact)
    while table.largest_error > tolerance:
        trials = [
            _fitted(ranges, [*degrees[:axis], degrees[axis] + 1, *degrees[axis + 1 :]], exact)
            for axis in free
            if degrees[axis] < _LARGEST_DEGREES[axis]
        ]
        if not trials:
            raise DensityTableError(
                f"{what}: an error of {tolerance:g} {unit} cannot be reached over this range; "
                f"the least is {table.largest_error:.2g} {unit}"
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
                f"seawater table: {name} from {low:g} to {high:g} {unit}: must be a range within {least:g} to {most:g}"
            )
        # a range of no width still needs one to be scaled by
        ranges.append((low, high) if high - low > 1e-3 else (max(low - 0.5, least), min(high + 0.5, most)))
    return ranges


def _fitted(ranges: Sequence[Range], degrees: Sequence[int], exact: Callable[..., Any]) -> SeawaterTable:
    """Interpolate gsw at Chebyshev points, and measure the error between them."""
    scaled = [np.cos(np.pi * (np.arange(n + 1) + 0.5) / (n + 1)) for n in degrees]
    coefficients = _exact_values(ranges, scaled, exact)
    for axis, x in enumerate(scaled):
        inverse = np.linalg.inv(np.vander(x, increasing=True))
        coefficients = np.moveaxis(np.tensordot(inverse, coefficients, axes=(1, axis)), 0, axis)
    check = [np.linspace(-1.0, 1.0, n) for n in _CHECK_POINTS]
    error = float(np.abs(_polynomial(coefficients, check) - _exact_values(ranges, check, exact)).max())
    middle = [0.5 * (low + high) for low, high in ranges]
    half = [0.5 * (high - low) for low, high in ranges]
    pressure_first = np.ascontiguousarray(np.moveaxis(coefficients, 2, 0))
    return SeawaterTable(pressure_first, middle[0], half[0], middle[1], half[1], middle[2], half[2], error)


def _polynomial(coefficients: NDArray[np.float64], scaled: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
    powers = [np.vander(x, n, increasing=True) for x, n in zip(scaled, coefficients.shape, strict=True)]
    value: NDArray[np.float64] = np.einsum("ai,bj,ck,ijk->abc", *powers, coefficients, optimize=True)
    return value


def _exact_values(
    ranges: Sequence[Range], scaled: Sequence[NDArray[np.float64]], exact: Callable[..., Any]
) -> NDArray[np.float64]:
    axes = [
        np.clip(0.5 * (low + high) + 0.5 * (high - low) * x, low, high)
        for (low, high), x in zip(ranges, scaled, strict=True)
    ]
    value: NDArray[np.float64] = exact(*np.meshgrid(*axes, indexing="ij"))
    return value
