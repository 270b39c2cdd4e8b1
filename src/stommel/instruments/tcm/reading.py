"""A reading of the compass."""

import math
from typing import NamedTuple

from stommel.instruments.tcm.components import KINDS, MEASURED, layout

DISTORTED, UNCALIBRATED = 1, 2
"""Bits of the status: the field is beyond +-80 uT on an axis; the compass has no user calibration."""

Vector = tuple[float, float, float]


class CompassReading(NamedTuple):
    """What the compass says; angles in radians."""

    t: float
    """When its last byte came [s]."""
    heading: float
    """From the north that the compass is set to, 0 to 2 pi."""
    pitch: float
    """Nose up positive."""
    roll: float
    """Starboard down positive."""
    acceleration: Vector
    """[g], in the compass's axes."""
    magnetic_field: Vector
    """[uT]"""
    status: int
    """Bits `DISTORTED` and `UNCALIBRATED`."""
    temperature: float = math.nan
    """Of the compass [degC]."""


_LIMITS = tuple((KINDS[c].low, KINDS[c].high) for c in MEASURED)
_NUMBERS = tuple(int(component) for component in MEASURED)


def reading(payload: bytes, big_endian: bool, t: float) -> CompassReading | str:
    """Return the reading of a kDataResp with the components `MEASURED`, or in words why it is none."""
    form = layout(MEASURED, big_endian)
    if len(payload) != form.size:
        return "components that were not asked for"
    count, *rest = form.unpack(payload)
    if count != len(MEASURED) or tuple(rest[::2]) != _NUMBERS:
        return "components that were not asked for"
    values = rest[1::2]
    for value, (low, high), component in zip(values, _LIMITS, MEASURED, strict=True):
        if not low <= value <= high:  # also where it is not a number
            return f"{component.name.lower()} {value:g} outside of {low:g} to {high:g}"
    heading, pitch, roll, a_x, a_y, a_z, m_x, m_y, m_z, temperature, distorted, calibrated = values
    radians = math.radians
    return CompassReading(
        t,
        radians(heading % 360.0),
        radians(pitch),
        radians(roll),
        (a_x, a_y, a_z),
        (m_x, m_y, m_z),
        (DISTORTED if distorted else 0) | (0 if calibrated else UNCALIBRATED),
        temperature,
    )
