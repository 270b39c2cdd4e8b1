"""What each combination of a sweep's values gave: means and spreads over its repetitions and draws."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.studies.study import Study
from stommel.studies.study_file import Value

Array = NDArray[np.float64]


class Statistics(NamedTuple):
    """Of an output over runs that were flown."""

    mean: float
    standard_deviation: float
    """Zero of one run."""
    least: float
    greatest: float


class Combination(NamedTuple):
    """One combination of a sweep's values."""

    values: dict[str, Value]
    """By the parameters' names, without those that are drawn."""
    flown: int
    """Runs that could be flown."""
    runs: int
    outputs: dict[str, Statistics]
    """Without those that no run tells."""

    def as_row(self) -> dict[str, Any]:
        """The combination for JSON."""
        outputs = {name: found._asdict() for name, found in self.outputs.items()}
        return {"values": self.values, "runs": self.runs, "flown": self.flown, "outputs": outputs}


def statistics_of(values: Array) -> Statistics | None:
    """Mean, standard deviation and extremes of the finite values; None where there is none."""
    flown = values[np.isfinite(values)]
    if not len(flown):
        return None
    spread = float(flown.std(ddof=1)) if len(flown) > 1 else 0.0
    return Statistics(float(flown.mean()), spread, float(flown.min()), float(flown.max()))


def combinations_of(study: Study, outputs: Mapping[str, Array], failed: Sequence[int]) -> list[Combination]:
    """Return the combinations of a sweep, in the order of its runs."""
    return list(_combinations(study, outputs, set(failed)))


def _combinations(study: Study, outputs: Mapping[str, Array], failed: set[int]) -> Iterator[Combination]:
    swept = [k for k, parameter in enumerate(study.file.parameters) if not parameter.drawn]
    numbered = enumerate(tuple(values[k] for k in swept) for values in study.values)
    for values, group in groupby(numbered, key=lambda run: run[1]):
        runs = [run for run, _ in group]
        found = {name: statistics_of(column[runs]) for name, column in outputs.items()}
        yield Combination(
            {study.names[k]: value for k, value in zip(swept, values, strict=True)},
            sum(run not in failed for run in runs),
            len(runs),
            {name: numbers for name, numbers in found.items() if numbers is not None},
        )
