"""Numbers on the command line, within what is allowed: one, a list `0.2,0.4`, or a range `first:last:step`."""

from math import floor, isfinite
from typing import Any

import typer

from stommel.errors import StommelError

MOST = 20_000
"""Numbers of a list or range, and pairs of two; a table of so many rows takes some seconds."""
GREATEST_SEED = (1 << 63) - 1
_LONGEST_SHOWN = 60


class NumberError(StommelError):
    """Text that is not the numbers it should be."""


def number_option(option: str, low: float, high: float, unit: str, meaning: str) -> Any:
    """Return an option that takes a number from `low` to `high`; its help says so."""

    def read(text: object) -> float:
        return _within(_number(str(text), option), str(text), option, (low, high), unit)

    return typer.Option(option, metavar="NUMBER", parser=read, help=_help(meaning, f"{low:g} to {high:g} {unit}"))


def count_option(option: str, low: int, high: int, meaning: str) -> Any:
    """Return an option that takes a whole number from `low` to `high`."""

    def read(text: object) -> int:
        try:
            value = int(str(text)) if len(str(text)) < _LONGEST_SHOWN else high + 1
        except ValueError:
            raise NumberError(f"{option} = {_shown(str(text))}: must be a whole number") from None
        if not low <= value <= high:
            raise NumberError(f"{option} = {_shown(str(text))}: must be between {low} and {high}")
        return value

    return typer.Option(option, metavar="COUNT", parser=read, help=_help(meaning, f"{low} to {high}"))


def _help(meaning: str, ends: str) -> str:
    """What an option means, with its range before what else there is to say."""
    what, semicolon, rest = meaning.partition(";")
    return f"{what}, {ends.rstrip()}{semicolon}{rest}."


def seed_option(meaning: str) -> Any:
    """Return the option of a seed of random numbers."""
    return count_option("--seed", 0, GREATEST_SEED, meaning)


def numbers(text: str, option: str, ends: tuple[float, float], unit: str = "") -> list[float]:
    """Read the numbers that `option` was given, each of which lies between both `ends`.

    Raises
    ------
    NumberError
        The text is no number, list or range, a range never reaches its end, or a number lies beyond what is allowed.
    """
    found = _numbers(text, option)
    for value in (min(found), max(found)):
        _within(value, f"{value:g}" if len(found) > 1 else text, option, ends, unit)
    return found


def _within(value: float, text: str, option: str, ends: tuple[float, float], unit: str) -> float:
    if not ends[0] <= value <= ends[1]:
        allowed = f"between {ends[0]:g} and {ends[1]:g} {unit}".rstrip()
        raise NumberError(f"{option} = {_shown(text)}: must be {allowed}")
    return value


def _number(text: str, option: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise NumberError(f"{option} = {_shown(text)}: must be a number") from None


def _shown(text: str) -> str:
    """What was given, on one line of a readable length."""
    plain = text if text.isprintable() and text.strip() else repr(text)
    return plain if len(plain) <= _LONGEST_SHOWN else f"{plain[:_LONGEST_SHOWN]}..."


def _numbers(text: str, option: str) -> list[float]:
    form = f"{option} = {_shown(repr(text))}: must be a number, a list like 0.2,0.4 or a range like first:last:step"
    try:
        if ":" not in text:
            found = [_finite(part) for part in text.split(",")]
            if len(found) > MOST:
                raise NumberError(f"{option}: {len(found)} numbers; at most {MOST} are allowed")
            return found
        first, last, step = (_finite(part) for part in text.split(":"))
    except ValueError:
        raise NumberError(form) from None
    if step == 0.0 or (last - first) / step < 0.0:
        raise NumberError(f"{option} = {_shown(repr(text))}: steps of {step:g} never lead from {first:g} to {last:g}")
    steps = (last - first) / step
    if not steps < MOST:
        raise NumberError(f"{option} = {_shown(repr(text))}: {steps:.6g} numbers; at most {MOST} are allowed")
    count = floor(steps + 1e-9) + 1
    # rounded, so that 0.1:0.8:0.1 gives 0.3 and not 0.30000000000000004
    return [round(first + k * step, 12) for k in range(count)]


def _finite(text: str) -> float:
    value = float(text)
    if not isfinite(value):
        raise ValueError(text)
    return value


def pairs_of(first: list[float], second: list[float], one: str, other: str) -> list[tuple[float, float]]:
    """Every pair of two lists of numbers, which `one` and `other` name.

    Raises
    ------
    NumberError
        There are too many.
    """
    if len(first) * len(second) > MOST:
        raise NumberError(f"{len(first)} {one} by {len(second)} {other}; at most {MOST} pairs are allowed")
    return [(a, b) for a in first for b in second]
