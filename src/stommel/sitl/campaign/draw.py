"""Random faults of a flight, all from its seed."""

from math import copysign, inf, log

import numpy as np

from stommel.sitl.faults.fault import Fault
from stommel.sitl.faults.table import DRAWN, SENSORS, FaultKind

MOST = 4
"""Faults of a flight."""
FOR_EVER = 0.5
"""Share of the faults that never end."""
_WIDE = 10.0
"""Values that differ by more than this factor are drawn by their magnitude."""


def draw_faults(seed: int, latest: float, kinds: tuple[FaultKind, ...] = DRAWN) -> tuple[Fault, ...]:
    """Draw one to four faults that begin before a time [s]."""
    draw = np.random.default_rng((seed, 2))
    return tuple(_fault(draw, latest, kinds) for _ in range(int(draw.integers(1, MOST, endpoint=True))))


def _fault(draw: np.random.Generator, latest: float, kinds: tuple[FaultKind, ...]) -> Fault:
    row = kinds[int(draw.integers(len(kinds)))]
    target = str(draw.choice(row.targets)) if row.targets else ""
    at = float(draw.integers(0, int(latest)))
    # seconds and half hours alike
    lasts = inf if draw.random() < FOR_EVER else float(round(1800.0 ** draw.random()))
    value = _rounded(_value(draw, *row.drawn)) if row.has_value else row.default
    if row.name in ("sensor_biased", "sensor_noisy"):
        sensor = SENSORS[target]
        value = _rounded(value * (sensor.bias if row.name == "sensor_biased" else sensor.noise))
    return Fault(row.name, target, at, lasts, value)


def _value(draw: np.random.Generator, low: float, high: float) -> float:
    if low < 0.0:
        return copysign(_value(draw, 1e-3 * high, high), draw.random() - 0.5)
    if low > 0.0 and high > _WIDE * low:
        return float(low * np.exp(draw.random() * log(high / low)))
    return float(draw.uniform(low, high))


def _rounded(value: float) -> float:
    """To the digits that a scenario file says."""
    return float(f"{value:.4g}")
