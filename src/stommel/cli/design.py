"""`stommel design`: the whole analysis of a vehicle, with a report."""

from math import degrees
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.options import JsonOption, PhysicsChoice, PhysicsOption, VehicleArgument, load, physics_of
from stommel.cli.output import show_json, show_table, show_values

if TYPE_CHECKING:
    from stommel.design.study import DesignStudy


def design(
    vehicle: VehicleArgument = "zju",
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="Report to write; VEHICLE-design.html in this folder if left out."),
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
    path = output or Path(f"{Path(vehicle).stem}-design.html")
    study = design_study(glider, physics=physics_of(physics), progress=_progress(as_json))
    if report:
        from stommel.report import write_report

        write_report(study, path)
    if as_json:
        show_json(_as_json(study, path if report else None))
        return
    _show(study)
    if report:
        typer.echo(f"report: {path}")


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
                f"{row.required:g} {row.unit}",
                "-" if row.found is None else f"{row.found:.4g} {row.unit}",
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
    flight = study.design_flight
    title = f"Modes at {flight.V:g} m/s, pitch {degrees(flight.theta):g} deg"
    show_table(title, ["mode", "real\n1/s", "imaginary\n1/s", "time to half\ns"], rows)
    for note in study.notes:
        show_values("Note", {"": note})
    for part, reason in study.unanswered:
        show_values("Not answered", {part: reason})


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
        values["fastest over ground"] = f"{fast.horizontal_speed:.3f} m/s at pitch {degrees(fast.theta):.1f} deg"
    values["stability"] = "every mode dies out" if study.modes.stable else "a mode grows: see the table of modes"
    if study.turns:
        tightest = study.turns[-1]
        values["tightest turn computed"] = f"radius {tightest.radius:.1f} m at {degrees(tightest.turn_rate):.2f} deg/s"
    return values


def _as_json(study: "DesignStudy", path: Path | None) -> dict[str, Any]:
    from dataclasses import asdict

    return {
        "vehicle": study.vehicle.name,
        "specification": [asdict(row) for row in study.specification],
        "tables": [
            {
                "title": table.title,
                "rows": [
                    row.trim.flight.as_row()
                    | {
                        "beyond_limits": [str(excess) for excess in row.trim.beyond],
                        "published": asdict(row.published) if row.published is not None else None,
                    }
                    for row in table.rows
                ],
            }
            for table in study.tables
        ],
        "envelope": [row.as_row() for row in study.envelope] if study.envelope is not None else None,
        "ranges": study.ranges.as_row() if study.ranges is not None else None,
        "best_glide": study.best.best_glide.as_turn() if study.best is not None else None,
        "fastest": study.best.fastest.as_turn() if study.best is not None else None,
        "longitudinal": [mode.as_row() for mode in study.modes.longitudinal],
        "lateral": [mode.as_row() for mode in study.modes.lateral] if study.modes.lateral is not None else None,
        "authority": study.authority.as_row(),
        "turns": [flight.as_turn() for flight in study.turns],
        "notes": list(study.notes),
        "unanswered": dict(study.unanswered),
        "report": str(path) if path is not None else None,
    }
