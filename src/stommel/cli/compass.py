"""`stommel vehicle calibrate-compass`: from samples of a compass to the calibration that the vehicle flies with."""

from collections.abc import Mapping
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.options import ForceOption, JsonOption
from stommel.cli.output import number, show_table, show_values, show_warnings
from stommel.cli.paths import file_parser, refuse_existing

if TYPE_CHECKING:
    from stommel.onboard.coordination.compass.fitting import CompassFit
    from stommel.onboard.coordination.compass.learning import LearnedField


class IronChoice(StrEnum):
    """What is fitted."""

    both = "both"
    hard = "hard"


def calibrate_compass(
    samples: Annotated[
        str,
        typer.Argument(
            metavar="SAMPLES.csv",
            help="Columns acceleration_x_g, _y_g, _z_g, field_x_ut, _y_ut, _z_ut, and running: the actuators that run.",
        ),
    ],
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", metavar="FILE", parser=file_parser("--output", ".toml"), help="Calibration to write, .toml."
        ),
    ] = None,
    iron: Annotated[
        IronChoice, typer.Option("--iron", help="Hard and soft iron, or hard iron only, which needs less tilt.")
    ] = IronChoice.both,
    name: Annotated[str, typer.Option("--name", help="Vehicle and compass that it is of.")] = "compass",
    force: ForceOption = False,
    as_json: JsonOption = False,
) -> None:
    """Calibrate a compass in its vehicle: hard and soft iron, and the fields of motors and valve.

    Example: stommel vehicle calibrate-compass samples.csv --output compass.toml
    """
    from datetime import UTC, datetime

    from stommel.errors import FileError, Problem
    from stommel.onboard.coordination.compass.calibration_file import write_calibration
    from stommel.onboard.coordination.compass.fitting import CompassFitError, fit_iron
    from stommel.onboard.coordination.compass.learning import LearningError, learn
    from stommel.onboard.coordination.compass.samples_file import read_samples

    refuse_existing(output, force)
    read = read_samples(samples)
    quiet = [bits == 0 for bits in read.running]
    try:
        fit = fit_iron(read.acceleration[quiet], read.field[quiet], soft_iron=iron is IronChoice.both)
        fields = learn(read.field, read.running)
    except (CompassFitError, LearningError) as error:
        raise FileError([Problem(samples, "", str(error))]) from None
    written = []
    if output is not None:
        write_calibration(output, fit, fields, name, datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ"))
        written.append(output)
    finish(_answer(name, fit, fields), written, as_json, lambda answer: _show(answer, fit.warnings))


def _answer(name: str, fit: "CompassFit", fields: Mapping[str, "LearnedField"]) -> dict[str, Any]:
    coverage = fit.coverage
    return {
        "name": name,
        "samples": coverage.samples,
        "hard_iron_ut": fit.hard_iron.tolist(),
        "correction": fit.correction.tolist(),
        "strength_ut": fit.strength_ut,
        "inclination_deg": fit.inclination_deg,
        "residual_ut": fit.residual_ut,
        "residual_inclination_deg": fit.residual_inclination_deg,
        "heading_error_deg": fit.heading_error_deg,
        "raw_heading_error_deg": fit.raw_error_deg,
        "heading_gap_deg": coverage.heading_gap_deg,
        "pitch_deg": [float(angle) for angle in coverage.pitch_deg],
        "roll_deg": [float(angle) for angle in coverage.roll_deg],
        "actuators": [
            {"actuator": name, "field_ut": list(one.field), "error_ut": one.sigma, "runs": one.runs}
            for name, one in fields.items()
        ],
        "warnings": list(fit.warnings),
    }


def _vector(values: list[float], digits: int) -> str:
    return ", ".join(number(value, digits) for value in values)


def _show(answer: dict[str, Any], warnings: tuple[str, ...]) -> None:
    low, high = answer["pitch_deg"]
    port, starboard = answer["roll_deg"]
    show_values(
        f"{answer['name']}: {answer['samples']} samples",
        {
            "hard iron": f"{_vector(answer['hard_iron_ut'], 2)} uT",
            "soft iron's correction": "\n".join(_vector(row, 4) for row in answer["correction"]),
            "Earth's field": f"{answer['strength_ut']:.2f} uT, {answer['inclination_deg']:.2f} deg down",
            "left over": f"{answer['residual_ut']:.3f} uT, {answer['residual_inclination_deg']:.3f} deg",
            "heading": f"{answer['heading_error_deg']:.2f} deg uncertain; the raw one was off by up to "
            f"{answer['raw_heading_error_deg']:.1f} deg",
            "coverage": f"heading with gaps to {answer['heading_gap_deg']:.0f} deg, pitch {low:.0f} to {high:.0f} deg, "
            f"roll {port:.0f} to {starboard:.0f} deg",
        },
    )
    if answer["actuators"]:
        rows = [
            [one["actuator"].replace("_", " "), *(number(value, 2) for value in one["field_ut"]),
             number(one["error_ut"], 2), f"{one['runs']}"]
            for one in answer["actuators"]
        ]  # fmt: skip
        show_table("Fields of what runs", ["actuator", "b1\nuT", "b2\nuT", "b3\nuT", "error\nuT", "runs"], rows)
    show_warnings(warnings)
