"""Wall-clock times on a shared machine: the least of several repeats is the code, the rest is the neighbours."""

from collections.abc import Callable, Sequence
from statistics import median
from time import perf_counter
from typing import Any


def seconds(call: Callable[[], object], repeats: int) -> list[float]:
    """Duration of each of `repeats` calls [s]."""
    return alternating([call], repeats)[0]


def alternating(calls: Sequence[Callable[[], object]], repeats: int) -> list[list[float]]:
    """Durations [s] of each call, taken in turns so that a slow spell of the machine meets all of them."""
    times: list[list[float]] = [[] for _ in calls]
    for _ in range(repeats):
        for call, durations in zip(calls, times, strict=True):
            begin = perf_counter()
            call()
            durations.append(perf_counter() - begin)
    return times


def summary(times: Sequence[float], unit: float) -> dict[str, Any]:
    """Least and median of `times` [s] in multiples of `unit` [s]."""
    return {"min": min(times) / unit, "median": median(times) / unit, "repeats": len(times)}
