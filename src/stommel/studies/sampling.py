"""The values of every run, from the study's seed alone."""

from collections.abc import Sequence
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stommel.studies.study_file import LATIN_HYPERCUBE, MONTE_CARLO, SOBOL, SWEEP, Parameter, StudyFile, Value

Array = NDArray[np.float64]

_SAMPLES = 2**32 - 1
"""Spawn key of the samples; runs have theirs from zero up."""
_SMALLEST = 2.0**-54
"""Probabilities are kept off 0 and 1, where a normal distribution has no value."""


def run_values(file: StudyFile) -> list[tuple[Value, ...]]:
    """Values of the parameters of every run, in the order of the runs.

    A sweep runs through all combinations, the last parameter fastest, each repeated `runs` times; what is drawn beside
    them is the same for all combinations, so that these differ by the values alone. The others map the
    unit cube by the inverse of each parameter's distribution: a Latin hypercube (SciPy), independent draws, or the
    design of Saltelli for Sobol indices (SALib).
    """
    if file.kind == SWEEP:
        axes = [sweep_values(parameter) for parameter in file.parameters if not parameter.drawn]
        return [_merged(file, values, draw) for values in product(*axes) for draw in draws_of(file)]
    unit = unit_samples(file.kind, len(file.parameters), file.runs or 1, file.seed)
    columns = [quantiles(parameter, unit[:, j]) for j, parameter in enumerate(file.parameters)]
    return [tuple(float(value) for value in row) for row in np.column_stack(columns)]


def draws_of(file: StudyFile) -> Array:
    """What is drawn at each combination of a sweep, (runs, drawn parameters); without any, as many empty rows."""
    drawn = [parameter for parameter in file.parameters if parameter.drawn]
    unit = unit_samples(MONTE_CARLO, len(drawn), file.runs or 1, file.seed)
    return np.array([quantiles(parameter, unit[:, j]) for j, parameter in enumerate(drawn)]).reshape(-1, len(unit)).T


def _merged(file: StudyFile, values: Sequence[Value], draw: Array) -> tuple[Value, ...]:
    """Values and draws in the order of the parameters."""
    given, drawn = iter(values), iter(draw.tolist())
    return tuple(next(drawn) if parameter.drawn else next(given) for parameter in file.parameters)


def unit_samples(kind: str, parameters: int, runs: int, seed: int) -> Array:
    """Points of the unit cube, (runs in all, parameters)."""
    rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(_SAMPLES,)))
    if kind == LATIN_HYPERCUBE:
        from scipy.stats import qmc  # noqa: PLC0415 - slow to import, and workers do without

        return np.asarray(qmc.LatinHypercube(parameters, rng=rng).random(runs))
    if kind == SOBOL:
        from SALib.sample import sobol  # noqa: PLC0415 - loads pandas

        return np.asarray(sobol.sample(unit_problem(parameters), runs, calc_second_order=False, seed=rng))
    return np.asarray(rng.random((runs, parameters)))


def unit_problem(parameters: int) -> dict[str, Any]:
    """Return SALib's description of the unit cube."""
    names = [f"x{j}" for j in range(parameters)]
    return {"num_vars": parameters, "names": names, "bounds": [[0.0, 1.0]] * parameters}


def sweep_values(parameter: Parameter) -> Sequence[Value]:
    """Values of one axis of a sweep."""
    if parameter.values is not None:
        return [value if isinstance(value, str | bool) else float(value) for value in parameter.values]
    assert parameter.from_ is not None
    assert parameter.to is not None
    assert parameter.steps is not None
    return [float(value) for value in np.linspace(parameter.from_, parameter.to, parameter.steps)]


def quantiles(parameter: Parameter, probability: Array) -> Array:
    """Values of a parameter's distribution, cut off at its limits, at these probabilities."""
    law = _law(parameter)
    below = 0.0 if parameter.at_least is None else float(law.cdf(parameter.at_least))
    above = 1.0 if parameter.at_most is None else float(law.cdf(parameter.at_most))
    inside = np.clip(below + probability * (above - below), _SMALLEST, 1.0 - _SMALLEST)
    low = -np.inf if parameter.at_least is None else parameter.at_least
    high = np.inf if parameter.at_most is None else parameter.at_most
    return np.asarray(np.clip(law.ppf(inside), low, high))


def _law(parameter: Parameter) -> Any:
    from scipy import stats  # noqa: PLC0415 - slow to import, and workers do without

    if parameter.distribution == "uniform":
        assert parameter.from_ is not None
        assert parameter.to is not None
        return stats.uniform(parameter.from_, parameter.to - parameter.from_)
    if parameter.distribution == "normal":
        assert parameter.mean is not None
        assert parameter.standard_deviation is not None
        return stats.norm(parameter.mean, parameter.standard_deviation)
    assert parameter.median is not None
    assert parameter.log_standard_deviation is not None
    return stats.lognorm(parameter.log_standard_deviation, scale=parameter.median)


def run_seed(seed: int, run: int) -> int:
    """Seed of one run: a child of the study's seed, whoever flies it and when."""
    state = np.random.SeedSequence(seed, spawn_key=(run,)).generate_state(1, np.uint64)
    return int(state[0] >> np.uint64(1))
