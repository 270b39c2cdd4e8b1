"""A side view to scale, of what the vehicle file knows and nothing else."""

from math import cos, pi
from textwrap import fill
from typing import TYPE_CHECKING, Any

import numpy as np

from stommel.figures.style import (
    BLUE,
    FAINT,
    GREEN,
    INK,
    MUTED,
    ORANGE,
    PURPLE,
    SHADE,
    SKY,
    VERMILION,
    new_figure,
    number,
    styled,
)
from stommel.vehicle import Vehicle, VehicleFile

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


@styled
def vehicle_figure(vehicle: Vehicle) -> "Figure":
    """Draw hull, bays, masses with their travel, bladder, wing and rudder about the centre of buoyancy."""
    d = vehicle.description
    radius = d.hull.outer_diameter_mm / 2e3 if d.hull else _reach(d) * 0.11
    (left, right), (low, high) = _limits(d, radius)
    figure = new_figure(9.2, 1.3 + 8.4 * (high - low) / (right - left))
    axes = figure.subplots()
    axes.set_xlim(left, right)
    axes.set_ylim(low, high)
    axes.set_aspect("equal")
    if d.hull is not None:
        _draw_hull(axes, d, radius)
    else:
        axes.axhline(0.0, color=FAINT, linewidth=1.2, linestyle=(0, (9, 3, 2, 3)), zorder=0)
    _draw_bays(axes, d, radius)
    _draw_surfaces(axes, d)
    _draw_masses(axes, d)
    axes.plot(0.0, 0.0, marker="+", color=INK, markersize=13, markeredgewidth=1.6, linestyle="none",
              label="centre of buoyancy", zorder=6)  # fmt: skip
    _label_axes(axes, d, radius)
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower left", ncols=3, columnspacing=1.4,
                  handletextpad=0.5)  # fmt: skip
    return figure


def _reach(d: VehicleFile) -> float:
    """Half-length to show where the file gives no hull: the farthest mass, with room."""
    places = [d.rigid_body.centre_of_mass_m[0], d.moving_mass.neutral_position_m, d.ballast.position_m[0]]
    return 1.6 * max(0.15, *(abs(place) for place in places))


def _draw_hull(axes: "Axes", d: VehicleFile, radius: float) -> None:
    """Outline: elliptical nose, tube, tapering tail; the sealed part is closed."""
    hull = d.hull
    assert hull is not None
    nose, stern = hull.nose_position_m, hull.nose_position_m - hull.length_m
    angle = np.linspace(0.5 * pi, -0.5 * pi, 61)
    nose_x, nose_y = nose + hull.nose_length_m * np.cos(angle), radius * np.sin(angle)
    along = np.linspace(0.0, 1.0, 41)
    tail_y = radius * np.array([cos(0.5 * pi * share) ** 0.6 for share in along[:-1]] + [0.0])
    tail_x = stern - hull.tail_length_m * along
    x = [*nose_x, *tail_x, *tail_x[::-1]]
    y = [*nose_y, *(-tail_y), *tail_y[::-1]]
    axes.fill(x, y, facecolor=SHADE, edgecolor=INK, linewidth=1.3, zorder=1, gid="hull")
    for end in (nose, stern):
        axes.plot([end, end], [-radius, radius], color=INK, linewidth=1.0, zorder=2)


def _draw_bays(axes: "Axes", d: VehicleFile, radius: float) -> None:
    """Bays as brackets above the hull, each with its name wrapped to its width."""
    for k, bay in enumerate(d.bays):
        width, middle = bay.from_m - bay.to_m, 0.5 * (bay.from_m + bay.to_m)
        if not bay.flooded:
            for end in (bay.from_m, bay.to_m):
                axes.plot([end, end], [-radius, radius], color=MUTED, linewidth=0.7, linestyle=(0, (3, 2)), zorder=2)
        y = 1.35 * radius
        colour = SKY if bay.flooded else INK
        axes.plot([bay.from_m - 0.008, bay.to_m + 0.008], [y, y], color=colour, linewidth=2.4, solid_capstyle="butt",
                  zorder=3, gid=f"bay-{k}")  # fmt: skip
        name = bay.name if _can_be_drawn(bay.name) else f"bay {k + 1}"
        label = fill(name, max(6, int(52 * width)), max_lines=3, placeholder="...")
        axes.text(
            middle, y + 0.18 * radius, label + ("\n(flooded)" if bay.flooded else ""), ha="center", va="bottom",
            fontsize=8.0, color=INK, linespacing=1.15, parse_math=False,
        )  # fmt: skip


