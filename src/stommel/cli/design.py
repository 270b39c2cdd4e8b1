"""`stommel design`: the whole analysis of a vehicle, with a report."""

from math import degrees
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.options import JsonOption, PhysicsChoice, PhysicsOption, VehicleArgument, load, physics_of
from stommel.cli.output import show_notes, show_table, show_values
from stommel.cli.paths import file_parser
from stommel.cli.vehicle_check import show_vehicle_check
from stommel.files.units import counted

if TYPE_CHECKING:
    from stommel.design.specification import SpecificationRow
    from stommel.design.study import DesignStudy


_REPORT = file_parser("--output", ".html")


def design(
    vehicle: VehicleArgument = "zju",
    output: Annotated[
        Path | None,
        typer.Option(
            "--output",
            "-o",
            metavar="FILE",
            parser=_REPORT,
            help="Report to write, .html; VEHICLE-design.html in this folder if left out.",
        ),
    ] = None,
    physics: PhysicsOption = PhysicsChoice.paper,
    report: Annotated[bool, typer.Option("--report/--no-report", help="Write the HTML report.")] = True,
    as_json: JsonOption = False,
) -> None:
    """Design by dynamic-model analysis: trim, ranges, envelope, stability, turns, specification; terminal and HTML.

    Example: stommel design zju --output build/zju.html
    """
    from stommel.design.study import design_study

    glider = load(vehicle)
    path = (output or _REPORT(f"{Path(vehicle).stem}-design.html")) if report else None
    study = design_study(glider, physics=physics_of(physics), progress=_progress(as_json))
    written = []
    if path is not None:
        from stommel.report import write_report

        write_report(study, path)
        written.append(path)
    finish(study, written, as_json, _show)


def _progress(quiet: bool) -> Any:
    """Name each part on standard error while a person waits."""
    import sys

    if quiet or not sys.stderr.isatty():
        return lambda part: None  # noqa: ARG005 - silence
    return lambda part: typer.echo(f"\r\033[K{part} ...\r", err=True, nl=False)


def _show(study: "DesignStudy") -> None:
    glider = study.vehicle
    show_values(f"{glider.name}: design by dynamic-model analysis", _verdict(study))
    if study.specification:
        rows = [
            [
                row.name,
                _with_unit(f"{row.required:g}", row.unit),
                _found(row),
                {True: "met", False: "NOT MET", None: "not known"}[row.met],
            ]
            for row in study.specification
        ]
        show_table("Specification", ["requirement", "required", "found", ""], rows)
    rows = [
        [mode.name, f"{mode.eigenvalue.real:.4f}", f"{abs(mode.eigenvalue.imag):.4f}", f"{mode.time_to_half:.2f}"]
        for mode in (*study.modes.longitudinal, *(study.modes.lateral or ()))
        if mode.eigenvalue.imag >= 0.0
    ]
    show_notes((f"{row.name}: {row.how}" for row in study.specification if row.found is None), "note")
    flight = study.design_flight
    title = f"Modes at {flight.V:g} m/s, pitch {degrees(flight.theta):g} deg"
    show_table(title, ["mode", "real\n1/s", "imaginary\n1/s", "time to half\ns"], rows)
    show_notes((f"this flight {excess}" for excess in study.design_flight_excesses), "note")
    show_notes(study.notes, "note")
    show_vehicle_check(study.check.as_row())
    if study.unanswered:
        parts = ", ".join(part for part, _ in study.unanswered)
        show_notes([f"{parts}: the report and --json say why"], "not answered")


def _found(row: "SpecificationRow") -> str:
    """What the vehicle has; "none" where it was looked for and there is none."""
    if row.found is not None:
        return _with_unit(f"{row.found:.4g}", row.unit)
    return "none" if row.met is False else "-"


def _with_unit(text: str, unit: str) -> str:
    return counted(text, "day") if unit == "days" else f"{text} {unit}"


def _verdict(study: "DesignStudy") -> dict[str, str]:
    values = {}
    if study.ranges is not None:
        r = study.ranges
        values["moving-mass travel"] = f"±{r.moving_mass_mm:.1f} mm needed, choose ±{r.moving_mass_choice_mm:g} mm"
        values["ballast volume"] = f"±{r.ballast_ml:.1f} ml needed, choose ±{r.ballast_choice_ml:g} ml"
    for table in study.tables:
        worst = table.worst()
        if worst is not None:
            title = table.title.split(":")[0]
            values[title] = f"within {worst[0]:.3f} mm, {worst[1]:.4f} deg, {worst[2]:.3f} ml of the published rows"
    if study.best is not None:
        best, fast = study.best.best_glide, study.best.fastest
        values["best glide"] = f"{best.glide_ratio:.2f} : 1 on a path of {degrees(best.gamma):.1f} deg"
        values["best glide"] += "".join(f"; {remark}" for remark in study.best.glide_remarks)
        values["fastest over ground"] = f"{fast.horizontal_speed:.3f} m/s at pitch {degrees(fast.theta):.1f} deg"
        values["fastest over ground"] += "".join(f"; {remark}" for remark in study.best.fastest_remarks)
    values["stability"] = "every mode dies out" if study.modes.stable else "a mode grows: see the table of modes"
    if study.turns:
        tightest = study.turns[-1]
        values["tightest turn computed"] = f"radius {tightest.radius:.1f} m at {degrees(tightest.turn_rate):.2f} deg/s"
    return values
