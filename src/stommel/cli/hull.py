"""`stommel hull`: wall, mass and collapse depth of the pressure hull in each material."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stommel.cli.finish import finish
from stommel.cli.numbers import number_option
from stommel.cli.options import DEPTHS, JsonOption, VehicleArgument, load
from stommel.cli.output import number, show_notes, show_table, show_values, show_warnings
from stommel.cli.paths import PlotOption

if TYPE_CHECKING:
    from stommel.design.hull.sizing import SizedHull
    from stommel.design.hull.study import HullStudy


def hull(
    vehicle: VehicleArgument = "zju",
    material: Annotated[
        list[str] | None, typer.Option("--material", help="A material; again for more. All known ones if left out.")
    ] = None,
    depth: Annotated[
        float | None, number_option("--depth", *DEPTHS, "m", "Working depth; the file's if left out")
    ] = None,
    pressure: Annotated[
        float | None, number_option("--pressure-mpa", 0.001, 200, "MPa", "Working pressure instead of a depth")
    ] = None,
    wall: Annotated[
        float | None, number_option("--wall", 0.1, 200, "mm", "Wall to judge instead of the one that is needed")
    ] = None,
    knock_down: Annotated[
        float | None,
        number_option(
            "--knock-down", 0.1, 1, "", "Share of a perfect tube's buckling pressure that is left; the file's"
        ),
    ] = None,
    materials_file: Annotated[Path | None, typer.Option("--materials", help="TOML file of further materials.")] = None,
    plot: PlotOption = None,
    as_json: JsonOption = False,
) -> None:
    """Size the pressure hull: walls by Eqs. (8)-(10), mass, collapse depth by every criterion, ranked choice.

    Example: stommel hull zju --material TC4 --material 6061-T6 --depth 300
    """
    from stommel.design.hull.study import hull_study

    study = hull_study(
        load(vehicle), materials=material, depth_m=depth, pressure_mpa=pressure, wall_mm=wall,
        knock_down=knock_down, materials_file=materials_file,
    )  # fmt: skip
    written = []
    if plot is not None:
        from stommel.design.hull.plot import hull_figure
        from stommel.figures.saving import save_figure_as

        written.append(save_figure_as(hull_figure(study), plot))
    own = study.own is not None and not material and wall is None
    finish(study, written, as_json, lambda study: _show(study, own=own))


def _show(study: "HullStudy", *, own: bool) -> None:
    _show_materials(study)
    _show_criteria(study.own if own and study.own is not None else study.hulls[0], own)
    reasons = {f"{row.place}. {row.hull.material.name}": row.reasons for row in study.ranking}
    typer.echo("Why in this order")
    show_notes(f"{name}: " + "; ".join(line.rstrip(".") for line in lines) for name, lines in reasons.items())
    if study.choice:
        show_notes([study.choice[0].upper() + study.choice[1:]])
    if study.published:
        _show_published(study)
    show_notes(study.requirement.notes, "note")
    show_warnings(study.warnings)


def _show_materials(study: "HullStudy") -> None:
    need = study.requirement
    rows = []
    for ranking in study.ranking:
        row = ranking.hull.as_row()
        rows.append(
            [
                str(ranking.place),
                row["name"],
                number(row["yield_wall_mm"], 1),
                number(row["circumferential_wall_mm"], 2),
                number(row["wall_mm"], 1) + _mark(ranking.hull),
                number(row["axial_critical_stress_mpa"], 1),
                number(row["mass_kg"], 1),
                number(row["collapse_depth_m"], 0),
                number(ranking.score, 3),
            ]
        )
    notes = [words for mark, words in _MARKS.items() if any(mark in row[4] for row in rows)]
    show_table(
        f"{study.vehicle.name}: pressure hull for {need.P / 1e6:.4g} MPa, {need.depth:.4g} m",
        ["#", "material", "yield\nmm", "buckl.\nmm", "wall\nmm", "axial\nMPa", "mass\nkg", "collapse\nm", "score"],
        rows,
        notes,
    )


_MARKS = {
    "!": "! fails a criterion at the checked length; the reasons below name it",
    "+": "+ thicker than Eqs. (8) to (10) ask, for a criterion that the reasons below name",
    "*": "* leaves less than the inner diameter that the file wants",
}


def _mark(hull: "SizedHull") -> str:
    """What to know of the wall at a glance."""
    thin = bool(hull.failed) or hull.tube.delta < hull.exact_wall - 1e-9
    return ("!" if thin else "+" if hull.raised_for else "") + ("" if hull.fits else "*")


def _show_criteria(hull: "SizedHull", own: bool) -> None:
    tube = hull.tube
    whose = "hull of the vehicle file" if own else "first of the list"
    rows = [
        [
            criterion.name.replace("circumferential", "circumf.")
            + (f" (n = {criterion.lobes})" if criterion.lobes else ""),
            criterion.family,
            number(criterion.pressure / 1e6, 2),
            number(hull.depth(criterion.pressure), 0),
            number(hull.depth(criterion.permissible), 0),
        ]
        for criterion in hull.criteria
    ]
    title = f"{hull.material.name}, wall {tube.delta * 1e3:.4g} mm ({whose}): each criterion"
    show_table(title, ["criterion", "", "reached at\nMPa", "depth\nm", "with safety\nm"], rows)
    caps = hull.as_row()["end_caps"]
    show_values(
        "",
        {
            "mass of the tube": number(tube.mass, 2, "kg"),
            "displaced volume": number(tube.displaced_volume * 1e3, 2, "l"),
            "compressibility": f"{tube.compressibility:.3e} 1/Pa, for hull.compressibility_per_pa",
            "end caps": f"flat {number(caps['flat_supported_mm'], 1)} mm (clamped "
            f"{number(caps['flat_clamped_mm'], 1)} mm), hemisphere {number(caps['hemisphere_mm'], 1)} mm",
        },
    )
    typer.echo()


def _show_published(study: "HullStudy") -> None:
    typer.echo()
    rows = [
        [
            row.material,
            f"{row.quantity}, {row.unit}",
            number(row.printed, row.digits),
            number(row.found, row.digits),
            f"{100 * row.difference:+.1f} %",
        ]
        for row in study.published
    ]
    remarks = [f"{row.material}, {row.quantity}: {row.remark}" for row in study.published if not row.agrees]
    show_table("Table 4 of the paper", ["material", "quantity", "printed", "found", "difference"], rows, remarks)
