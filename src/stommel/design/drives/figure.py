"""Both drives at a glance: speed, power and energy of the moving mass against pitch, hinge moment against angle."""

from collections.abc import Callable
from math import degrees
from typing import TYPE_CHECKING, Any

import numpy as np

from stommel.design.drives.study import DriveStudy, PitchStudy, RudderStudy
from stommel.figures.style import BLUE, CYCLE, DASHES, FAINT, INK, MUTED, VERMILION, new_figure, number, styled
from stommel.machinery.drives.pitch import Direction, PitchPoint

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_SENSES: tuple[tuple[Direction, str, str, Any], ...] = (
    (1, "mass moves forward", BLUE, "-"),
    (-1, "mass moves aft", VERMILION, (0, (6, 2))),
)


@styled
def drives_figure(study: DriveStudy) -> "Figure":
    """Draw what the vehicle file describes: three panels for the pitch drive, one for the rudder."""
    count = 3 * (study.pitch is not None) + (study.rudder is not None)
    figure = new_figure(8.6, 6.0) if count > 2 else new_figure(5.2, 3.4)
    side = 2 if count > 2 else 1
    panels: list[Axes] = list(figure.subplots(side, side, squeeze=False).ravel())
    if study.pitch is not None:
        _draw_pitch(study.pitch, panels[:3])
    if study.rudder is not None:
        _draw_rudder(study.rudder, panels[count - 1])
    for empty in panels[count:]:
        empty.set_axis_off()
    return figure


def _draw_pitch(study: PitchStudy, panels: "list[Axes]") -> None:
    quantities: tuple[tuple[str, Callable[[PitchPoint], float]], ...] = (
        ("Speed of the mass [mm/s]", lambda p: p.speed * 1e3),
        ("Torque at the motor [mN m]", lambda p: p.motor.torque * 1e3),
        ("Energy per millimetre [J/mm]", lambda p: np.nan if p.energy_per_metre is None else p.energy_per_metre / 1e3),
    )
    pitches = np.linspace(study.points[0].theta, study.points[-1].theta, 101)
    for axes, (title, value) in zip(panels, quantities, strict=True):
        for direction, label, colour, dashes in _SENSES:
            axes.plot(
                np.degrees(pitches),
                [value(study.drive.point(float(theta), direction)) for theta in pitches],
                color=colour,
                linestyle=dashes,
                label=label,
            )
        axes.set_title(title)
        axes.set_xlabel("Pitch [deg]")
        axes.set_xlim(degrees(study.points[0].theta), degrees(study.points[-1].theta))
        low, high = axes.get_ylim()
        axes.set_ylim(0.0, high + 0.12 * (high - min(low, 0.0)))
    if study.file_speed is not None:
        label = f"vehicle file: {number(study.file_speed * 1e3)} mm/s"
        panels[0].axhline(study.file_speed * 1e3, color=MUTED, linewidth=1.0, linestyle=(0, (2, 2)), label=label)
    panels[0].legend(loc="lower center")
    started = study.worst_start
    panels[1].plot(degrees(started.theta), started.starting_torque * 1e3, "o", color=INK, markersize=5)
    left = started.theta < 0.0
    panels[1].annotate(
        f"hardest start {number(round(started.starting_torque * 1e3, 1))} mN m,\nthe motor has "
        f"{number(round(study.drive.motor.stall_torque * 1e3, 1))}",
        (degrees(started.theta), started.starting_torque * 1e3), xytext=(9 if left else -9, -2),
        textcoords="offset points", ha="left" if left else "right", va="center", fontsize=8.5,
    )  # fmt: skip
    panels[1].set_ylim(0.0, 1.15 * started.starting_torque * 1e3)


def _draw_rudder(study: RudderStudy, axes: "Axes") -> None:
    angles = np.linspace(0.0, study.full_angle, 61)
    for share, colour, dashes in zip((1.0, 0.75, 0.5), CYCLE, DASHES, strict=False):
        moments = [study.drive.hinge_moment(float(angle), share * study.V) * 1e3 for angle in angles]
        axes.plot(np.degrees(angles), moments, color=colour, linestyle=dashes, label=f"{number(share * study.V)} m/s")
    axes.axhline(0.0, color=FAINT, linewidth=0.8)
    axes.set_title("Hinge moment of the rudder [mN m]")
    axes.set_xlabel("Rudder angle [deg]")
    axes.set_xlim(0.0, degrees(study.full_angle))
    axes.legend(loc="upper left", title="speed through the water", alignment="left")
