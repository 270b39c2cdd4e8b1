"""Water that no sea has, seen by what the field looks like: zeros that nothing marks as missing, units that are not so.

A few such numbers are left out, as the marks of a model's land or of a faulty node; more than a few are refused.
"""

import numpy as np
from numpy.typing import NDArray

from stommel.ocean.reading.tally import share
from stommel.ocean.reading.variables import File

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_FEW = 0.01
"""Share of the numbers up to which impossible ones are left out instead of refused."""
_NOTHING = 1e-6
"""Salinity below this is none [g/kg]."""
_SALT = 2.0
"""Salinity above this is salt water [g/kg]."""
_WARM = 5.0
"""Water as warm as this does not lie beside water of exactly zero [deg C]."""
_KG_KG = (0.02, 0.0425)
"""Median salinity that is kg/kg: 20 to 42.5 g/kg."""
_FASTEST = 3.0
"""Median speed that no sea has; the strongest currents reach it in a narrow jet [m/s]."""


def left_out(salinity: tuple[File, str], temperature: tuple[File, str], S: Array, T: Array, still: Mask) -> Mask:
    """Where numbers of one time (level, j, i) are marks of nothing and no water.

    Parameters
    ----------
    salinity, temperature
        File and variable of the two.
    S, T
        Salinity [g/kg] and temperature [deg C], nan where there is none.
    still
        Where there is no current at all.

    Raises
    ------
    FileError
        They are many.
    """
    water = np.isfinite(S) & np.isfinite(T)
    fresh = _fresh_below_salt(S, water)
    _settle(*salinity, fresh, water, "is 0 below salt water")
    land = _columns_of_zeros(S, T, still, water)
    _settle(*salinity, land, water, "is 0 from top to bottom, with one temperature, beside salt water")
    cold = _zero_below_warm(T, water)
    _settle(*temperature, cold, water, f"is exactly 0 below water warmer than {_WARM:g} deg C")
    return fresh | land | cold


def _settle(file: File, variable: str, wrong: Mask, water: Mask, what: str) -> None:
    found, count = int(wrong.sum()), int(water.sum())
    if found > _FEW * count:
        file.refuse(
            variable,
            f"{variable} {what} in {share(found, count)} of its numbers: zeros that nothing marks as missing? Name "
            "them with _FillValue",
        )
    file.tally.add(variable, f"where it {what}, and left out", found, count)


def _fresh_below_salt(S: Array, water: Mask) -> Mask:
    above = np.maximum.accumulate(np.where(water, S, 0.0), axis=0)
    return water & (S < _NOTHING) & (above > _SALT)


def _columns_of_zeros(S: Array, T: Array, still: Mask, water: Mask) -> Mask:
    """Columns of no salt beside others of salt: rivers differ in temperature and flow, land does not."""
    zero = water & (S < _NOTHING)
    dry = zero.any(axis=0) & ~(water & ~zero).any(axis=0)
    wrong: Mask = zero & dry
    if not wrong.any() or not (water & (S > _SALT)).any():
        return np.zeros_like(water)
    same = np.ptp(T[wrong]) == 0.0 and (bool(still[wrong].all()) or T[wrong][0] == 0.0)
    return wrong if same else np.zeros_like(water)


def _zero_below_warm(T: Array, water: Mask) -> Mask:
    wrong = np.zeros_like(water)
    for k in range(1, len(T)):
        wrong[k] = water[k] & (T[k] == 0.0) & ((water[k - 1] & (T[k - 1] > _WARM)) | wrong[k - 1])
    return wrong


def require_salinity(file: File, variable: str, S: Array) -> None:
    """Refuse a salinity that is kg/kg, whatever its units say; with units stated by the user it is as they are."""
    median = float(np.nanmedian(S))
    if _KG_KG[0] < median < _KG_KG[1]:
        file.refuse(
            variable,
            f"{variable} is {median:.3g} g/kg in the middle of its numbers by its units: is it kg kg-1? Say what it is "
            "with units, salinity = 'kg kg-1' or 'g kg-1'",
        )


def require_speed(file: File, variable: str, u: Array, v: Array) -> None:
    """Refuse currents that no sea has."""
    speed = np.hypot(u, v)
    median = float(np.nanmedian(speed)) if np.isfinite(speed).any() else 0.0
    if median > _FASTEST:
        file.refuse(
            variable, f"{variable}: half of the currents are faster than {median:.3g} m/s; are the units cm s-1?"
        )
