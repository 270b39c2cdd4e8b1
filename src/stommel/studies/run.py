"""Running a study from its first to its last run, with a journal between."""

import signal
import threading
from collections.abc import Callable, Generator, Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from stommel.files.units import counted
from stommel.studies.combinations import Combination, combinations_of, statistics_of
from stommel.studies.errors import StudyError, StudyInterruptedError
from stommel.studies.journal import Journal
from stommel.studies.result import check_output, check_outputs, dataset_of, outputs_of, sensitivity_in
from stommel.studies.result import write_result as write
from stommel.studies.running import cores, fly_here, fly_on_cluster
from stommel.studies.sensitivity import Sensitivity
from stommel.studies.study import Study
from stommel.studies.study_file import SWEEP

if TYPE_CHECKING:
    import xarray as xr

Progress = Callable[[int, int], None]
"""Called with the finished runs and all runs."""


def silent(finished: int, runs: int) -> None:
    """Show no progress: `finished` of `runs`."""


@dataclass(frozen=True)
class Finished:
    """A study that has run."""

    study: Study
    dataset: "xr.Dataset" = field(repr=False)
    outputs: dict[str, NDArray[np.float64]] = field(repr=False)
    """Values of every run, nan for failed ones."""
    sensitivity: Sensitivity | None
    failures: tuple[tuple[int, str], ...]
    """Runs that could not be flown, each with the reason."""
    flown: int
    """Runs that were flown now."""
    kept: int
    """Runs that the journal had from before."""

    def statistics(self) -> dict[str, dict[str, float]]:
        """Mean, standard deviation and extremes of every output over the runs that were flown."""
        found = {name: statistics_of(values) for name, values in self.outputs.items()}
        return {name: numbers._asdict() for name, numbers in found.items() if numbers is not None}

    def combinations(self) -> list[Combination]:
        """What each combination of values gave; none where the study is no sweep."""
        if self.study.file.kind != SWEEP:
            return []
        return combinations_of(self.study, self.outputs, [run for run, _ in self.failures])

    def as_json(self) -> dict[str, Any]:
        """The study in words, its statistics and sensitivities."""
        file = self.study.file
        return {
            "study": file.name,
            "kind": file.kind,
            "runs": len(self.study.values),
            "flown": self.flown,
            "kept": self.kept,
            "failed": [{"run": run, "reason": reason} for run, reason in self.failures],
            "parameters": dict(zip(self.study.names, (p.key for p in file.parameters), strict=True)),
            "statistics": self.statistics(),
            "combinations": [combination.as_row() for combination in self.combinations()],
            "sensitivity_method": None if self.sensitivity is None else self.sensitivity.method,
            "sensitivity": {} if self.sensitivity is None else self.sensitivity.as_row(),
        }


def run_study(
    study: Study,
    output: Path,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    restart: bool = False,
    progress: Progress = silent,
) -> Finished:
    """Fly the runs that the journal beside `output` does not hold yet, and write the result.

    The result is the same for any number of workers, on a cluster, and after any interruption.

    Parameters
    ----------
    study
        From `stommel.studies.study.load_study`.
    output
        Result, .nc or .zarr; the journal is the folder of this name with .runs after it.
    workers
        Processes; all cores if left out.
    scheduler
        Address of a Dask scheduler, whose workers fly the runs instead.
    restart
        Forget the runs of the journal.
    progress
        Called after each run.

    Raises
    ------
    StudyInterruptedError
        Ctrl-C; the runs that are finished are kept.
    StudyError
        The study cannot go on.
    OutputError
        Journal or result cannot be written.
    """
    check_output(output)
    if workers is not None and workers < 1:
        raise StudyError(f"--workers {workers}: must be at least 1")
    with Journal(journal_of(output), study.fingerprint(), restart=restart) as journal:
        records = journal.finished()
        kept, runs = len(records), len(study.values)
        _check_first(study, records)
        tasks = [(run, values) for run, values in enumerate(study.values) if run not in records]
        progress(kept, runs)
        with interruptible() as stop, closing(_flights(study, tasks, workers, scheduler, stop)) as flights:
            for record in flights:
                journal.keep(record)
                records[record["run"]] = record
                if len(records) == kept + 1:
                    _check_first(study, records)
                progress(len(records), runs)
        if len(records) < runs:
            raise StudyInterruptedError(
                f"interrupted: {len(records)} of {counted(runs, 'run is', 'runs are')} kept in {journal.folder}; "
                "the same command goes on"
            )
        return _finish(study, output, records, kept)


def journal_of(output: Path) -> Path:
    """Folder of the finished runs beside a result."""
    return output.with_name(f"{output.name}.runs")


def _flights(
    study: Study,
    tasks: list[Any],
    workers: int | None,
    scheduler: str | None,
    stop: threading.Event,
) -> Generator[dict[str, Any], None, None]:
    if not tasks:
        return
    if scheduler is not None:
        yield from fly_on_cluster(study.kit, tasks, scheduler, stop)
    else:
        yield from fly_here(study.kit, tasks, workers or cores(), stop)


def _check_first(study: Study, records: dict[int, Any]) -> None:
    """Find unknown outputs with the first run, not with the last."""
    known = next((list(record["numbers"]) for record in records.values() if "numbers" in record), [])
    check_outputs(study, known)


def _finish(study: Study, output: Path, records: dict[int, Any], kept: int) -> Finished:
    outputs = outputs_of(study, records)
    sensitivity = sensitivity_in(study, outputs)
    dataset = dataset_of(study, records, outputs, sensitivity)
    write(dataset, output)
    failures = tuple((run, records[run]["failure"]) for run in sorted(records) if "failure" in records[run])
    return Finished(study, dataset, outputs, sensitivity, failures, len(records) - kept, kept)


@contextmanager
def interruptible() -> Iterator[threading.Event]:
    """Turn the first Ctrl-C into an event; the second is one as ever."""
    stop = threading.Event()
    if threading.current_thread() is not threading.main_thread():
        yield stop
        return

    def handle(_number: int, _frame: object) -> None:
        if stop.is_set():
            raise KeyboardInterrupt
        stop.set()

    before = signal.signal(signal.SIGINT, handle)
    try:
        yield stop
    finally:
        signal.signal(signal.SIGINT, before)
