"""Numbers on the command line: one, a list `0.2,0.4`, or a range `first:last:step` with both ends."""

from math import floor, isfinite

from stommel.errors import StommelError

MOST = 100_000


class NumberError(StommelError):
    """Text that is not the numbers it should be."""


def numbers(text: str, option: str) -> list[float]:
    """Read the numbers that `option` was given.

    Raises
    ------
    NumberError
        The text is no number, list or range, or a range never reaches its end.
    """
    form = f"{option} = {text!r}: must be a number, a list like 0.2,0.4 or a range like first:last:step"
    try:
        if ":" not in text:
            return [_finite(part) for part in text.split(",")]
        first, last, step = (_finite(part) for part in text.split(":"))
    except ValueError:
        raise NumberError(form) from None
    if step == 0.0 or (last - first) / step < 0.0:
        raise NumberError(f"{option} = {text!r}: steps of {step:g} never lead from {first:g} to {last:g}")
    steps = (last - first) / step
    if not steps < MOST:
        raise NumberError(f"{option} = {text!r}: {steps:.6g} numbers; at most {MOST} are allowed")
    count = floor(steps + 1e-9) + 1
    # rounded, so that 0.1:0.8:0.1 gives 0.3 and not 0.30000000000000004
    return [round(first + k * step, 12) for k in range(count)]


def _finite(text: str) -> float:
    value = float(text)
    if not isfinite(value):
        raise ValueError(text)
    return value
