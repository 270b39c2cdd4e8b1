"""Whether a log can tell the constants of the engine apart."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from stommel.bench.failures import BenchRequestError

Array = NDArray[np.float64]

SINGULAR = 1e-4
"""Least singular value of the unit-normed sensitivities below which some combination of constants changes nothing."""
CORRELATED = 0.95
"""Estimates whose correlation exceeds this are named."""
UNDETERMINED = 0.5
"""A standard error above this share of the value says little about it."""


def require_identifiable(J: Array, names: Sequence[str]) -> None:
    """Refuse constants of which some combination leaves the log as it is.

    Parameters
    ----------
    J
        Sensitivity of every number of the log to every constant; shape (numbers, constants).
    names
        Of the constants.

    Raises
    ------
    BenchRequestError
        Names the constants that cannot be told apart, or the one that has no influence.
    """
    norms = np.linalg.norm(J, axis=0)
    silent = [name for name, norm in zip(names, norms, strict=True) if norm < 1e-9 * np.max(norms)]
    if silent:
        raise BenchRequestError(f"{', '.join(silent)}: these runs do not depend on it; do not fit it")
    _, singular, directions = np.linalg.svd(J / norms)
    if singular[-1] < SINGULAR:
        mixed = [name for name, part in zip(names, directions[-1], strict=True) if abs(part) > 0.1]
        raise BenchRequestError(
            f"{', '.join(mixed)}: these runs cannot tell them apart; fit fewer, or run more speeds and pressures"
        )


def warnings_of(names: Sequence[str], x: Array, errors: Array, correlation: Array) -> tuple[str, ...]:
    """Sentences about estimates that hang together, are hardly determined, or lie at zero."""
    found = []
    for i, name in enumerate(names):
        for j in range(i):
            if abs(correlation[i, j]) > CORRELATED:
                found.append(
                    f"{names[j]} and {name} hang together (correlation {correlation[i, j]:.3f}): "
                    "their intervals are wide, and one may make up for the other"
                )
        if x[i] <= 1e-3 * errors[i]:
            found.append(f"{name} lies at zero, its lower limit: its interval is not to be trusted")
        elif errors[i] > UNDETERMINED * abs(x[i]):
            found.append(f"{name} is hardly determined: standard error {errors[i] / abs(x[i]):.0%} of the value")
    return tuple(found)
