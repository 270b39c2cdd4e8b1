"""`stommel budget`: masses and volumes bay by bay, trim weight and foam, reserve of the buoyancy engine."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.numbers import number_option
from stommel.cli.options import ForceOption, JsonOption, VehicleArgument, load
from stommel.cli.output import number, show_table, show_values, show_warnings
from stommel.cli.paths import PlotOption, file_parser, refuse_existing
from stommel.errors import StommelError

if TYPE_CHECKING:
    from stommel.design.budget import BudgetStudy, Reserve, Trimming


def budget(
    vehicle: VehicleArgument,
    density: Annotated[
        str | None,
        typer.Option(
            "--density", help="Density of the water [kg/m3], or least:greatest of a sea area; the file's if left out."
        ),
    ] = None,
    foam_density: Annotated[float, number_option("--foam-density", 10, 950, "kg/m3", "Density of foam to add")] = 200.0,
    apply: Annotated[
        Path | None,
        typer.Option(
            "--apply",
            metavar="FILE",
            parser=file_parser("--apply", ".toml"),
            help="Vehicle file to write, whose rigid body comes from the budget.",
        ),
    ] = None,
    force: ForceOption = False,
    plot: PlotOption = None,
    as_json: JsonOption = False,
) -> None:
    """Sum masses and volumes; find trim weight and foam, and what the buoyancy engine has left in a sea area.

    Example: stommel budget zju --density 1010:1027
    """
    refuse_existing(apply, force)
    from stommel.design.budget import budget_study

    glider = load(vehicle)
    study = budget_study(glider, _density(density), foam_density_kg_m3=foam_density)
    written: list[Path] = []
    if apply is not None:
        from stommel.design.budget import applied_text
        from stommel.files.whole import write_whole
        from stommel.vehicle import vehicle_text

        write_whole(apply, applied_text(study, vehicle_text(vehicle)))
        written.append(apply)
    if plot is not None:
        from stommel.design.budget.figure import budget_figure
        from stommel.figures.saving import save_figure_as

        written.append(save_figure_as(budget_figure(study), plot))
    finish(study, written, as_json, _show)


def _density(text: str | None) -> float | tuple[float, float] | None:
    if text is None:
        return None
    try:
        values = [float(part) for part in text.split(":")]
    except ValueError:
        values = []
    if len(values) == 1:
        return values[0]
    if len(values) == 2:
        return values[0], values[1]
    raise StommelError(f"--density = {text!r}: must be a number or a range like 1010:1027, in kg/m3")


def _show(study: "BudgetStudy") -> None:
    found = study.budget
    rows = [
        [
            bay.name + (" (flooded)" if bay.flooded else ""),
            str(len(bay.parts)),
            number(bay.mass.mass, 3),
            number(bay.volume * 1e3, 3),
            number(bay.mass.centre[0] if bay.parts else None, 3),
        ]
        for bay in found.bays
    ]
    parts = study.vehicle.description.parts
    total = [number(found.total.mass, 3), number(found.volume * 1e3, 3), number(found.total.centre[0], 3)]
    rows.append(["total", str(len(parts)), *total])
    columns = ["bay", "parts", "mass\nkg", "volume\nl", "centre\nm"]
    show_table(f"{study.vehicle.name}: mass and volume budget", columns, rows)
    body, J = found.rigid_body, found.rigid_body.inertia
    show_values(
        "For the equations of motion",
        {
            "m_rb, m_p, m_b": f"{body.mass:.3f}, {found.moving.mass:.3f}, {found.ballast.mass:.3f} kg",
            "r_rb": f"{_vector(body.centre)} m",
            "J_rb about origin": f"{J[0, 0]:.3f}, {J[1, 1]:.3f}, {J[2, 2]:.3f} kg m2; xz {J[0, 2]:.3f}",
            "left for the water": ", ".join(f"{study.inertia.left_for_water[k, k]:.3f}" for k in range(3)) + " kg m2",
            "spheroid's water": "unknown"
            if study.inertia.spheroid is None
            else ", ".join(f"{value:.3f}" for value in study.inertia.spheroid) + " kg m2",
            "centre of buoyancy": f"{_vector(found.centre_of_buoyancy)} m",
            "centre of mass": f"{found.stability_arm * 1e3:.2f} mm below it",
            "neutral in": f"{found.neutral_density:.2f} kg/m3",
        },
    )
    if study.trimming is not None:
        _show_trimming(study.trimming)
    if study.reserve is not None:
        _show_reserve(study.reserve)
    show_warnings(study.warnings)


def _vector(r: Any) -> str:
    return "(" + ", ".join(f"{round(float(value), 4) + 0.0:.4f}" for value in r) + ")"


def _show_trimming(trimmed: "Trimming") -> None:
    values = {"as it is": f"{trimmed.surplus:+.3f} kg of buoyancy, {trimmed.moment[0]:+.4f} kg m along the hull"}
    for body in trimmed.added:
        size = f"{abs(body.mass):.3f} kg ({body.volume * 1e3:.3f} l)"
        name = {"lead": "add trim weight", "foam": "add foam", "removed": "take out"}[body.material]
        where = f"of {body.part!r}" if body.part else f"at {_vector(body.position)} m"
        while name in values:
            name += " "
        values[name] = f"{size} {where}"
    if not trimmed.added:
        values["to add"] = "nothing"
    values["trimmed"] = f"{trimmed.mass:.3f} kg, centre of mass {trimmed.stability_arm * 1e3:.2f} mm low"
    show_values(f"Neutral and level in {trimmed.rho:.2f} kg/m3", values)


def _show_reserve(left: "Reserve") -> None:
    rows = [
        [
            number(row.rho, 2),
            number(row.neutral * 1e6, 1),
            number(row.to_dive * 1e6, 1),
            number(row.to_climb * 1e6, 1),
            number(row.dive_speed, 2),
            number(row.climb_speed, 2),
        ]
        for row in left.rows
    ]
    columns = ["density\nkg/m3", "neutral at\nml", "to sink\nml", "to rise\nml", "dives at\nm/s", "climbs at\nm/s"]
    notes = [f"trimmed for {left.trimmed_for:.2f} kg/m3; the hull loses {left.compression * 1e6:.1f} ml at depth"]
    if left.sinks_and_rises is not None:
        notes.append("sinks and rises from {:.2f} to {:.2f} kg/m3".format(*left.sinks_and_rises))
    if left.flies is not None and left.design_speed is not None:
        band = "{:.2f} to {:.2f} kg/m3".format(*left.flies)
        notes.append(f"flies at {left.design_speed:g} m/s both ways from {band}")
    show_table("Reserve of the buoyancy engine", columns, rows, notes)
