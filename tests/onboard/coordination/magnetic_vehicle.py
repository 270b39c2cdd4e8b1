"""A vehicle of iron and motors in the Earth's field, as the plant has it, felt in the compass's own axes."""

from dataclasses import dataclass
from math import asin, cos, degrees, pi, radians, sin

import numpy as np
from numpy.typing import NDArray

from stommel.onboard.coordination.compass.calibration import ACTUATORS, PITCH_DRIVE, PUMP, STEERING, VALVE
from stommel.onboard.coordination.compass.heading import Vector
from stommel.simulation.plant.sensors import Sensors, sensors_of
from tests.simulation.conftest import EXACT, made, mission_document

STRENGTH = 49.0
"""Of the Earth's field [uT]; 35 uT in the Bay of Bengal, 60 in Canada."""
HARD_IRON = (9.0, -14.0, 6.0)
SOFT_IRON = ((1.08, 0.03, -0.02), (0.01, 0.93, 0.04), (0.03, -0.05, 1.02))
ALL = PUMP | VALVE | PITCH_DRIVE | STEERING
"""What runs."""
_DIRECTIONS = {
    "pump": (0.5, 0.6, 0.3),
    "valve": (0.3, 0.2, -0.4),
    "pitch_drive": (-0.1, 0.5, 0.2),
    "steering": (0.2, -0.3, 0.5),
}


@dataclass(frozen=True)
class MagneticVehicle:
    """Errors of the paper's vehicle: its raw heading is off by 35 deg while motors and valve run (section 5.2)."""

    inclination: float
    """Of the Earth's field [deg]."""
    tilt_noise: float = 0.2
    """Of the direction down [deg]."""
    field_noise: float = 0.1
    """Of each magnetometer [uT]."""
    level: float = 35.0
    """Largest error of a level heading while everything runs [deg]."""

    def fields(self) -> dict[str, NDArray[np.float64]]:
        """Fields of the actuators [uT], which together turn a level heading by `level`."""
        sums = np.sum(list(_DIRECTIONS.values()), axis=0)
        scale = STRENGTH * cos(radians(self.inclination)) * sin(radians(self.level)) / np.hypot(sums[0], sums[1])
        return {name: scale * np.array(vector) for name, vector in _DIRECTIONS.items()}

    def to_body(self, phi: float, theta: float, psi: float) -> NDArray[np.float64]:
        """Rotation from north, east, down; by turning about one axis after the other."""
        (s1, s2, s3), (c1, c2, c3) = np.sin([phi, theta, psi]), np.cos([phi, theta, psi])
        about_b1 = np.array([[1, 0, 0], [0, c1, s1], [0, -s1, c1]])
        about_b2 = np.array([[c2, 0, -s2], [0, 1, 0], [s2, 0, c2]])
        about_b3 = np.array([[c3, s3, 0], [-s3, c3, 0], [0, 0, 1]])
        rotation: NDArray[np.float64] = about_b1 @ about_b2 @ about_b3
        return rotation

    def felt(
        self, phi: float, theta: float, psi: float, running: int, noise: np.random.Generator
    ) -> tuple[Vector, Vector]:
        """Acceleration [g] and field [uT] that the compass tells; angles in radians."""
        R, dip = self.to_body(phi, theta, psi), radians(self.inclination)
        down = R[:, 2] + radians(self.tilt_noise) * noise.standard_normal(3)
        b = np.array(SOFT_IRON) @ R @ (STRENGTH * np.array([cos(dip), 0.0, sin(dip)])) + HARD_IRON
        for name, bit in ACTUATORS.items():
            if running & bit:
                b = b + self.fields()[name]
        b = b + self.field_noise * noise.standard_normal(3)
        return (down[0], down[1], down[2]), (b[0], b[1], b[2])

    def sensors(self) -> Sensors:
        """The same as the plant's compass has it, in units of the Earth's field and without noise."""
        fields = {f"{name}_field": list(value / STRENGTH) for name, value in self.fields().items()}
        keys = {
            "magnetic_inclination_deg": self.inclination,
            "hard_iron": [h / STRENGTH for h in HARD_IRON],
            "soft_iron": [list(row) for row in SOFT_IRON],
        }
        return sensors_of(made(mission_document(sensors=EXACT | keys | fields)).scenario)

    def turned_about(
        self, count: int, noise: np.random.Generator, pitch: float = 50.0, roll: float = 60.0
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Accelerations, fields and angles (phi, theta, psi) of samples at all headings, to pitch and roll [deg]."""
        angles = np.column_stack(
            [
                radians(roll) * noise.uniform(-1, 1, count),
                radians(pitch) * noise.uniform(-1, 1, count),
                noise.uniform(-pi, pi, count),
            ]
        )
        told = [self.felt(*row, 0, noise) for row in angles]
        return np.array([a for a, _ in told]), np.array([b for _, b in told]), angles


def away(found: float, true: float) -> float:
    """Size of the difference of two angles [deg]."""
    return abs(degrees(asin(sin(found - true)))) if cos(found - true) > 0 else 180.0


def samples_text(vehicle: MagneticVehicle, noise: np.random.Generator) -> str:
    """Samples of a vehicle turned about on land, then of the pump, the valve with it, and the pitch drive."""
    lines = ["acceleration_x_g,acceleration_y_g,acceleration_z_g,field_x_ut,field_y_ut,field_z_ut,running"]
    acceleration, field, _ = vehicle.turned_about(200, noise)
    rows = [(tuple(a), tuple(b), "") for a, b in zip(acceleration, field, strict=True)]
    for run in ("pump", "pump+valve", "pitch_drive"):
        bits = sum(ACTUATORS[name] for name in run.split("+"))
        for now, word in [(0, "")] * 10 + [(bits, run)] * 10 + [(0, "")] * 10:
            rows.append((*vehicle.felt(0.0, -0.2, 1.0, now, noise), word))
    return "\n".join([*lines, *(",".join([*(f"{x:.6f}" for x in (*a, *b)), word]) for a, b, word in rows)]) + "\n"
