"""`stommel engine`: a cycle of the buoyancy engine under sea pressure."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.options import JsonOption, VehicleArgument, load
from stommel.cli.output import number, show_json, show_table, show_values
from stommel.errors import OutputError

if TYPE_CHECKING:
    from stommel.machinery.engine import EngineRun, PhaseResult

SAMPLES = 121


def engine(
    vehicle: VehicleArgument,
    pressure: Annotated[float, typer.Option("--pressure-mpa", help="Pressure of the sea, gauge [MPa].")] = 0.0,
    inflate: Annotated[float | None, typer.Option("--inflate-ml", help="Oil to pump into the bladder [ml].")] = None,
    deflate: Annotated[float | None, typer.Option("--deflate-ml", help="Oil to let back [ml].")] = None,
    hold: Annotated[float, typer.Option("--hold-s", help="Pause after inflating [s].")] = 0.0,
    motor_speed: Annotated[
        float | None,
        typer.Option("--motor-speed-rpm", help="Speed of the inflating motor [r/min]; the file's if left out."),
    ] = None,
    ideal: Annotated[bool, typer.Option("--ideal", help="Without losses, as the paper's own simulation.")] = False,
    other: Annotated[
        str | None, typer.Option("--engine", help="Another engine: an example's name, or a file with a table [engine].")
    ] = None,
    plot: Annotated[
        Path | None, typer.Option("--plot", help="Write the courses over time to this file, as PNG and SVG.")
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Simulate the hydraulic circuit: inflate, hold, deflate.

    Without --inflate-ml and --deflate-ml the whole working range is inflated.

    Example: stommel engine zju --pressure-mpa 2.0 --inflate-ml 500
    """
    from stommel.machinery.engine import engine_of, load_engine, simulate

    named = load_engine(other) if other is not None else engine_of(load(vehicle))
    if inflate is None and deflate is None:
        inflate = named.engine.measured_piston.working_volume_ml
    run = simulate(
        named.engine,
        pressure_pa=pressure * 1e6,
        inflate_m3=_wanted("inflate", inflate),
        deflate_m3=_wanted("deflate", deflate),
        hold_s=hold,
        motor_speed_rpm=motor_speed,
        ideal=ideal,
        name=named.name,
    )
    stall = None
    inflated = run.phase("inflate")
    if inflated is not None and inflated.outcome.stalled and not ideal:
        from stommel.machinery.engine import stall_pressure

        stall = stall_pressure(named.engine, motor_speed_rpm=motor_speed)
    written = _plotted(run, plot) if plot is not None else []
    if as_json:
        show_json(_as_json(run, stall, written))
        return
    _show(run, stall)
    for path in written:
        typer.echo(f"wrote {path}")


def _wanted(what: str, volume_ml: float | None) -> float:
    """Volume in m3; refuses one that was given and moves nothing."""
    from stommel.machinery.engine import EngineRequestError

    if volume_ml is None:
        return 0.0
    if not volume_ml > 0.0:
        raise EngineRequestError(f"{what} = {volume_ml:g} ml: must be greater than 0")
    return volume_ml / 1e6


def _plotted(run: "EngineRun", path: Path) -> list[Path]:
    from stommel.design.engine.engine_plot import engine_figure
    from stommel.figures.saving import save_figure

    if not path.name:
        raise OutputError(f"{path}: cannot be written: it is a folder")
    stem = path.with_suffix("") if path.suffix in (".png", ".svg") else path
    return save_figure(engine_figure(run), stem)


def _as_json(run: "EngineRun", stall_pa: float | None, written: list[Path]) -> dict[str, Any]:
    """The first phase at the top, all phases in a list."""
    return {
        "engine": run.name,
        "pressure_mpa": run.pressure_pa / 1e6,
        "ideal": run.ideal,
        **_phase_json(run.phases[0]),
        "stalled": run.stalled,
        "stall_pressure_mpa": stall_pa / 1e6 if stall_pa is not None else None,
        "oil_residual": run.oil_residual,
        "lowest_pressure_mpa": run.lowest_pressure_pa / 1e6,
        "phases": [{"phase": phase.name, **_phase_json(phase)} for phase in run.phases],
        "events": [{"t_s": t, "event": name} for t, name in run.events],
        "courses": run.courses.sampled(SAMPLES),
        "plots": [str(path) for path in written],
    }


def _phase_json(phase: "PhaseResult") -> dict[str, Any]:
    return {
        "outcome": phase.outcome.value,
        "duration_s": phase.duration_s,
        "volume_ml": phase.moved_m3 * 1e6,
        "energy_j": phase.energy_j,
        "peak_current_a": phase.peak_current_a,
        "peak_supply_current_a": phase.peak_supply_current_a,
        "pump_efficiency": phase.efficiency,
        "volumetric_efficiency": phase.volumetric_efficiency,
        "energy_per_mm_j": phase.energy_per_mm,
        "piston_begin_mm": phase.piston_m[0] * 1e3,
        "piston_end_mm": phase.piston_m[1] * 1e3,
        "sea_work_j": phase.sea_work_j,
        "hull_gas_work_j": phase.hull_gas_work_j,
        "stored_j": phase.stored_j,
        "losses_j": phase.losses_j,
        "energy_residual": phase.energy_residual,
    }


def _show(run: "EngineRun", stall_pa: float | None) -> None:
    ideal = ", without losses" if run.ideal else ""
    rows = [
        [
            phase.name,
            number(phase.duration_s, 1),
            number(phase.moved_m3 * 1e6, 1),
            f"{phase.piston_m[0] * 1e3:.1f} to {phase.piston_m[1] * 1e3:.1f}",
            number(phase.energy_j, 1),
            number(phase.peak_current_a, 2),
            number(100.0 * phase.efficiency, 1),
            phase.outcome.value,
        ]
        for phase in run.phases
    ]
    columns = ["phase", "time\ns", "oil\nml", "piston\nmm", "energy\nJ", "peak\nA", "eff.\n%", "outcome"]
    show_table(f"{run.name}: buoyancy engine at {run.pressure_pa / 1e6:g} MPa{ideal}", columns, rows)
    phase = run.phases[0]
    ledger = {
        "from the supply": phase.energy_j,
        "against the sea": phase.sea_work_j,
        "on the hull's gas": phase.hull_gas_work_j,
    }
    ledger |= {f"lost: {name.replace('_', ' ')}": joules for name, joules in phase.losses_j.items() if joules > 0.0}
    show_values(f"Where the energy of the phase {phase.name!r} goes", {k: number(v, 1, "J") for k, v in ledger.items()})
    for note in _notes(run, stall_pa):
        typer.echo(f"note: {note}")


def _notes(run: "EngineRun", stall_pa: float | None) -> list[str]:
    notes = []
    for phase in run.phases:
        if phase.outcome.stalled:
            beyond = f"; it inflates below {stall_pa / 1e6:.3g} MPa" if stall_pa is not None else ""
            notes.append(f"{phase.name}: {phase.outcome.value} at {run.pressure_pa / 1e6:g} MPa{beyond}")
    if run.lowest_pressure_pa < -0.095e6:
        notes.append(f"a node falls to {run.lowest_pressure_pa / 1e6:.3f} MPa: the oil there boils, the model ends")
    return notes
