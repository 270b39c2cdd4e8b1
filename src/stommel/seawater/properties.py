"""Properties of seawater by TEOS-10 (IOC, SCOR and IAPSO 2010), through `gsw`.

Absolute Salinity S_A [g/kg], Conservative Temperature CT [deg C], in-situ temperature t [deg C], practical salinity
S_P, sea pressure p [dbar], depth z [m, positive down], latitude and longitude [deg]. Every function takes
numbers or arrays.
"""

from typing import TypeAlias

import gsw
import numpy as np
from numpy.typing import ArrayLike, NDArray

from stommel.errors import StommelError

Array: TypeAlias = NDArray[np.float64]


class SeawaterRangeError(StommelError):
    """A quantity that seawater cannot have."""


_ALLOWED = {
    "Absolute Salinity": (0.0, 42.0, "g/kg"),
    "practical salinity": (0.0, 42.0, ""),
    "temperature": (-5.0, 42.0, "deg C"),
    "sea pressure": (-5.0, 12000.0, "dbar"),
    "depth": (-5.0, 12000.0, "m"),
    "latitude": (-90.0, 90.0, "deg"),
}
"""Range of each quantity: that of TEOS-10, a little air above the surface, the deepest trench."""


def _checked(quantity: str, value: ArrayLike) -> Array:
    """Return `value` as an array; numbers that are not there (nan) pass."""
    found: Array = np.asarray(value, dtype=np.float64)
    low, high, unit = _ALLOWED[quantity]
    wrong = found[(found < low) | (found > high) | np.isinf(found)]
    if wrong.size:
        raise SeawaterRangeError(f"{quantity} = {wrong.flat[0]:g} {unit}: must be between {low:g} and {high:g} {unit}")
    return found


def density(S_A: ArrayLike, CT: ArrayLike, p: ArrayLike) -> Array:
    """In-situ density [kg/m3].

    Raises
    ------
    SeawaterRangeError
        A quantity is outside the range of seawater; so for every function here.
    """
    rho: Array = gsw.rho(_checked("Absolute Salinity", S_A), _checked("temperature", CT), _checked("sea pressure", p))
    return rho


def sound_speed(S_A: ArrayLike, CT: ArrayLike, p: ArrayLike) -> Array:
    """Speed of sound [m/s]."""
    c: Array = gsw.sound_speed(
        _checked("Absolute Salinity", S_A), _checked("temperature", CT), _checked("sea pressure", p)
    )
    return c


def freezing_temperature(S_A: ArrayLike, p: ArrayLike, saturation: float = 0.0) -> Array:
    """In-situ temperature at which seawater freezes [deg C]; `saturation` is the share of dissolved air, 0 to 1."""
    t: Array = gsw.t_freezing(_checked("Absolute Salinity", S_A), _checked("sea pressure", p), saturation)
    return t


def pressure_from_depth(z: ArrayLike, latitude: ArrayLike) -> Array:
    """Sea pressure [dbar] at depth `z` of the standard ocean (S_A = 35.16504 g/kg, CT = 0 deg C)."""
    p: Array = gsw.p_from_z(-_checked("depth", z), _checked("latitude", latitude))
    return p


def depth_from_pressure(p: ArrayLike, latitude: ArrayLike) -> Array:
    """Depth [m] at sea pressure `p` of the standard ocean."""
    z: Array = -gsw.z_from_p(_checked("sea pressure", p), _checked("latitude", latitude))
    return z


def absolute_salinity(S_P: ArrayLike, p: ArrayLike, longitude: ArrayLike, latitude: ArrayLike) -> Array:
    """Absolute Salinity [g/kg] of practical salinity, with the local anomaly of composition."""
    found = _checked("practical salinity", S_P)
    latitude = _checked("latitude", latitude)
    S_A: Array = gsw.SA_from_SP(found, _checked("sea pressure", p), longitude, latitude)
    return S_A


def conservative_temperature(t: ArrayLike, S_A: ArrayLike, p: ArrayLike) -> Array:
    """Conservative Temperature [deg C] of in-situ temperature."""
    CT: Array = gsw.CT_from_t(
        _checked("Absolute Salinity", S_A), _checked("temperature", t), _checked("sea pressure", p)
    )
    return CT


def conservative_from_potential(theta: ArrayLike, S_A: ArrayLike) -> Array:
    """Conservative Temperature [deg C] of potential temperature (reference pressure 0)."""
    CT: Array = gsw.CT_from_pt(_checked("Absolute Salinity", S_A), _checked("temperature", theta))
    return CT


def in_situ_temperature(CT: ArrayLike, S_A: ArrayLike, p: ArrayLike) -> Array:
    """In-situ temperature [deg C] of Conservative Temperature."""
    t: Array = gsw.t_from_CT(
        _checked("Absolute Salinity", S_A), _checked("temperature", CT), _checked("sea pressure", p)
    )
    return t
