"""One decorator for every compiled function, so that all of them share one floating-point contract.

The compiler may fuse a multiplication with an addition (`contract`), as C compilers do, but may not reorder sums:
one machine and one seed give the same bytes. Division by zero follows IEEE 754, as in NumPy.
"""

from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar

import numba

_Arguments = ParamSpec("_Arguments")
_Result = TypeVar("_Result")


def compiled(function: Callable[_Arguments, _Result]) -> Callable[_Arguments, _Result]:
    """Compile `function` with Numba on its first call and keep the machine code on disk for later processes.

    The same source serves real and complex arguments: a complex step through it gives exact derivatives.
    """
    decorate: Any = numba.njit(cache=True, error_model="numpy", fastmath={"contract"})
    decorated: Callable[_Arguments, _Result] = decorate(function)
    return decorated


def inlined(function: Callable[_Arguments, _Result]) -> Callable[_Arguments, _Result]:
    """Compile a small building block that only compiled code calls; it is kept within its callers, not on disk."""
    decorate: Any = numba.njit(error_model="numpy", fastmath={"contract"})
    decorated: Callable[_Arguments, _Result] = decorate(function)
    return decorated
