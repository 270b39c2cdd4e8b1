"""`stommel engine`: a cycle of the buoyancy engine under sea pressure."""

from typing import TYPE_CHECKING, Annotated

import typer

from stommel.cli.finish import finish
from stommel.cli.numbers import number_option
from stommel.cli.options import PRESSURES, TURNS, VOLUMES, JsonOption, VehicleArgument, load
from stommel.cli.output import number, show_notes, show_table, show_values
from stommel.cli.paths import PlotOption

if TYPE_CHECKING:
    from stommel.machinery.engine import EngineRun


def engine(
    vehicle: VehicleArgument,
    pressure: Annotated[float, number_option("--pressure-mpa", *PRESSURES, "MPa", "Pressure of the sea, gauge")] = 0.0,
    inflate: Annotated[float | None, number_option("--inflate-ml", *VOLUMES, "ml", "Oil to pump")] = None,
    deflate: Annotated[float | None, number_option("--deflate-ml", *VOLUMES, "ml", "Oil to let back")] = None,
    hold: Annotated[float, number_option("--hold-s", 0, 86400, "s", "Pause after inflating")] = 0.0,
    motor_speed: Annotated[
        float | None,
        number_option("--motor-speed-rpm", *TURNS, "r/min", "Speed of the inflating motor; the file's if left out"),
    ] = None,
    ideal: Annotated[bool, typer.Option("--ideal", help="Without losses, as the paper's own simulation.")] = False,
    other: Annotated[
        str | None, typer.Option("--engine", help="Another engine: an example's name, or a file with a table [engine].")
    ] = None,
    plot: PlotOption = None,
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
    written = []
    if plot is not None:
        from stommel.design.engine.engine_plot import engine_figure
        from stommel.figures.saving import save_figure_as

        written.append(save_figure_as(engine_figure(run), plot))
    answer = run.as_json() | {"stall_pressure_mpa": stall / 1e6 if stall is not None else None}
    finish(answer, written, as_json, lambda _: _show(run, stall))


def _wanted(what: str, volume_ml: float | None) -> float:
    """Volume in m3; refuses one that was given and moves nothing."""
    from stommel.machinery.engine import EngineRequestError

    if volume_ml is None:
        return 0.0
    if not volume_ml > 0.0:
        raise EngineRequestError(f"{what} = {volume_ml:g} ml: must be greater than 0")
    return volume_ml / 1e6


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
    show_notes(_notes(run, stall_pa), "note")


def _notes(run: "EngineRun", stall_pa: float | None) -> list[str]:
    notes = []
    for phase in run.phases:
        if phase.outcome.stalled:
            beyond = f"; it inflates below {stall_pa / 1e6:.3g} MPa" if stall_pa is not None else ""
            notes.append(f"{phase.name}: {phase.outcome.value} at {run.pressure_pa / 1e6:g} MPa{beyond}")
    if run.lowest_pressure_pa < -0.095e6:
        notes.append(f"a node falls to {run.lowest_pressure_pa / 1e6:.3f} MPa: the oil there boils, the model ends")
    return notes
