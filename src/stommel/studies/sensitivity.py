"""Which parameters matter: Sobol indices from Saltelli's design, regression coefficients from any other."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stommel.studies.sampling import unit_problem
from stommel.studies.study_file import SOBOL

Array = NDArray[np.float64]

_RESAMPLES = 200
"""Bootstrap samples of the intervals of Sobol indices."""


@dataclass(frozen=True)
class Sensitivity:
    """Measures of every output (rows) over the parameters (columns); nan where an output never changes."""

    method: str
    """sobol or regression."""
    outputs: tuple[str, ...]
    parameters: tuple[str, ...]
    measures: Mapping[str, Array]
    """Sobol: `first_order`, `total`, and half their 95 % intervals. Regression: `coefficient`, standardised."""
    explained: Array
    """Share of the variance that the measures explain: sum of first orders, or R squared."""
    runs: int
    """Runs that were used."""

    def as_row(self) -> dict[str, dict[str, dict[str, float | None]]]:
        """Measure, output, parameter; None where an output never changes."""
        return {
            measure: {
                name: {
                    parameter: float(value) if np.isfinite(value) else None
                    for parameter, value in zip(self.parameters, row, strict=True)
                }
                for name, row in zip(self.outputs, values, strict=True)
            }
            for measure, values in self.measures.items()
        }


def sensitivity_of(
    kind: str, names: Sequence[str], values: Array, outputs: Mapping[str, Array], seed: int
) -> Sensitivity | None:
    """Sensitivity of outputs to parameters.

    Parameters
    ----------
    kind
        Of the study; a Sobol study must have its runs in the order of the design.
    names
        Of the parameters.
    values
        Of the parameters (runs, parameters); nan in the columns of those that are no numbers.
    outputs
        Values of every run by name; nan for failed runs.
    seed
        Of the bootstrap.

    Returns
    -------
    Sensitivity or None
        None if there are too few finished runs.

    Notes
    -----
    Sobol indices by SALib (Saltelli et al. 2010, doi:10.1016/j.cpc.2009.09.018); a base point with a failed run is left
    out with all its runs. Regression: least squares on parameters and output divided by their standard deviations;
    coefficients are comparable, and their squares sum to R squared where the parameters are independent.
    """
    if kind == SOBOL:
        return _sobol(tuple(names), outputs, seed)
    numeric = np.isfinite(values).all(axis=0) & (np.ptp(np.nan_to_num(values), axis=0) > 0.0)
    if not numeric.any():
        return None
    return _regression(tuple(names), outputs, values, numeric)


def _sobol(names: tuple[str, ...], outputs: Mapping[str, Array], seed: int) -> Sensitivity | None:
    from SALib.analyze import sobol  # noqa: PLC0415 - loads pandas

    count, used = len(names), 0
    keys = {"first_order": "S1", "first_order_interval": "S1_conf", "total": "ST", "total_interval": "ST_conf"}
    measures = {measure: np.full((len(outputs), count), np.nan) for measure in keys}
    for i, column in enumerate(outputs.values()):
        whole = np.repeat(np.isfinite(column).reshape(-1, count + 2).all(axis=1), count + 2)
        if whole.sum() < 2 * (count + 2) or _constant(column[whole]):
            continue
        used = max(used, int(whole.sum()))
        found = sobol.analyze(
            unit_problem(count), column[whole], calc_second_order=False, num_resamples=_RESAMPLES, seed=seed + 1
        )
        for measure, key in keys.items():
            measures[measure][i] = found[key]
    if not used:
        return None
    return Sensitivity("sobol", tuple(outputs), names, measures, measures["first_order"].sum(axis=1), used)


def _regression(
    names: tuple[str, ...], outputs: Mapping[str, Array], values: Array, numeric: NDArray[np.bool_]
) -> Sensitivity | None:
    coefficients = np.full((len(outputs), len(names)), np.nan)
    explained = np.full(len(outputs), np.nan)
    used = 0
    for i, column in enumerate(outputs.values()):
        good = np.isfinite(column)
        if good.sum() < numeric.sum() + 2 or _constant(column[good]):
            continue
        used = max(used, int(good.sum()))
        inputs, output = _standardised(values[good][:, numeric]), _standardised(column[good])
        fit: Any = np.linalg.lstsq(inputs, output, rcond=None)[0]
        coefficients[i, numeric] = fit
        explained[i] = 1.0 - float(np.var(output - inputs @ fit))
    if not used:
        return None
    return Sensitivity("regression", tuple(outputs), names, {"coefficient": coefficients}, explained, used)


def _constant(column: Array) -> bool:
    """Say whether nothing but rounding changes."""
    return bool(np.ptp(column) <= 1e-12 * np.abs(column).max())


def _standardised(columns: Array) -> Array:
    spread = columns.std(axis=0)
    centred: Array = (columns - columns.mean(axis=0)) / np.where(spread > 0.0, spread, 1.0)
    return centred
