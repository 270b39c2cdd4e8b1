"""One decorator for every compiled function, and one for their building blocks."""

from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar

import numba

from stommel.compilation.flags import COMPILED, INLINED
from stommel.compilation.machine_code import keep

_Arguments = ParamSpec("_Arguments")
_Result = TypeVar("_Result")


def compiled(function: Callable[_Arguments, _Result]) -> Callable[_Arguments, _Result]:
    """Compile `function` with Numba on its first call and keep the machine code on disk for later processes.

    The same source serves real and complex arguments: a complex step through it gives exact derivatives.
    """
    decorate: Any = numba.njit(**COMPILED)
    decorated: Callable[_Arguments, _Result] = decorate(function)
    keep(decorated)
    return decorated


def inlined(function: Callable[_Arguments, _Result]) -> Callable[_Arguments, _Result]:
    """Compile a building block that only compiled code calls; it is kept within its callers, not on disk.

    Inlining is forced: left to itself the compiler makes calls of the larger blocks, passes their tuples through memory
    and repeats what they share (the rotation, the sine and cosine of the mass's roll), at half as much time again.

    A building block allocates nothing, and so counts no references to the arrays that it is given: in the mission loop
    that counting took a fifth of the time.
    """
    njit: Any = numba.njit
    decorate = njit(**INLINED)
    decorated: Callable[_Arguments, _Result] = decorate(function)
    return decorated
