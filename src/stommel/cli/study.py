"""`stommel study`: many missions, over any field of vehicle, mission, ocean and sensors."""

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.count_progress import count_progress
from stommel.cli.finish import finish
from stommel.cli.numbers import count_option
from stommel.cli.options import JsonOption
from stommel.cli.output import show_table
from stommel.cli.paths import PlotsOption, parser_with, refuse_same
from stommel.cli.status import INTERRUPTED
from stommel.cli.vehicle_check import show_vehicle_check, vehicle_check
from stommel.files.units import counted

if TYPE_CHECKING:
    from stommel.studies.combinations import Combination
    from stommel.studies.run import Finished
    from stommel.studies.study_file import Value

_SHOWN = 12
"""Outputs in the table of sensitivities; all are in the result and in --json."""
_MOST_COMBINATIONS = 24
"""Rows in the table of a sweep."""
_COLUMNS, _HEADING = 5, 11
"""Columns that fit beside each other, and letters in a line of their headings."""


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
    plots: PlotsOption = None,
    workers: Annotated[int | None, count_option("--workers", 1, 1024, "Processes; all cores if left out")] = None,
    scheduler: Annotated[
        str | None, typer.Option("--scheduler", help="Fly on a Dask cluster instead, such as tcp://host:8786.")
    ] = None,
    restart: Annotated[bool, typer.Option("--restart", help="Forget finished runs and fly all anew.")] = False,
    as_json: JsonOption = False,
) -> None:
    """Fly a sweep, a Latin hypercube, a Monte Carlo or a Sobol study of missions; a sweep may draw at each value too.

    Interrupted or killed, the same command goes on where it stopped. The result does not depend on the workers.

    Example: stommel study drift.toml --output drift.nc
    """
    from stommel.studies.errors import StudyInterruptedError
    from stommel.studies.run import run_study
    from stommel.studies.study import load_study

    loaded = load_study(file)
    target = output if output is not None else _RESULT(f"{file.stem}.nc")
    refuse_same("--output", target, plots)
    try:
        with count_progress("missions") as progress:
            done = run_study(loaded, target, workers=workers, scheduler=scheduler, restart=restart, progress=progress)
    except StudyInterruptedError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(INTERRUPTED) from None
    written = [target]
    if plots is not None:
        from stommel.studies.pictures import save_study_pictures

        written += save_study_pictures(done, plots)
    # a study whose runs name a vehicle each has none of its own
    found = None if loaded.kit.vehicle is None else vehicle_check(loaded.kit.vehicle)
    answer = done.as_json() | {"vehicle_check": found}
    finish(answer, written, as_json, lambda _: _show(done, found))


def _show(done: "Finished", found: dict[str, Any] | None) -> None:
    runs = len(done.study.values)
    title = f"{done.study.file.name}: {done.study.file.kind} study of {counted(runs, 'mission')}"
    notes = [f"{counted(count, 'run')} could not be flown: {reason}" for reason, count in _reasons(done).most_common(5)]
    rows = [
        [name, *(f"{numbers[key]:.6g}" for key in ("mean", "standard_deviation", "least", "greatest"))]
        for name, numbers in done.statistics().items()
    ]
    show_table(title, ("output", "mean", "sd", "least", "greatest"), rows, notes)
    _show_combinations(done)
    _show_sensitivity(done)
    typer.echo(f"{counted(done.flown, 'run')} flown, {done.kept} kept from before")
    show_vehicle_check(found)


def _show_combinations(done: "Finished") -> None:
    """A row for each combination of a sweep, as many outputs beside each other as fit."""
    combinations = done.combinations()
    if not combinations:
        return
    from stommel.studies.headline import shown_outputs, told_selection

    known = done.statistics()
    outputs, shown = shown_outputs(done.study, known), combinations[:_MOST_COMBINATIONS]
    parameters = list(combinations[0].values)
    beside = max(1, (_COLUMNS - len(parameters)))
    groups = [outputs[k : k + beside] for k in range(0, len(outputs), beside)]
    notes = told_selection(done.study, len(outputs), len(known))
    if len(shown) < len(combinations):
        notes.append(f"{len(shown)} of {counted(len(combinations), 'combination')} are shown; --json has all")
    if any(combination.runs > 1 for combination in combinations):
        notes.append("mean and standard deviation over the runs of each combination")
    for group in groups:
        rows = [
            [*(_told(one.values[name]) for name in parameters), *(_mean(one, name) for name in group)] for one in shown
        ]
        title = f"By {' and '.join(parameters)}"
        show_table(
            title, [_heading(name) for name in (*parameters, *group)], rows, notes if group is groups[-1] else ()
        )


def _heading(name: str) -> str:
    """A name in words, in lines of few letters, its unit below."""
    from textwrap import fill

    from stommel.studies.headline import in_words

    words, unit = in_words(name)
    return fill(words, _HEADING, break_long_words=False) + (f"\n{unit}" if unit else "")


def _told(value: "Value") -> str:
    return str(value).lower() if isinstance(value, bool) else value if isinstance(value, str) else f"{value:.6g}"


def _mean(one: "Combination", name: str) -> str:
    found = one.outputs.get(name)
    if found is None:
        return "-"
    return f"{found.mean:.4g} ± {found.standard_deviation:.2g}" if one.flown > 1 else f"{found.mean:.5g}"


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
    known = [i for i in range(len(found.outputs)) if np.isfinite(found.explained[i])]
    changing = known if done.study.file.outputs else known[:_SHOWN]
    rows = [
        [
            found.outputs[i],
            *(f"{value:.3f}" if np.isfinite(value) else "-" for value in found.measures[measure][i]),
            f"{found.explained[i]:.3f}",
        ]
        for i in changing
    ]
    if rows:
        from stommel.studies.headline import told_selection

        notes = told_selection(done.study, len(rows), len(known))
        show_table(title, ("output", *map(_heading, found.parameters), explained), rows, notes)