def _can_be_drawn(text: str) -> bool:
    """Whether the font that matplotlib ships has every character."""
    from matplotlib.font_manager import findfont, get_font  # noqa: PLC0415 - start-up counts

    font = get_font(findfont("DejaVu Sans"))
    return all(font.get_char_index(ord(character)) for character in text)


def _draw_surfaces(axes: "Axes", d: VehicleFile) -> None:
    """Aerodynamic centres of wing and rudder; the shapes are signs, not drawings: no span or chord is in the file."""
    if d.wing is not None:
        x = -d.wing.aerodynamic_centre_aft_m
        axes.fill([x + 0.09, x + 0.01, x - 0.09, x - 0.02], [0.0, 0.028, 0.028, 0.0], color=GREEN, alpha=0.55, zorder=3)
        axes.plot(x, 0.0, marker="^", color=GREEN, markeredgecolor="white", markersize=9, linestyle="none", zorder=5,
                  gid="wing", label=f"wing, {number(d.wing.aerodynamic_centre_aft_m)} m aft")  # fmt: skip
    if d.rudder is not None:
        x, y = -d.rudder.aerodynamic_centre_aft_m, d.rudder.height_m
        axes.plot([x, x], [0.0, y], color=PURPLE, linewidth=5, alpha=0.5, solid_capstyle="butt", zorder=3)
        axes.plot(x, y, marker="^", color=PURPLE, markeredgecolor="white", markersize=9, linestyle="none", zorder=5,
                  gid="rudder",
                  label=f"rudder, {number(d.rudder.aerodynamic_centre_aft_m)} m aft, {number(y)} m up")  # fmt: skip


def _draw_masses(axes: "Axes", d: VehicleFile) -> None:
    body, mass, ballast = d.rigid_body, d.moving_mass, d.ballast
    dot: dict[str, Any] = {"linestyle": "none", "markeredgecolor": "white", "markeredgewidth": 1.0, "zorder": 5}
    x, _, z = body.centre_of_mass_m
    axes.plot(x, -z, "o", color=INK, markersize=10, gid="rigid-body", label=f"rigid body, {body.mass_kg:g} kg", **dot)
    drive, engine = d.actuators.moving_mass, d.actuators.buoyancy
    travel = "travel unknown"
    y = -mass.offset_m
    if drive is not None:
        low, high = drive.travel_m
        axes.plot([low, high], [y, y], color=VERMILION, linewidth=3.0, alpha=0.55, marker="|", markersize=11, zorder=4,
                  gid="travel")  # fmt: skip
        travel = f"travel {number(drive.travel_mm[0])} to {number(drive.travel_mm[1])} mm"
    axes.plot(mass.neutral_position_m, y, "s", color=VERMILION, markersize=9, gid="moving-mass",
              label=f"moving mass, {mass.mass_kg:g} kg at neutral, {travel}", **dot)  # fmt: skip
    x, _, z = ballast.position_m
    if ballast.mass_kg > 0.0:
        axes.plot(x, -z, "D", color=BLUE, markersize=8, gid="ballast", label=f"ballast system, {ballast.mass_kg:g} kg",
                  **dot)  # fmt: skip
    if engine is not None and engine.bladder_position_m is not None:
        x, _, z = engine.bladder_position_m
        volume = f"{number(engine.range_ml[0])} to {number(engine.range_ml[1])} ml"
        axes.plot(x, -z, "h", color=ORANGE, markersize=12, gid="bladder", label=f"bladder, {volume}", **dot)


def _limits(d: VehicleFile, radius: float) -> tuple[tuple[float, float], tuple[float, float]]:
    """Limits of the drawing along the hull and upwards [m]."""
    if d.hull is None:
        reach = _reach(d)
        return (-reach, reach), (-0.3 * reach, 0.2 * reach)
    bow = d.hull.nose_position_m + d.hull.nose_length_m
    stern = d.hull.nose_position_m - d.hull.length_m - d.hull.tail_length_m
    return (stern - 0.06, bow + 0.06), (-1.35 * radius, (2.7 if d.bays else 1.5) * radius)


def _label_axes(axes: "Axes", d: VehicleFile, radius: float) -> None:
    if d.hull is None:
        axes.set_title("The file gives no hull: masses only", fontsize=9.5, fontweight="normal", color=MUTED)
    else:
        axes.set_yticks([-round(radius, 3), 0.0, round(radius, 3)])
    axes.set_xlabel("Forward of the centre of buoyancy [m]   (bow to the right)")
    axes.set_ylabel("Up [m]")
    axes.grid(visible=False, axis="y")
