"""`stommel drives`: what the drives of moving mass and rudder do at every attitude, and what they cost."""

from math import degrees
from pathlib import Path
from textwrap import fill
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.options import JsonOption, VehicleArgument, load
from stommel.cli.output import WIDTH, number, show_json, show_table, show_values

if TYPE_CHECKING:
    from stommel.design.drives import DriveStudy, PitchStudy, RudderStudy
    from stommel.machinery.drives import PitchPoint


def drives(
    vehicle: VehicleArgument,
    steepest: Annotated[
        float | None,
        typer.Option("--steepest", help="Steepest pitch, up and down [deg]; the specification's if left out."),
    ] = None,
    speed: Annotated[
        float | None,
        typer.Option("--speed", help="Speed at the rudder [m/s]; the specification's greatest if left out."),
    ] = None,
    rudder: Annotated[
        float | None, typer.Option("--rudder", help="Rudder angle of a turn [deg]; its travel if left out.")
    ] = None,
    hold: Annotated[float, typer.Option("--hold", help="Time that the rudder is held over [s].")] = 60.0,
    plot: Annotated[
        Path | None, typer.Option("--plot", help="Plot to write as PNG and SVG, without its ending.")
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Size the drives: speed, torque, self-locking, limit switches, time and energy of a trim change and of a turn.

    Example: stommel drives zju --plot build/zju-drives
    """
    from stommel.design.drives import drive_study

    study = drive_study(load(vehicle), steepest_deg=steepest, speed_m_s=speed, rudder_deg=rudder, hold_s=hold)
    written: list[Path] = []
    if plot is not None:
        from stommel.design.drives.figure import drives_figure
        from stommel.figures.saving import save_figure

        written = save_figure(drives_figure(study), plot)
    if as_json:
        show_json(_as_json(study, written))
        return
    if study.pitch is not None:
        _show_pitch(study.vehicle.name, study.pitch)
    if study.rudder is not None:
        _show_rudder(study.vehicle.name, study.rudder)
    for warning in study.warnings:
        typer.echo(fill(f"warning: {warning}", WIDTH, subsequent_indent="  "))
    for path in written:
        typer.echo(f"wrote {path}")


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


def _as_json(study: "DriveStudy", written: list[Path]) -> dict[str, Any]:
    return {
        "vehicle": study.vehicle.name,
        "pitch": _pitch_json(study.pitch) if study.pitch else None,
        "rudder": _rudder_json(study.rudder) if study.rudder else None,
        "warnings": [{"name": warning.name, "message": warning.message} for warning in study.warnings],
        "plots": [str(path) for path in written],
    }


def _point_json(point: "PitchPoint") -> dict[str, Any]:
    energy = point.energy_per_metre
    return {
        "pitch_deg": round(degrees(point.theta), 9),
        "direction": "forward" if point.direction > 0 else "aft",
        "uphill": point.uphill,
        "load_n": point.load,
        "torque_mn_m": point.motor.torque * 1e3,
        "current_a": point.motor.current,
        "speed_mm_s": point.speed * 1e3,
        "power_w": point.motor.power,
        "energy_j_per_mm": None if energy is None else energy / 1e3,
        "starting_torque_mn_m": point.starting_torque * 1e3,
        "stall_margin": _finite(point.stall_margin),
        "starts": point.starts,
    }


def _pitch_json(study: "PitchStudy") -> dict[str, Any]:
    drive = study.drive
    threads = {"screw": drive.screw, "worm": drive.worm}
    return {
        "efficiency": drive.efficiency,
        "self_locking": drive.self_locking,
        **{
            name: None
            if thread is None
            else {
                "efficiency": thread.efficiency,
                "back_driving_efficiency": thread.back_driving_efficiency,
                "self_locking": thread.self_locking,
            }
            for name, thread in threads.items()
        },
        "speed_mm_s": None if study.speed is None else study.speed * 1e3,
        "file_speed_mm_s": None if study.file_speed is None else study.file_speed * 1e3,
        "hardest_start": _point_json(study.worst_start),
        "dive_to_climb": study.dive_to_climb.as_row() if study.dive_to_climb else None,
        "climb_to_dive": study.climb_to_dive.as_row() if study.climb_to_dive else None,
        "over_runs": [
            {
                "end": "forward" if run.direction > 0 else "aft",
                "switch_mm": run.switch * 1e3,
                "stop_mm": run.stop * 1e3,
                "run_on_mm": _finite(run.run_on * 1e3),
                "caught": run.caught,
                "stall_thrust_n": run.stall_thrust,
                "stall_current_a": run.stall_current,
            }
            for run in study.over_runs
        ],
        "points": [_point_json(point) for point in study.points],
    }


def _rudder_json(study: "RudderStudy") -> dict[str, Any]:
    turn = study.turn
    return {
        "speed_through_water_m_s": study.V,
        "hinge_moment_mn_m": study.hinge_moment * 1e3,
        "full_step": study.full_step.as_row() if study.full_step else None,
        "speed_deg_s": None if study.speed is None else degrees(study.speed),
        "file_speed_deg_s": None if study.file_speed is None else degrees(study.file_speed),
        "holding_margin": None if study.holding_margin is None else _finite(study.holding_margin),
        "turn": None
        if turn is None
        else {
            "angle_deg": degrees(turn.angle),
            "hold_s": turn.hold,
            "energy_j": turn.energy,
            "motor_energy_j": turn.out.energy + turn.back.energy,
            "brake_energy_j": turn.brake_energy,
            "brake_energy_per_release_j": turn.brake_per_release,
            "hold_energy_j": turn.hold_energy,
        },
    }


def _finite(value: float) -> float | None:
    """JSON has no infinity."""
    return None if value == float("inf") else value
