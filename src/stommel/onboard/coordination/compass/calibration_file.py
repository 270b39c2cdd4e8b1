"""The calibration of a compass as a file: TOML, so that a person sees what the vehicle believes of its own iron."""

from collections.abc import Iterable
from math import inf
from pathlib import Path
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from stommel.files.fields import Name, Table
from stommel.files.kinds import Format
from stommel.files.ranges import between
from stommel.files.toml_reader import read_table
from stommel.files.whole import write_whole
from stommel.onboard.coordination.compass.calibration import ACTUATORS, CompassCalibration
from stommel.onboard.coordination.compass.fitting import CompassFit
from stommel.onboard.coordination.compass.heading import STRAIGHT
from stommel.onboard.coordination.compass.learning import LearnedField

MicroTesla = Annotated[float, between(-500, 500)]
"""Of a magnet or a motor on an axis of the body frame."""
FieldVector = tuple[MicroTesla, MicroTesla, MicroTesla]
_Share = Annotated[float, between(-10, 10)]
_Row = tuple[_Share, _Share, _Share]
_Angle = Annotated[float, between(-180, 180)]
_BELIEVED = (0.75, 1.25)
"""Strengths that are believed, over that of the samples: the sea that a mission covers has no wider ones."""


class ActuatorFields(Table):
    """Fields of the actuators while they run, in the body frame, as the magnetometers feel them; they add.

    Of one that is left out the heading is held while it runs.
    """

    pump: FieldVector | None = None
    """Field of the running pump [uT]."""
    valve: FieldVector | None = None
    """Field of the open valve [uT]."""
    pitch_drive: FieldVector | None = None
    """Field of the running pitch drive [uT]."""
    steering: FieldVector | None = None
    """Field of the running steering motor [uT]."""


class Quality(Table):
    """How good the samples were; only people read it."""

    samples: Annotated[int, Field(strict=True, ge=0, le=10_000_000)]
    """Samples that the iron was fitted to."""
    inclination_deg: Annotated[float, between(-90, 90)]
    """Of the Earth's field where they were taken."""
    residual_ut: Annotated[float, between(0, 100)]
    """Root mean square of what the fit leaves of the strength."""
    residual_inclination_deg: Annotated[float, between(0, 90)]
    """The same of the inclination."""
    heading_error_deg: Annotated[float, between(0, 180)]
    """Standard error of a heading by this calibration."""
    heading_gap_deg: Annotated[float, between(0, 360)]
    """Widest gap between neighbouring headings."""
    pitch_deg: tuple[_Angle, _Angle]
    """Lowest and highest."""
    roll_deg: tuple[_Angle, _Angle]
    """Lowest and highest."""


class CalibrationFile(Table):
    """A calibration of a compass in its vehicle."""

    format: Format
    kind: Literal["compass calibration"]
    name: Name = "compass"
    """Vehicle and compass that it was made of."""
    made: Annotated[str, Field(max_length=40)] = ""
    """When."""
    strength_ut: Annotated[float, between(5, 200)] = 48.0
    """Of the Earth's field where the samples were taken."""
    believed_ut: tuple[Annotated[float, between(0, 500)], Annotated[float, between(0, 500)]] | None = None
    """Strengths of the corrected field that are believed; while it is another the heading is held."""
    hard_iron_ut: FieldVector
    """Field of the vehicle's magnets in the body frame."""
    correction: tuple[_Row, _Row, _Row] = STRAIGHT
    """Soft iron undone: the Earth's field is this times the measured one without the hard iron."""
    actuator_ut: ActuatorFields = ActuatorFields()
    quality: Quality | None = None

    @model_validator(mode="after")
    def _can_be_applied(self) -> Self:
        if not 0.05 < float(np.linalg.det(self.correction)) < 20.0:
            raise ValueError(
                f"correction: its determinant is {np.linalg.det(self.correction):.3g}; must be between 0.05 and 20"
            )
        if self.believed_ut is not None and self.believed_ut[0] >= self.believed_ut[1]:
            raise ValueError(f"believed_ut = {list(self.believed_ut)}: the first number must be less than the second")
        return self

    @property
    def calibration(self) -> CompassCalibration:
        """What the vehicle's software goes by."""
        fields = {name: getattr(self.actuator_ut, name) for name in ACTUATORS}
        return CompassCalibration(self.hard_iron_ut, self.correction, **fields, strength=self.believed_ut or (0.0, inf))


def read_calibration(path: str | Path) -> CompassCalibration:
    """Read a calibration of a compass.

    Raises
    ------
    FileError
        The file cannot be read, is not TOML, or one problem for each wrong key.
    """
    return read_table(path, CalibrationFile).calibration


def calibration_text(fit: CompassFit, fields: dict[str, LearnedField], name: str, made: str) -> str:
    """Text of the file of a calibration."""
    import tomlkit  # noqa: PLC0415 - only who writes a calibration needs it

    document = tomlkit.document()
    document.add(tomlkit.comment("Calibration of a compass in its vehicle: the Earth's field is"))
    document.add(tomlkit.comment("correction (measured - hard_iron - fields of the actuators that run); body frame."))
    document.update({"format": 1, "kind": "compass calibration", "name": name, "made": made})
    document["strength_ut"] = round(fit.strength_ut, 3)
    document["believed_ut"] = [round(share * fit.strength_ut, 1) for share in _BELIEVED]
    document["hard_iron_ut"] = _rounded(fit.hard_iron, 4)
    rows = tomlkit.array()
    rows.extend([_rounded(row, 7) for row in fit.correction])
    document["correction"] = rows.multiline(True)
    actuators = tomlkit.table()
    for actuator, learned in fields.items():
        actuators[actuator] = _rounded(learned.field, 4)
        actuators[actuator].comment(f"+-{learned.sigma:.2f}, of {learned.runs} runs")
    document["actuator_ut"] = actuators
    coverage = fit.coverage
    document["quality"] = {
        "samples": coverage.samples,
        "inclination_deg": round(fit.inclination_deg, 3),
        "residual_ut": round(fit.residual_ut, 4),
        "residual_inclination_deg": round(fit.residual_inclination_deg, 4),
        "heading_error_deg": round(fit.heading_error_deg, 4),
        "heading_gap_deg": round(coverage.heading_gap_deg, 1),
        "pitch_deg": _rounded(coverage.pitch_deg, 1),
        "roll_deg": _rounded(coverage.roll_deg, 1),
    }
    return tomlkit.dumps(document)


def _rounded(values: Iterable[float], digits: int) -> list[float]:
    return [round(float(value), digits) for value in values]


def write_calibration(path: Path, fit: CompassFit, fields: dict[str, LearnedField], name: str, made: str) -> None:
    """Write a calibration, whole or not at all.

    Raises
    ------
    OutputError
        It cannot be written there.
    """
    write_whole(path, calibration_text(fit, fields, name, made))
