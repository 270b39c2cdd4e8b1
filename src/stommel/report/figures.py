"""Figures as SVG inside the page."""

import re
from typing import TYPE_CHECKING

from stommel.bench.performance_plot import performance_figure
from stommel.design.budget.figure import budget_figure
from stommel.design.drives.figure import drives_figure
from stommel.design.endurance.figure import endurance_figure
from stommel.design.engine.engine_plot import engine_figure
from stommel.design.hull.plot import hull_figure
from stommel.design.study import DesignStudy
from stommel.figures.saving import svg_text
from stommel.report.plots import (
    authority_figure,
    envelope_figure,
    modes_figure,
    planes_of,
    root_locus_figure,
    trim_table_figure,
    turns_figure,
    vehicle_figure,
)

if TYPE_CHECKING:
    from markupsafe import Markup
    from matplotlib.figure import Figure


def inline_svg(figure: "Figure", name: str, description: str) -> "Markup":
    """Return a figure as an <svg> element that scales with the page; `name` keeps its identifiers apart from others."""
    from markupsafe import Markup, escape  # noqa: PLC0415 - comes with jinja2, start-up counts

    text = svg_text(figure)
    text = text[text.index("<svg") :]
    text = re.sub(r'\bid="', f'id="{name}-', text)
    text = re.sub(r'(xlink:href="#|url\(#)', rf"\1{name}-", text)
    width = re.search(r'width="([\d.]+)pt"', text)
    assert width is not None
    opening, rest = text.split(">", 1)
    opening = re.sub(r'\s(width|height)="[\d.]+pt"', "", opening)
    pixels = round(float(width.group(1)) * 96 / 72)
    panels = "single" if text.count('<g id="' + name + "-axes_") == 1 else "several"
    opening += f' class="plot {panels}" style="max-width:{pixels}px" role="img" aria-label="{escape(description)}"'
    return Markup(f"{opening}>{rest}")


def figures(study: DesignStudy) -> dict[str, "Markup"]:
    """Every figure of the report by name."""
    found = {
        "vehicle": inline_svg(vehicle_figure(study.vehicle), "vehicle", "Side view of the vehicle to scale"),
        "modes": inline_svg(modes_figure(study), "modes", "Eigenvalues in the complex plane"),
    }
    for k, table in enumerate(study.tables):
        found[f"trim-{k}"] = inline_svg(trim_table_figure(table), f"trim{k}", f"Curves of {table.title}")
    if study.envelope is not None:
        found["envelope"] = inline_svg(envelope_figure(study), "envelope", "Reachable speeds against pitch")
    if study.turns:
        found["turns"] = inline_svg(turns_figure(study), "turns", "Turning flight against turn rate")
    if study.energy is not None:
        drawn = endurance_figure(study.energy)
        found["endurance"] = inline_svg(drawn, "endurance", "Energy by part, sensitivities, endurance against speed")
    if study.hull is not None:
        found["hull"] = inline_svg(hull_figure(study.hull), "hull", "Pressure against wall, and mass by material")
    if study.engine is not None:
        drawn = engine_figure(study.engine.deep)
        found["engine"] = inline_svg(drawn, "engine", "Piston, flow, pressures, power, current and voltage over time")
    if study.motor_speed is not None:
        speed = study.motor_speed
        drawn = performance_figure(speed.points, generated=True, engine=speed.engine, choice=speed.choice)
        found["motor-speed"] = inline_svg(drawn, "motorspeed", "Current and consumption against motor speed")
    if study.drives is not None:
        drawn = drives_figure(study.drives)
        found["drives"] = inline_svg(drawn, "drives", "Moving mass against pitch, rudder against angle")
    if study.budget is not None:
        drawn = budget_figure(study.budget)
        found["budget"] = inline_svg(drawn, "budget", "Masses and volumes along the hull")
    for k, locus in enumerate(study.loci):
        drawn = root_locus_figure(locus, modes=study.modes)
        found[f"locus-{k}"] = inline_svg(drawn, f"locus{k}", f"Root locus over {locus.over}")
        for plane in planes_of(locus):
            drawn = authority_figure(locus, plane, study.modes)
            name = f"authority-{k}-{plane}"
            found[name] = inline_svg(drawn, name, f"Stability against authority over {locus.over}, {plane}")
    return found
