"""A reading of the CTD, and what is none."""

import math
from typing import NamedTuple


class CtdReading(NamedTuple):
    """One sample, in the instrument's units. What is no reading is not a number, and `refused` says why."""

    t: float
    """When its last byte came [s]."""
    pressure: float
    """Of the sea [dbar]."""
    temperature: float
    """[degC]"""
    conductivity: float
    """[S/m]"""
    oxygen: float = math.nan
    """Of the SBE 43F [Hz]."""
    refused: tuple[str, ...] = ()
    """Values that are no readings, with the reason of each."""
    utc: float = math.nan
    """When an uploaded sample was taken, seconds since 1970; a live one has no time of its own."""


LIMITS: dict[str, tuple[float, float]] = {
    "pressure": (-5.0, 2100.0),
    "temperature": (-5.0, 45.0),
    "conductivity": (-0.05, 9.0),
    "oxygen": (0.0, 100_000.0),
}
"""Values that the instrument can measure: -5 to 42 degC and 0 to 9 S/m with a little more for noise, 2000 m."""

ERROR_VALUES = frozenset({99.0, 99.99, 99.999, 999.0, 999.9, 999.99, 9999.0, 9999.9, 9999.99, 99999.0})
"""Numbers that instruments write for "no value", of either sign; within the limits they are measurements."""


def checked(values: dict[str, float]) -> tuple[dict[str, float], tuple[str, ...]]:
    """Return the values with those that are no readings taken out, and why."""
    refused = []
    good = dict(values)
    for name, value in values.items():
        low, high = LIMITS[name]
        if low <= value <= high:
            continue
        good[name] = math.nan
        if not math.isfinite(value) or abs(value) in ERROR_VALUES:
            refused.append(f"{name}: error value {value:g}")
        else:
            refused.append(f"{name}: {value:g} outside of {low:g} to {high:g}")
    return good, tuple(refused)
