"""The heading while motors and valve run: their known fields are subtracted, or the last good heading is held.

A field that is known costs nothing but its own error. While something runs whose field nobody has measured, the heading
goes on from the last good one at the rate that it turned with, for as long as that may be believed; then the measured
heading is given again and is said to be disturbed.
"""

import math
from collections import deque
from enum import IntEnum
from typing import NamedTuple

from stommel.geometry.attitude import wrapped
from stommel.onboard.coordination.compass.calibration import CompassCalibration
from stommel.onboard.coordination.compass.heading import Vector, attitude_of, heading_of


class HeadingState(IntEnum):
    """Where a heading comes from."""

    MEASURED = 0
    """Nothing that disturbs runs."""
    COMPENSATED = 1
    """The fields of what runs are subtracted."""
    HELD = 2
    """The field is not to be trusted: the last good heading goes on."""
    DISTURBED = 3
    """The same for longer than may be held: measured again, and wrong by as much as the disturbance."""


class Masking(NamedTuple):
    """When a heading is held, and for how long."""

    longest: float = 20.0
    """After so long without a good reading it is not held any more [s]."""
    settling: float = 0.0
    """After a disturbance without coefficients the field is waited for so long [s]."""
    rate_over: float = 20.0
    """Time over which the rate of turning is fitted to good headings [s]."""


class CompassEstimate(NamedTuple):
    """Attitude and heading that the vehicle goes by; radians."""

    t: float
    heading: float
    """From true north, in (-pi, pi]."""
    pitch: float
    roll: float
    down_b2: float
    """Direction down along b2 to starboard."""
    down_b3: float
    """The same along b3, through the keel."""
    state: HeadingState
    held: float
    """Time since the last good reading [s]."""
    unknown: int
    """Bits of the actuators that run and whose field nobody has measured."""


class CompassCompensation:
    """Heading from the readings of the compass and what runs beside it.

    Parameters
    ----------
    calibration
        Iron and fields of the actuators.
    masking
        How long a heading is held.
    declination
        From magnetic to true north, east positive [rad].
    """

    def __init__(
        self, calibration: CompassCalibration, masking: Masking | None = None, declination: float = 0.0
    ) -> None:
        self.calibration, self.masking, self.declination = calibration, masking or Masking(), declination
        self._good: deque[tuple[float, float]] = deque(maxlen=256)
        self._known: dict[int, tuple[Vector, int]] = {}
        self._masked_until = -math.inf
        self._rate: float | None = None

    def update(self, t: float, acceleration: Vector, field: Vector, running: int) -> CompassEstimate:
        """Take one reading and tell attitude and heading.

        Parameters
        ----------
        t
            Time of the reading [s].
        acceleration
            Felt in the body frame, down positive [g].
        field
            Felt in the body frame [uT].
        running
            Bits of the actuators that ran while it was measured.
        """
        pitch, roll = attitude_of(acceleration)
        length = math.hypot(*acceleration) or 1.0
        down_b2, down_b3 = acceleration[1] / length, acceleration[2] / length
        corrected, unknown = self._corrected(field, running)
        measured = wrapped(heading_of(acceleration, corrected) + self.declination)
        if unknown:
            self._masked_until = t + self.masking.settling
        low, high = self.calibration.strength
        if not unknown and t >= self._masked_until and low <= math.hypot(*corrected) <= high:
            self._good.append((t, measured))
            self._rate = None
            state = HeadingState.COMPENSATED if running else HeadingState.MEASURED
            return CompassEstimate(t, measured, pitch, roll, down_b2, down_b3, state, 0.0, 0)
        held = t - self._good[-1][0] if self._good else math.inf
        if held > self.masking.longest:
            state = HeadingState.DISTURBED
        else:
            measured, state = self._carried_on(held), HeadingState.HELD
        return CompassEstimate(t, measured, pitch, roll, down_b2, down_b3, state, held, unknown)

    def _corrected(self, field: Vector, running: int) -> tuple[Vector, int]:
        """The Earth's field as far as it is known, and what disturbs it besides."""
        found = self._known.get(running)
        if found is None:
            found = self._known[running] = self.calibration.field_of(running)
        (d1, d2, d3), unknown = found
        iron = self.calibration.hard_iron
        b1, b2, b3 = field[0] - iron[0] - d1, field[1] - iron[1] - d2, field[2] - iron[2] - d3
        (r11, r12, r13), (r21, r22, r23), (r31, r32, r33) = self.calibration.correction
        corrected = (
            r11 * b1 + r12 * b2 + r13 * b3,
            r21 * b1 + r22 * b2 + r23 * b3,
            r31 * b1 + r32 * b2 + r33 * b3,
        )
        return corrected, unknown

    def _carried_on(self, held: float) -> float:
        """The last good heading, turned on at the rate before."""
        if self._rate is None:
            last = self._good[-1][0]
            self._rate = turning([point for point in self._good if last - point[0] <= self.masking.rate_over])
        return wrapped(self._good[-1][1] + self._rate * held)


def turning(headings: list[tuple[float, float]]) -> float:
    """Rate of turning [rad/s] as a straight line fits times [s] and headings [rad]; zero for fewer than three."""
    if len(headings) < 3:
        return 0.0
    times, angles = [headings[0][0]], [headings[0][1]]
    for t, psi in headings[1:]:
        times.append(t)
        angles.append(angles[-1] + wrapped(psi - angles[-1]))
    middle = sum(times) / len(times)
    spread = sum((t - middle) ** 2 for t in times)
    if spread <= 0.0:
        return 0.0
    return sum((t - middle) * angle for t, angle in zip(times, angles, strict=True)) / spread
