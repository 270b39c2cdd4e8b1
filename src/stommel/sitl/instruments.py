"""The simulated instruments at their ports: from what the plant feels to the bytes that the devices send."""

import math

from stommel.geometry.attitude import wrapped
from stommel.geometry.vectors import Vector
from stommel.instruments.gnss.device import GnssDevice, GnssTruth
from stommel.instruments.tcm.device import CompassDevice, CompassTruth
from stommel.sitl.plant import Felt

EARTH_FIELD = 50.0
"""Strength of the Earth's field that simulated magnetometers feel [uT]; an assumption."""


def compass_truth(felt: Felt, declination: float, temperature: float) -> CompassTruth:
    """What the compass feels: direction down and field with all that the scenario says of their errors.

    The scenario's noise of the heading is noise of the field: it is turned about the vertical until the heading that
    follows from it is the one that the plant's compass says.
    """
    readings = felt.readings
    down = (-math.sin(readings.theta), readings.down_b2, readings.down_b3)
    heading = readings.psi - declination
    field = _turned(felt.field, down, wrapped(_heading(down, felt.field) - heading))
    x, y, z = field
    return CompassTruth(
        heading,
        readings.theta,
        math.atan2(readings.down_b2, readings.down_b3),
        down,
        (EARTH_FIELD * x, EARTH_FIELD * y, EARTH_FIELD * z),
        temperature,
    )


def _heading(down: Vector, field: Vector) -> float:
    """Heading by the direction down and the field: of b1, from the field's horizontal part."""
    east_1 = down[1] * field[2] - down[2] * field[1]
    north_1 = field[0] - down[0] * (down[0] * field[0] + down[1] * field[1] + down[2] * field[2])
    return math.atan2(east_1, north_1)


def _turned(vector: Vector, axis: Vector, angle: float) -> Vector:
    """Turn a vector about an axis of length one, right-handed (Rodrigues)."""
    c, s = math.cos(angle), math.sin(angle)
    x, y, z = vector
    a, b, d = axis
    along = (a * x + b * y + d * z) * (1.0 - c)
    return (
        c * x + s * (b * z - d * y) + along * a,
        c * y + s * (d * x - a * z) + along * b,
        c * z + s * (a * y - b * x) + along * d,
    )


class CompassPort:
    """The compass, always on."""

    def __init__(self) -> None:
        self.device = CompassDevice()

    def exchange(self, data: bytes, truth: CompassTruth, t: float) -> bytes:
        """Bytes that it sends until a time [s], after these came to it."""
        return self.device.take(data, truth, t)


class GnssPort:
    """The satellite receiver, which has power at the surface."""

    def __init__(self) -> None:
        self.device = GnssDevice()
        self._on = False
        self._place: tuple[float, float] | None = None

    def exchange(self, data: bytes, felt: Felt, utc: float, t: float, *, on: bool) -> bytes:
        """Bytes that it sends until a time [s]; the plant says when it has a position."""
        if not on:
            if self._on:
                self.device.restart()
            self._on, self._place = False, None
            return b""
        self._on = True
        readings = felt.readings
        if readings.fixed:
            self._place = (readings.fix_latitude, readings.fix_longitude)
        latitude, longitude = self._place or (0.0, 0.0)
        return self.device.take(data, GnssTruth(latitude, longitude, utc, readings.fixed, 0.0), t)
