"""One evaluation of the equations of motion in the most general case, alone and beside the same in C."""

from functools import cache
from statistics import median

import numpy as np
from numpy.typing import NDArray

from figures.c_kernel import FLAGS, CKernel, NoCompilerError, c_kernel, compiler_version
from figures.general_case import ACTUATION, WATER, attached_state, general_vehicle, random_states
from figures.registry import Measurement, figure
from figures.timing import alternating, seconds, summary
from stommel.compilation import compiled
from stommel.dynamics.equations import derivative
from stommel.dynamics.state import STATE_SIZE, Actuation
from stommel.seawater.water import Water

EVALUATIONS = 1_000_000
REPEATS = 9
NANOSECOND = 1e-9

AGREEMENT = 1e-12
"""Largest allowed difference between C and Numba, relative to the rate's own position, attitude, p, h or rest."""

_GROUPS = (slice(0, 3), slice(3, 7), slice(7, 10), slice(10, 13), slice(13, 16))
_FREE = False


class DisagreementError(Exception):
    """C and Numba compute different things, so that a comparison of their speed means nothing."""


@compiled
def _repeat(
    vehicle: np.record, x: np.ndarray, actuation: Actuation, water: Water, free: bool, out: np.ndarray, n: int
) -> float:
    """Evaluate `n` times, each evaluation waiting for the last.

    `derivative` is a call, as it is in C: inlined here, the terms of constant inputs would leave the loop.
    """
    for _ in range(n):
        derivative(vehicle, x, actuation, water, free, out)
        x[7] += 1e-12 * out[7]
    return x[7]


@figure(unit="ns", bar=150.0)
def state_derivative_ns() -> Measurement:
    """Measure one state derivative, general 6 x 6 inertia, on one core [ns]."""
    call = _numba_loop()
    times = summary(seconds(call, REPEATS), EVALUATIONS * NANOSECOND)
    return Measurement(times["min"], times | {"evaluations": EVALUATIONS})


@figure(unit="", bar=1.5)
def state_derivative_ratio_to_c() -> Measurement:
    """Measure the same against the same equations in C, in turns."""
    try:
        in_c = c_kernel()
    except NoCompilerError as error:
        return Measurement(None, {"skipped": str(error)})
    difference = _largest_difference(in_c)
    if not difference <= AGREEMENT:
        raise DisagreementError(f"C and Numba differ by {difference:.1e} (relative); allowed: {AGREEMENT:.0e}")
    vehicle, x = general_vehicle(), attached_state()

    def c_loop() -> None:
        in_c.repeat(vehicle, x.copy(), ACTUATION, WATER, _FREE, EVALUATIONS)

    c_times, numba_times = alternating([c_loop, _numba_loop()], REPEATS)
    detail = {
        "c_ns": summary(c_times, EVALUATIONS * NANOSECOND),
        "numba_ns": summary(numba_times, EVALUATIONS * NANOSECOND),
        "median_ratio": median(b / a for a, b in zip(c_times, numba_times, strict=True)),
        "largest_difference": difference,
        "compiler": f"{compiler_version()} {' '.join(FLAGS)}",
    }
    return Measurement(min(numba_times) / min(c_times), detail)


@cache
def _numba_loop():  # type: ignore[no-untyped-def]  # a call without arguments
    vehicle, x = general_vehicle(), attached_state()
    out = np.empty_like(x)
    _repeat(vehicle, x.copy(), ACTUATION, WATER, _FREE, out, 1)  # compiles
    return lambda: _repeat(vehicle, x.copy(), ACTUATION, WATER, _FREE, out, EVALUATIONS)


def _largest_difference(in_c: CKernel, count: int = 1000) -> float:
    """Largest relative difference between C and Numba over random states and inputs, the mass locked and free."""
    generator = np.random.default_rng(20130)
    vehicle = general_vehicle()
    out = np.empty(STATE_SIZE)
    largest = 0.0
    for x in random_states(generator, count):
        actuation, water = _random_inputs(generator)
        for free in (False, True):
            derivative(vehicle, x, actuation, water, free, out)
            theirs = in_c.derivative(vehicle, x, actuation, water, free)
            largest = max(largest, *(_relative(theirs[group], out[group]) for group in _GROUPS))
    return largest


def _random_inputs(generator: np.random.Generator) -> tuple[Actuation, Water]:
    near_one = generator.uniform(0.5, 1.5, size=13)
    actuation = Actuation(*(float(a) for a in near_one[:6] * np.array(ACTUATION)))
    U = (WATER.U[0] * near_one[7], WATER.U[1] * near_one[8], WATER.U[2] * near_one[9])
    DU_Dt = (WATER.DU_Dt[0] * near_one[10], WATER.DU_Dt[1] * near_one[11], WATER.DU_Dt[2] * near_one[12])
    return actuation, Water(WATER.rho, WATER.P * near_one[6], WATER.T, U, DU_Dt)


def _relative(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    return float(np.linalg.norm(a - b) / np.linalg.norm(b))
