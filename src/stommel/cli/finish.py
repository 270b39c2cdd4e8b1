"""How every verb ends: its answer is looked at, then shown or printed as JSON, and what was written is listed."""

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from math import isfinite, isnan
from pathlib import Path
from typing import Any, Protocol, TypeVar

import typer

from stommel.errors import StommelError


class Described(Protocol):
    """A result that describes itself in words with units."""

    def as_json(self) -> dict[str, Any]:
        """Return tables, lists, numbers, words and None, each number's unit in its key."""


Answer = TypeVar("Answer", bound=Described | Mapping[str, Any] | Sequence[Any])


class NotFiniteError(StommelError):
    """Something in an answer is no number, or without end."""


def finish(answer: Answer, written: Sequence[Path] | None, as_json: bool, show: Callable[[Answer], None]) -> None:
    """End a verb with its answer.

    Parameters
    ----------
    answer
        A result, or a table or list of what results say of themselves.
    written
        The files that were written, in order; None for a verb that never writes any.
    as_json
        Print JSON and nothing else; the files are its key `written`.
    show
        Lays the answer out for a terminal.

    Raises
    ------
    NotFiniteError
        A number of the answer is infinite or no number at all; the message names it.
    """
    described: Any = answer if isinstance(answer, Mapping | Sequence) else answer.as_json()
    _require_finite(described)
    if as_json:
        if written is not None:
            described = {**described, "written": [str(path) for path in written]}
        typer.echo(json.dumps(described, indent=2, allow_nan=False, ensure_ascii=False))
        return
    show(answer)
    for path in written or ():
        typer.echo(f"wrote {path}")


def _require_finite(described: Any) -> None:
    found = list(_not_finite(described, ""))
    if found:
        others = f", as {len(found) - 1} more numbers are not" if len(found) > 1 else ""
        raise NotFiniteError(
            f"the answer is not finite: {found[0]}{others}; a number that was asked for is out of reach"
        )


def _not_finite(value: Any, key: str) -> Iterator[str]:
    """Yield the dotted key of every number that is not finite, and what it became."""
    if isinstance(value, float):
        if not isfinite(value):
            yield f"{key} became {'no number' if isnan(value) else 'infinite'}"
    elif isinstance(value, Mapping):
        for name, inner in value.items():
            yield from _not_finite(inner, f"{key}.{name}".lstrip("."))
    elif isinstance(value, list | tuple):
        for index, inner in enumerate(value):
            yield from _not_finite(inner, f"{key}.{index}".lstrip("."))
