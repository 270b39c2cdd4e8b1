"""What is known of the iron and the motors around a compass."""

from typing import NamedTuple

from stommel.onboard.coordination.compass.heading import STRAIGHT, Vector

PUMP, VALVE, PITCH_DRIVE, STEERING = 1, 2, 4, 8
"""Actuators that disturb the compass while they run, as bits: what runs together is their sum."""

ACTUATORS = {"pump": PUMP, "valve": VALVE, "pitch_drive": PITCH_DRIVE, "steering": STEERING}
"""The same by the words of files."""


class CompassCalibration(NamedTuple):
    """Corrections of the measured field; uT, body frame.

    The Earth's field is `correction` times what is left of the measured field without the hard iron and the fields of
    the actuators that run.
    """

    hard_iron: Vector = (0.0, 0.0, 0.0)
    """Field of the vehicle's magnets."""
    correction: tuple[Vector, Vector, Vector] = STRAIGHT
    """Inverse of the soft iron's distortion, by rows."""
    pump: Vector | None = None
    """Field of the running pump; None where nobody measured it."""
    valve: Vector | None = None
    """Field of the open valve."""
    pitch_drive: Vector | None = None
    """Field of the running pitch drive."""
    steering: Vector | None = None
    """Field of the running steering motor."""
    strength: tuple[float, float] = (0.0, float("inf"))
    """Strengths of the corrected field that are believed."""

    def field_of(self, running: int) -> tuple[Vector, int]:
        """Sum of the known fields of the actuators that run, and the bits of those that are not known."""
        total, unknown = [0.0, 0.0, 0.0], 0
        for name, bit in ACTUATORS.items():
            if not running & bit:
                continue
            field = getattr(self, name)
            if field is None:
                unknown |= bit
                continue
            for axis in range(3):
                total[axis] += field[axis]
        return (total[0], total[1], total[2]), unknown


def running_bits(pump: bool, valve: bool, pitch_drive: bool, steering: bool) -> int:
    """Bits of the actuators that run."""
    return PUMP * pump | VALVE * valve | PITCH_DRIVE * pitch_drive | STEERING * steering


def words_of(running: int) -> str:
    """Name the actuators of some bits as files do: pump+valve."""
    return "+".join(name for name, bit in ACTUATORS.items() if running & bit)
