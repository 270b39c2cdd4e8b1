"""`stommel budget`: masses and volumes bay by bay, trim weight and foam, reserve of the buoyancy engine."""

from pathlib import Path
from textwrap import fill
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.options import JsonOption, VehicleArgument, load
from stommel.cli.output import WIDTH, number, show_json, show_table, show_values
from stommel.errors import OutputError, StommelError

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
    foam_density: Annotated[float, typer.Option("--foam-density", help="Density of foam to add [kg/m3].")] = 200.0,
    apply: Annotated[
        Path | None, typer.Option("--apply", help="Vehicle file to write, whose rigid body comes from the budget.")
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace an existing file.")] = False,
    plot: Annotated[
        Path | None, typer.Option("--plot", help="Plot to write as PNG and SVG, without its ending.")
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Sum masses and volumes; find trim weight and foam, and what the buoyancy engine has left in a sea area.

    Example: stommel budget zju --density 1010:1027
    """
    if apply is not None and apply.exists() and not force:
        raise OutputError(f"{apply}: already exists; --force replaces it")
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
        from stommel.figures.saving import save_figure

        written += save_figure(budget_figure(study), plot)
    if as_json:
        show_json(_as_json(study, written))
        return
    _show(study)
    for path in written:
        typer.echo(f"wrote {path}")


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
    for warning in study.warnings:
        typer.echo(fill(f"warning: {warning}", WIDTH, subsequent_indent="  "))


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


def _numbers(values: Any) -> list[float]:
    return [float(value) for value in values]


def _as_json(study: "BudgetStudy", written: list[Path]) -> dict[str, Any]:
    found, trimmed, left = study.budget, study.trimming, study.reserve
    return {
        "vehicle": study.vehicle.name,
        "density_kg_m3": list(study.density),
        "total_mass_kg": found.total.mass,
        "displaced_volume_ml": found.volume * 1e6,
        "centre_of_mass_m": _numbers(found.total.centre),
        "centre_of_buoyancy_m": _numbers(found.centre_of_buoyancy),
        "stability_arm_mm": found.stability_arm * 1e3,
        "neutral_density_kg_m3": found.neutral_density,
        "bays": [
            {
                "name": bay.name,
                "flooded": bay.flooded,
                "parts": [part.name for part in bay.parts],
                "mass_kg": bay.mass.mass,
                "displaced_volume_ml": bay.volume * 1e6,
                "centre_of_mass_m": _numbers(bay.mass.centre) if bay.parts else None,
            }
            for bay in found.bays
        ],
        "rigid_body": {
            "mass_kg": found.rigid_body.mass,
            "centre_of_mass_m": _numbers(found.rigid_body.centre),
            "lowest_possible_centre_m": study.highest_lever,
            "inertia_kg_m2": [_numbers(row) for row in found.rigid_body.inertia],
            "file_sum_with_water_kg_m2": [_numbers(row) for row in study.inertia.file_sum],
            "left_for_water_kg_m2": [_numbers(row) for row in study.inertia.left_for_water],
            "spheroid_added_inertia_kg_m2": None if study.inertia.spheroid is None else list(study.inertia.spheroid),
        },
        "moving_mass_kg": found.moving.mass,
        "ballast_kg": found.ballast.mass,
        "trimming": None
        if trimmed is None
        else {
            "density_kg_m3": trimmed.rho,
            "surplus_buoyancy_kg": trimmed.surplus,
            "moment_kg_m": list(trimmed.moment),
            "added": [
                {
                    "material": body.material,
                    "part": body.part or None,
                    "bay": body.bay,
                    "mass_kg": body.mass,
                    "volume_ml": body.volume * 1e6,
                    "position_m": list(body.position),
                }
                for body in trimmed.added
            ],
            "mass_kg": trimmed.mass,
            "displaced_volume_ml": trimmed.volume * 1e6,
            "stability_arm_mm": trimmed.stability_arm * 1e3,
        },
        "reserve": None if left is None else _reserve_json(left),
        "warnings": [{"name": warning.name, "message": warning.message} for warning in study.warnings],
        "written": [str(path) for path in written],
    }


def _reserve_json(left: "Reserve") -> dict[str, Any]:
    return {
        "trimmed_for_kg_m3": left.trimmed_for,
        "compression_ml": left.compression * 1e6,
        "sinks_and_rises_kg_m3": left.sinks_and_rises,
        "design_speed_m_s": left.design_speed,
        "flies_kg_m3": left.flies,
        "rows": [
            {
                "density_kg_m3": row.rho,
                "neutral_ballast_ml": row.neutral * 1e6,
                "to_sink_ml": row.to_dive * 1e6,
                "to_rise_ml": row.to_climb * 1e6,
                "dive_speed_m_s": row.dive_speed,
                "climb_speed_m_s": row.climb_speed,
            }
            for row in left.rows
        ],
    }
