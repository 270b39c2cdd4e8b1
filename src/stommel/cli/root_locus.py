"""`stommel root-locus`: how the modes move as one number of the design changes."""

from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.design_flight import design_pitch, design_speed
from stommel.cli.finish import finish
from stommel.cli.numbers import count_option, number_option
from stommel.cli.options import (
    JsonOption,
    PhysicsChoice,
    PhysicsOption,
    PitchOption,
    SpeedOption,
    VehicleArgument,
    load,
    physics_of,
)
from stommel.cli.output import number, show_table
from stommel.cli.paths import PlotOption

if TYPE_CHECKING:
    import numpy as np

    from stommel.analysis import RootLocus


VALUES = (-1e6, 1e6)
"""Of any number of a vehicle file; its own field says what it may be."""


def root_locus(
    vehicle: VehicleArgument,
    over: Annotated[
        str,
        typer.Option(
            "--over",
            help="What varies: wing_position or rudder_position (in hull lengths), or the key of any number of the "
            "vehicle file in the file's unit, such as rigid_body.centre_of_mass_m.2",
        ),
    ],
    start: Annotated[float, number_option("--from", *VALUES, "", "First value")],
    stop: Annotated[float, number_option("--to", *VALUES, "", "Last value")],
    points: Annotated[int, count_option("--points", 2, 2000, "How many values")] = 41,
    speed: SpeedOption = None,
    pitch: PitchOption = None,
    physics: PhysicsOption = PhysicsChoice.paper,
    plot: PlotOption = None,
    as_json: JsonOption = False,
) -> None:
    """Follow the eigenvalues, with the trim solved anew at each value, as in Figs. 3 and 4 of the paper.

    Example: stommel root-locus zju --over wing_position --from 0 --to 0.2 --plot build/locus.svg
    """
    from stommel.analysis import root_locus as follow

    glider = load(vehicle)
    locus = follow(
        glider, over, start, stop, points=points, speed_m_s=design_speed(glider, speed),
        pitch_deg=design_pitch(glider, pitch), physics=physics_of(physics),
    )  # fmt: skip
    written = []
    if plot is not None:
        from stommel.figures.saving import save_figure_as
        from stommel.report.plots import root_locus_figure

        written.append(save_figure_as(root_locus_figure(locus), plot))
    finish(locus, written, as_json, lambda locus: _show(glider.name, locus))


def _show(name: str, locus: "RootLocus") -> None:
    rows = []
    last = len(locus.values) - 1
    lateral = locus.lateral
    for k in sorted({round(last * tenth / 10) for tenth in range(11)}):  # both ends, whatever the count
        able = locus.authorities[k]
        rows.append(
            [
                f"{locus.values[k]:.4g}",
                _eigenvalues(locus.longitudinal[k]),
                _eigenvalues(lateral[k]) if lateral is not None else "-",
                number(able.peak_pitch_rate_deg_s_per_mm, 4),
                number(able.turn_rate_deg_s_per_rudder_deg, 3),
            ]
        )
    unit = f"\n{locus.unit}" if locus.unit else ""
    columns = [f"value{unit}", "longitudinal\n1/s", "lateral\n1/s", "peak q\ndeg/s/mm", "turn\n1/s"]
    show_table(f"{name}: eigenvalues over {locus.over}", columns, rows)


def _eigenvalues(values: "np.ndarray[Any, Any]") -> str:
    lines = []
    for value in values:
        if value.imag > 0.0:
            lines.append(f"{value.real:.3f} ± {value.imag:.3f}i")
        elif value.imag == 0.0:
            lines.append(f"{value.real:.3f}")
    return "\n".join(lines)
