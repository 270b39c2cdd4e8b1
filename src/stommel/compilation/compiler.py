"""When the compiler is imported, and what runs without it.

A library compiles: the first call of a compiled function imports Numba, which takes half a second, and every call then
takes microseconds. One question on the command line is answered sooner as plain Python, unless it turns out to be a
long one. Where Numba is missing, as on a vehicle's small computer, or `STOMMEL_COMPILE=0` forbids it, all runs as plain
Python.
"""

import os
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from functools import cache
from importlib.util import find_spec
from typing import Any

PATIENCE = 250
"""Calls of compiled functions as plain Python, a quarter of a second, after which a question is a long one."""


class CompilerWantedError(Exception):
    """The function is not done as plain Python, and its arguments are as they were."""


class _TooLongError(Exception):
    pass


class _Question:
    """What is being asked of this process: one question, or any number of them (a library)."""

    is_one = False
    never = False
    """Nothing is compiled, however long it takes."""
    is_running = False
    """A compiled function is running as plain Python, and may call others."""
    calls = 0


_question = _Question()
_extensions: list[Callable[[], None]] = []


@contextmanager
def one_question() -> Iterator[None]:
    """Run compiled functions as plain Python here, as long as that is the shorter way; the last digits may differ."""
    before, _question.is_one, _question.calls = _question.is_one, True, 0
    try:
        yield
    finally:
        _question.is_one = before


@contextmanager
def without_compiler() -> Iterator[None]:
    """Run all as plain Python here however long it takes, as a vehicle's small computer does."""
    before, _question.never = _question.never, True
    try:
        yield
    finally:
        _question.never = before


@cache
def is_available() -> bool:
    """Tell whether there is a compiler, and nobody forbids it."""
    forbidden = os.environ.get("STOMMEL_COMPILE") == "0" or os.environ.get("NUMBA_DISABLE_JIT", "0") not in {"", "0"}
    return not forbidden and find_spec("numba") is not None


def _may_compile() -> bool:
    return is_available() and not _question.never


def runs_plain() -> bool:
    """Tell whether a function without machine code runs as plain Python now."""
    return not _may_compile() or _question.is_running or (_question.is_one and _question.calls <= PATIENCE)


def run_plain(function: Callable[..., Any], arguments: tuple[Any, ...], named: Mapping[str, Any]) -> Any:
    """Run a compiled function as plain Python, with floating-point errors as in compiled code.

    Raises
    ------
    CompilerWantedError
        It takes too long, or stops where compiled code goes on with infinity or NaN (1.0 / 0.0, the root of -1).
    """
    from numpy import errstate  # noqa: PLC0415 - `stommel --help` does without

    _question.calls += 1
    if _question.is_running:
        if _question.calls > PATIENCE and _may_compile():
            raise _TooLongError
        return function(*arguments, **named)
    given = (*arguments, *named.values()) if _may_compile() else ()
    before = [(one, one.copy()) for one in _changeable(given)]
    _question.is_running = True
    try:
        with errstate(all="ignore"):
            return function(*map(_by_name, arguments), **{name: _by_name(one) for name, one in named.items()})
    except (_TooLongError, ArithmeticError, ValueError) as error:
        if not _may_compile():
            raise
        for one, old in before:
            _put_back(one, old)
        raise CompilerWantedError from error
    finally:
        _question.is_running = False


def _changeable(arguments: Iterable[Any]) -> Iterator[Any]:
    """Arrays and records that a function may change, also within tuples."""
    import numpy as np  # noqa: PLC0415

    for one in arguments:
        if isinstance(one, tuple):
            yield from _changeable(one)
        elif isinstance(one, np.ndarray | np.record) and one.flags.writeable:
            yield one


def _put_back(one: Any, old: Any) -> None:
    """Let an array or a record be what its copy is."""
    names = () if one.shape else one.dtype.names or ()
    for name in names:
        one[name] = old[name]
    if not names:
        one[...] = old


def _by_name(argument: Any) -> Any:
    """An argument whose arrays of records, within any tuples, give the fields of a row as attributes.

    In compiled code they do so by themselves.
    """
    import numpy as np  # noqa: PLC0415

    if isinstance(argument, tuple):
        return _tuple_by_name(argument)
    structured = isinstance(argument, np.ndarray) and argument.dtype.names is not None
    return argument.view(np.recarray) if structured else argument


def _tuple_by_name(argument: tuple[Any, ...]) -> tuple[Any, ...]:
    parts = [part if isinstance(part, float) else _by_name(part) for part in argument]
    if all(part is given for part, given in zip(parts, argument, strict=True)):
        return argument
    make: Callable[[list[Any]], tuple[Any, ...]] = getattr(argument, "_make", tuple)  # of named tuples
    return make(parts)


def before_compiling(extension: Callable[[], None]) -> Callable[[], None]:
    """Call the decorated function once before anything is compiled: it tells Numba what it needs to know."""
    if sys.modules.get("numba"):
        extension()
    else:
        _extensions.append(extension)
    return extension


def dispatcher_of(function: Callable[..., Any], flags: Mapping[str, Any], *, kept: bool) -> Any:
    """Return a function as Numba holds it; its machine code is `kept` on disk, or lies within its callers."""
    import numba  # noqa: PLC0415 - half a second

    while _extensions:
        _extensions.pop()()
    decorate: Any = numba.njit(**flags)
    dispatcher = decorate(function)
    if kept:
        from stommel.compilation.machine_code import keep  # noqa: PLC0415 - imports Numba

        keep(dispatcher)
    return dispatcher
