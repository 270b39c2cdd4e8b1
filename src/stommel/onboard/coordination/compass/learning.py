"""The field of an actuator from steady samples before, while and after it runs, at the surface or on land.

The vehicle keeps its attitude meanwhile, so that the Earth's field and the iron stay the same and drop out of the
difference. Fields add: several actuators may run at once, if other samples tell them apart.
"""

from collections.abc import Sequence
from itertools import groupby
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.errors import StommelError
from stommel.onboard.coordination.compass.calibration import ACTUATORS, words_of

LEAST_STEADY = 3
"""Samples in each of the three stretches."""
MOST_DRIFT = 1.0
"""Difference of the field before and after [uT] beyond which the vehicle has turned."""
MOST_ERROR = 1.0
"""Standard error of a learnt field [uT] beyond which it is refused."""


class LearningError(StommelError):
    """Samples that do not tell the field of an actuator; the message names which and why."""


class LearnedField(NamedTuple):
    """Field of an actuator in the body frame, as the magnetometers feel it."""

    field: tuple[float, float, float]
    """[uT]"""
    sigma: float
    """Standard error of each component [uT]."""
    runs: int
    """Runs that tell it."""


class _Step(NamedTuple):
    """What the field does when some actuators begin to run, and stop."""

    running: int
    change: NDArray[np.float64]
    variance: float


def learn(field: NDArray[np.float64], running: Sequence[int]) -> dict[str, LearnedField]:
    """Learn the fields of the actuators.

    Parameters
    ----------
    field
        Felt, one sample after the other (n x 3) [uT].
    running
        Bits of the actuators that ran at each sample; zero before and after each run.

    Returns
    -------
    fields
        Of each actuator that ran, by its name.

    Raises
    ------
    LearningError
        A run has too few samples before, while or after it, or the vehicle turned meanwhile; or two actuators only ran
        together.
    """
    steps = _steps(field, running)
    names = [name for name, bit in ACTUATORS.items() if any(step.running & bit for step in steps)]
    if not names:
        return {}
    rows = np.array([[float(bool(step.running & ACTUATORS[name])) for name in names] for step in steps])
    weights = np.array([1.0 / step.variance for step in steps])
    normal = rows.T @ (weights[:, None] * rows)
    if np.linalg.matrix_rank(normal) < len(names):
        raise LearningError(f"{', '.join(names)}: only ran together; let each run alone once")
    covariance = np.linalg.inv(normal)
    for name, error in zip(names, np.sqrt(np.diag(covariance)), strict=True):
        if error > MOST_ERROR:
            raise LearningError(
                f"{name}: its field is uncertain by {error:.1f} uT, at most {MOST_ERROR:g} uT may be: keep the vehicle "
                "still, or let it run longer or more often"
            )
    found = covariance @ rows.T @ (weights[:, None] * np.array([step.change for step in steps]))
    return {
        name: LearnedField(
            (float(found[i, 0]), float(found[i, 1]), float(found[i, 2])),
            float(np.sqrt(covariance[i, i])),
            int(rows[:, i].sum()),
        )
        for i, name in enumerate(names)
    }


def _steps(field: NDArray[np.float64], running: Sequence[int]) -> list[_Step]:
    """The change of the field by each run."""
    stretches, at = [], 0
    for bits, samples in groupby(running):
        length = len(list(samples))
        stretches.append((bits, at, at + length))
        at += length
    return [
        _step(field, stretches[k - 1] if k else None, stretch, stretches[k + 1] if k + 1 < len(stretches) else None)
        for k, stretch in enumerate(stretches)
        if stretch[0]
    ]


def _step(
    field: NDArray[np.float64],
    earlier: tuple[int, int, int] | None,
    run: tuple[int, int, int],
    later: tuple[int, int, int] | None,
) -> _Step:
    """Compare a run with what stands beside it."""
    bits, start, end = run
    words = f"{words_of(bits)}, samples {start + 1} to {end}"
    if earlier is None or later is None or earlier[0] or later[0]:
        raise LearningError(f"{words}: needs samples before and after it in which nothing runs")
    count = end - start  # as many on either side: farther away the vehicle may have been turned about
    before, after = field[max(earlier[1], start - count) : start], field[end : min(later[2], end + count)]
    during = field[start:end]
    for name, part in (("before", before), ("while", during), ("after", after)):
        if len(part) < LEAST_STEADY:
            raise LearningError(f"{words}: {len(part)} samples {name} it runs, at least {LEAST_STEADY} are needed")
    drift = float(np.linalg.norm(after.mean(axis=0) - before.mean(axis=0)))
    if drift > MOST_DRIFT:
        raise LearningError(
            f"{words}: the field before and after differs by {drift:.1f} uT, at most {MOST_DRIFT:g} uT may be: the "
            "vehicle has turned; keep it still"
        )
    rest = 0.5 * (before.mean(axis=0) + after.mean(axis=0))
    variances = [float(part.var(axis=0, ddof=1).mean()) / len(part) for part in (before, during, after)]
    variance = variances[1] + 0.25 * (variances[0] + variances[2]) + drift**2 / 12.0 + 1e-12
    return _Step(bits, during.mean(axis=0) - rest, variance)
