"""`stommel drives`: what the drives of moving mass and rudder do at every attitude, and what they cost."""

from math import degrees
from typing import TYPE_CHECKING, Annotated

from stommel.cli.finish import finish
from stommel.cli.numbers import number_option
from stommel.cli.options import SPEEDS, JsonOption, VehicleArgument, load
from stommel.cli.output import number, show_table, show_values, show_warnings
from stommel.cli.paths import PlotOption

if TYPE_CHECKING:
    from stommel.design.drives import DriveStudy, PitchStudy, RudderStudy


def drives(
    vehicle: VehicleArgument,
    steepest: Annotated[
        float | None,
        number_option("--steepest", 0.1, 90, "deg", "Steepest pitch, up and down; the specification's if left out"),
    ] = None,
    speed: Annotated[
        float | None,
        number_option("--speed", *SPEEDS, "m/s", "Speed at the rudder; the specification's greatest if left out"),
    ] = None,
    rudder: Annotated[
        float | None, number_option("--rudder", 0.1, 90, "deg", "Rudder angle of a turn; its travel if left out")
    ] = None,
    hold: Annotated[float, number_option("--hold", 0, 10000, "s", "Time that the rudder is held over")] = 60.0,
    plot: PlotOption = None,
    as_json: JsonOption = False,
) -> None:
    """Size the drives: speed, torque, self-locking, limit switches, time and energy of a trim change and of a turn.

    Example: stommel drives zju --plot build/zju-drives.png
    """
    from stommel.design.drives import drive_study

    study = drive_study(load(vehicle), steepest_deg=steepest, speed_m_s=speed, rudder_deg=rudder, hold_s=hold)
    written = []
    if plot is not None:
        from stommel.design.drives.figure import drives_figure
        from stommel.figures.saving import save_figure_as

        written.append(save_figure_as(drives_figure(study), plot))
    finish(study, written, as_json, _show)


def _show(study: "DriveStudy") -> None:
    if study.pitch is not None:
        _show_pitch(study.vehicle.name, study.pitch)
    if study.rudder is not None:
        _show_rudder(study.vehicle.name, study.rudder)
    show_warnings(study.warnings)


def _show_pitch(name: str, study: "PitchStudy") -> None:
    drive, worst = study.drive, study.worst_start
    values = {
        "screw": _thread(drive.screw.efficiency, drive.screw.back_driving_efficiency, drive.screw.self_locking),
        "worm": _thread(drive.worm.efficiency, drive.worm.back_driving_efficiency, drive.worm.self_locking)
        if drive.worm
        else "none",
        "whole drive": f"efficiency {drive.efficiency:.3f}; "
        f"{'holds the mass without power' if drive.self_locking else 'does NOT hold the mass without power'}",
        f"start at {degrees(abs(worst.theta)):g} deg": f"{'yes' if worst.starts else 'NO'}: needs "
        f"{worst.starting_torque * 1e3:.2f} mN m, has {drive.motor.stall_torque * 1e3:.2f} "
        f"({worst.stall_margin:.1f} times)",
    }
    for words, change in (("dive to climb", study.dive_to_climb), ("climb to dive", study.climb_to_dive)):
        if change is not None:
            row = change.as_row()
            values[words] = (
                f"{row['from_mm']:.1f} to {row['to_mm']:.1f} mm in {row['time_s']:.1f} s, {row['energy_j']:.1f} J "
                f"({row['mean_speed_mm_s']:.2f} mm/s)"
            )
            values[f"{words}, worst"] = f"{row['longest_time_s']:.1f} s, {row['greatest_energy_j']:.1f} J"
    for run in study.over_runs:
        end = "forward end" if run.direction > 0 else "aft end"
        values[end] = (
            f"switch {run.switch * 1e3:g} mm, run-on {run.run_on * 1e3:.2f} of {run.room * 1e3:g} mm, "
            f"failing {run.stall_thrust:.0f} N"
        )
    show_values(f"{name}: pitch drive", values)
    rows = [
        [
            number(degrees(p.theta), 0),
            "forward" if p.direction > 0 else "aft",
            number(p.load, 1),
            number(p.motor.torque * 1e3, 2),
            number(p.motor.current, 3),
            number(p.speed * 1e3, 2),
            number(p.motor.power, 2),
            number(None if p.energy_per_metre is None else p.energy_per_metre / 1e3, 3),
        ]
        for p in study.points
        if round(degrees(p.theta), 6) % 10 == 0
    ]
    columns = [
        "pitch\ndeg",
        "moves",
        "load\nN",
        "torque\nmN m",
        "current\nA",
        "speed\nmm/s",
        "power\nW",
        "energy\nJ/mm",
    ]
    show_table("At every attitude", columns, rows, ["a negative load helps the motion"])


def _thread(efficiency: float, back: float, locks: bool) -> str:
    held = "locks itself" if locks else f"is driven back at efficiency {back:.3f}"
    return f"efficiency {efficiency:.3f}; {held}"


def _show_rudder(name: str, study: "RudderStudy") -> None:
    drive, step, turn = study.drive, study.full_step, study.turn
    values = {
        "hinge moment": f"{study.hinge_moment * 1e3:.1f} mN m at most, at {study.V:g} m/s; "
        f"seal {drive.seal_friction * 1e3:g} mN m",
        "full step": "the motor stalls"
        if step is None
        else f"0 to {degrees(step.end):g} deg in {step.time:.2f} s, {step.greatest_torque * 1e3:.3f} mN m and "
        f"{step.greatest_current:.3f} A at the motor",
        "brake": "none" if study.holding_margin is None else f"holds {study.holding_margin:.0f} times the hinge moment",
    }
    if turn is not None:
        values[f"turn to {degrees(turn.angle):g} deg"] = (
            f"{turn.energy:.1f} J: motor {turn.out.energy + turn.back.energy:.1f}, "
            f"brake 2 x {turn.brake_per_release:.1f}, {turn.hold:g} s hold {turn.hold_energy:.1f}"
        )
    show_values(f"{name}: rudder drive", values)
