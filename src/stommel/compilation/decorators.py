"""One decorator for every compiled function, and one for their building blocks.

Decorating costs nothing: the compiler is imported when a compiled function is first called, if it is wanted at all
(`stommel.compilation.compiler`). The plain function stays at hand as `py_func`.
"""

from collections.abc import Callable
from functools import cached_property, update_wrapper
from typing import Any, ParamSpec, TypeVar

from stommel.compilation import compiler
from stommel.compilation.flags import COMPILED, INLINED

_Arguments = ParamSpec("_Arguments")
_Result = TypeVar("_Result")


def compiled(function: Callable[_Arguments, _Result]) -> Callable[_Arguments, _Result]:
    """Compile `function` with Numba on its first call and keep the machine code on disk for later processes.

    The same source serves real and complex arguments: a complex step through it gives exact derivatives.
    """
    decorated: Callable[_Arguments, _Result] = _Compiled(function)
    return decorated


def inlined(function: Callable[_Arguments, _Result]) -> Callable[_Arguments, _Result]:
    """Compile a building block that compiled code calls; it is kept within its callers. Python runs it as Python.

    Inlining is forced: left to itself the compiler makes calls of the larger blocks, passes their tuples through memory
    and repeats what they share (the rotation, the sine and cosine of the mass's roll), at half as much time again.

    A building block allocates nothing, and so counts no references to the arrays that it is given: in the mission loop
    that counting took a fifth of the time.
    """
    decorated: Callable[_Arguments, _Result] = _Inlined(function)
    return decorated


def plain(function: Callable[_Arguments, _Result]) -> Callable[_Arguments, _Result]:
    """Return the Python function behind a compiled one; what it calls runs as ever. Other functions are returned."""
    found: Callable[_Arguments, _Result] = getattr(function, "py_func", function)
    return found


class _Decorated:
    """A Python function that becomes machine code when that is wanted; Numba takes it for a dispatcher of its own."""

    _flags: dict[str, Any]
    _kept: bool

    def __init__(self, function: Callable[..., Any]) -> None:
        update_wrapper(self, function)  # type: ignore[arg-type]  # callable in its subclasses
        self.py_func = function

    @cached_property
    def dispatcher(self) -> Any:
        """The function as Numba holds it."""
        return compiler.dispatcher_of(self.py_func, self._flags, kept=self._kept)

    @property
    def _numba_type_(self) -> Any:
        return self.dispatcher._numba_type_

    def __reduce__(self) -> str:
        """Pickle by name, as functions are."""
        return self.py_func.__qualname__


class _Inlined(_Decorated):
    _flags, _kept = INLINED, False

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        return self.py_func(*arguments, **named)


class _Compiled(_Decorated):
    _flags, _kept = COMPILED, True

    def __init__(self, function: Callable[..., Any]) -> None:
        super().__init__(function)
        self._call: Callable[..., Any] = self._first

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        return self._call(*arguments, **named)

    def _first(self, *arguments: Any, **named: Any) -> Any:
        """Call the function as long as nothing has called for its machine code."""
        if compiler.runs_plain():
            try:
                return compiler.run_plain(self.py_func, arguments, named)
            except compiler.CompilerWantedError:
                pass
        self._call = self.dispatcher
        return self._call(*arguments, **named)
