"""The table of figures: a function that measures, its unit and its bar. Smaller is better unless it is `at_least`."""

import importlib
import pkgutil
import traceback
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, TypedDict

import figures


@dataclass(frozen=True)
class Measurement:
    """Value of a figure in its unit, None if it was skipped, and whatever helps to read it."""

    value: float | None
    detail: dict[str, Any] = field(default_factory=dict)


class Entry(TypedDict):
    """One figure in build/bench.json; `ok` is None if there is no value."""

    value: float | None
    unit: str
    bar: float
    ok: bool | None
    detail: dict[str, Any]


@dataclass(frozen=True)
class Figure:
    """A named quantity that must not exceed its bar, or must reach it if `at_least`."""

    name: str
    unit: str
    bar: float
    measure: Callable[[], Measurement]
    at_least: bool = False


class UnknownFigureError(Exception):
    """No figure has this name."""


_FIGURES: dict[str, Figure] = {}


def figure(
    unit: str, bar: float, *, at_least: bool = False
) -> Callable[[Callable[[], Measurement]], Callable[[], Measurement]]:
    """Register the decorated function as the figure of its name."""

    def register(measure: Callable[[], Measurement]) -> Callable[[], Measurement]:
        name = measure.__name__
        _FIGURES[name] = Figure(name, unit, bar, measure, at_least)
        return measure

    return register


def select(names: Sequence[str] | None) -> list[Figure]:
    """Figures of these names, or all of them.

    Raises
    ------
    UnknownFigureError
        A name is not a figure's.
    """
    for module in pkgutil.iter_modules(figures.__path__, "figures."):
        importlib.import_module(module.name)
    unknown = [name for name in names or () if name not in _FIGURES]
    if unknown:
        raise UnknownFigureError(f"no figure {', '.join(unknown)}; there are: {', '.join(_FIGURES)}")
    return [_FIGURES[name] for name in names or _FIGURES]


def measured(figure: Figure) -> Entry:
    """Measure one figure; a crash becomes an entry with the error in its detail."""
    try:
        found = figure.measure()
    except Exception as error:  # noqa: BLE001  # the remaining figures still run
        found = Measurement(None, {"error": f"{type(error).__name__}: {error}", "traceback": traceback.format_exc()})
    ok = None
    if found.value is not None:
        ok = found.value >= figure.bar if figure.at_least else found.value <= figure.bar
    return {"value": found.value, "unit": figure.unit, "bar": figure.bar, "ok": ok, "detail": found.detail}


def line(name: str, entry: Entry) -> str:
    """One row of the table."""
    detail = entry["detail"]
    if entry["value"] is None:
        value, verdict = "-", f"error: {detail['error']}" if "error" in detail else f"skipped: {detail['skipped']}"
    else:
        value, verdict = f"{entry['value']:.4g}", "yes" if entry["ok"] else "NO"
    return f"{name:32} {value:>12} {entry['unit']:6} {entry['bar']:>8g}  {verdict}"
