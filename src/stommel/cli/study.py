"""`stommel study`: many missions, over any field of vehicle, mission, ocean and sensors."""

from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.options import JsonOption
from stommel.cli.output import show_table
from stommel.cli.paths import parser_with
from stommel.cli.status import INTERRUPTED
from stommel.cli.vehicle_check import show_vehicle_check, vehicle_check
from stommel.files.units import counted

if TYPE_CHECKING:
    from stommel.studies.run import Finished

_SHOWN = 12
"""Outputs in the table of sensitivities; all are in the result and in --json."""


def _check_result(path: Path) -> None:
    from stommel.studies.result import check_output

    check_output(path)


_RESULT = parser_with("--output", _check_result, "file")


def study(
    file: Annotated[Path, typer.Argument(metavar="STUDY.toml", help="Which mission, what to change, how many runs.")],
    output: Annotated[
        Path | None,
        typer.Option(
            "--output",
            metavar="FILE",
            parser=_RESULT,
            help="Result, .nc or .zarr; STUDY.nc in this folder if left out.",
        ),
    ] = None,
    workers: Annotated[int | None, typer.Option("--workers", help="Processes; all cores if left out.")] = None,
    scheduler: Annotated[
        str | None, typer.Option("--scheduler", help="Fly on a Dask cluster instead, such as tcp://host:8786.")
    ] = None,
    restart: Annotated[bool, typer.Option("--restart", help="Forget finished runs and fly all anew.")] = False,
    as_json: JsonOption = False,
) -> None:
    """Fly a sweep, a Latin hypercube, a Monte Carlo or a Sobol study of missions.

    Interrupted or killed, the same command goes on where it stopped. The result does not depend on the workers.

    Example: stommel study drift.toml --output drift.nc
    """
    from stommel.studies.errors import StudyInterruptedError
    from stommel.studies.run import run_study
    from stommel.studies.study import load_study

    loaded = load_study(file)
    target = output if output is not None else _RESULT(f"{file.stem}.nc")
    try:
        with _progress() as progress:
            done = run_study(loaded, target, workers=workers, scheduler=scheduler, restart=restart, progress=progress)
    except StudyInterruptedError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(INTERRUPTED) from None
    # a study whose runs name a vehicle each has none of its own
    found = None if loaded.kit.vehicle is None else vehicle_check(loaded.kit.vehicle)
    answer = done.as_json() | {"vehicle_check": found}
    finish(answer, [target], as_json, lambda _: _show(done, found))


@contextmanager
def _progress() -> Iterator[Callable[[int, int], None]]:
    """Bar with an estimate on the error output; silent where nobody watches."""
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    console = Console(stderr=True)
    columns = (
        TextColumn("missions"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=console, disable=not console.is_terminal, transient=True) as bar:
        task = bar.add_task("missions", total=None)
        yield lambda finished, runs: bar.update(task, completed=finished, total=runs)


def _show(done: "Finished", found: dict[str, Any] | None) -> None:
    runs = len(done.study.values)
    title = f"{done.study.file.name}: {done.study.file.kind} study of {counted(runs, 'mission')}"
    notes = [f"{counted(count, 'run')} could not be flown: {reason}" for reason, count in _reasons(done).most_common(5)]
    rows = [
        [name, *(f"{numbers[key]:.6g}" for key in ("mean", "standard_deviation", "least", "greatest"))]
        for name, numbers in done.statistics().items()
    ]
    show_table(title, ("output", "mean", "sd", "least", "greatest"), rows, notes)
    _show_sensitivity(done)
    typer.echo(f"{counted(done.flown, 'run')} flown, {done.kept} kept from before")
    show_vehicle_check(found)


def _reasons(done: "Finished") -> Counter[str]:
    return Counter(reason for _, reason in done.failures)


def _show_sensitivity(done: "Finished") -> None:
    import numpy as np

    found = done.sensitivity
    if found is None:
        return
    measure, title = {
        "sobol": ("total", "Sobol indices, total: share of the variance that goes with each parameter"),
        "regression": ("coefficient", "Standardised regression coefficients"),
    }[found.method]
    explained = "first orders" if found.method == "sobol" else "R2"
    changing = [i for i in range(len(found.outputs)) if np.isfinite(found.explained[i])][:_SHOWN]
    rows = [
        [
            found.outputs[i],
            *(f"{value:.3f}" if np.isfinite(value) else "-" for value in found.measures[measure][i]),
            f"{found.explained[i]:.3f}",
        ]
        for i in changing
    ]
    if rows:
        show_table(title, ("output", *found.parameters, explained), rows)
