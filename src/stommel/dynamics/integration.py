"""Integration of the equations of motion with a fixed step (compiled)."""

import numpy as np

from stommel.compilation import compiled
from stommel.dynamics.equations import rates, state_from_array, state_into_array
from stommel.dynamics.state import STATE_SIZE, Actuation
from stommel.seawater.water import Water


@compiled
def integrate(
    vehicle: np.record,
    x: np.ndarray,
    actuation: Actuation,
    water: Water,
    free: bool,
    step: float,
    steps: int,
    out: np.ndarray,
) -> None:
    """Fly `steps` steps of `step` seconds from the flat state `x` with constant inputs, by classical Runge-Kutta.

    `x` is changed in place to the last state. The rows of `out` (rows x 16) receive the states at equal intervals, the
    last one at the end; `steps` must be a multiple of its number of rows, which may be zero.
    """
    k = np.empty((4, STATE_SIZE))
    trial = np.empty(STATE_SIZE)
    every = steps // len(out) if len(out) > 0 else steps + 1
    for i in range(steps):
        state_into_array(rates(vehicle, state_from_array(x), actuation, water, free), k[0])
        for stage in range(1, 4):
            fraction = step if stage == 3 else 0.5 * step
            for j in range(STATE_SIZE):
                trial[j] = x[j] + fraction * k[stage - 1, j]
            state_into_array(rates(vehicle, state_from_array(trial), actuation, water, free), k[stage])
        for j in range(STATE_SIZE):
            x[j] += step / 6.0 * (k[0, j] + 2.0 * (k[1, j] + k[2, j]) + k[3, j])
        if (i + 1) % every == 0:
            out[(i + 1) // every - 1] = x
