"""One decorator for every compiled function, so that all of them share one floating-point contract.

The compiler may fuse a multiplication with an addition (`contract`), as C compilers do, but may not reorder sums:
one machine and one seed give the same bytes. Division by zero follows IEEE 754, as in NumPy.
"""

import os
from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar

import numba

from stommel.compilation.cache import folder_of

_Arguments = ParamSpec("_Arguments")
_Result = TypeVar("_Result")


def compiled(function: Callable[_Arguments, _Result]) -> Callable[_Arguments, _Result]:
    """Compile `function` with Numba on its first call and keep the machine code on disk for later processes.

    The same source serves real and complex arguments: a complex step through it gives exact derivatives.
    """
    decorate: Any = numba.njit(cache=True, error_model="numpy", fastmath={"contract"})
    config: Any = numba.config
    before = config.CACHE_DIR
    if not os.environ.get("NUMBA_CACHE_DIR"):
        config.CACHE_DIR = str(folder_of(function.__module__.split(".")[1]))
    try:
        decorated: Callable[_Arguments, _Result] = decorate(function)
    finally:
        config.CACHE_DIR = before
    return decorated


def inlined(function: Callable[_Arguments, _Result]) -> Callable[_Arguments, _Result]:
    """Compile a building block that only compiled code calls; it is kept within its callers, not on disk.

    Inlining is forced: left to itself the compiler makes calls of the larger blocks, passes their tuples through memory
    and repeats what they share (the rotation, the sine and cosine of the mass's roll), at half as much time again.

    A building block allocates nothing, and so counts no references to the arrays that it is given: in the mission loop
    that counting took a fifth of the time.
    """
    njit: Any = numba.njit
    decorate = njit(error_model="numpy", fastmath={"contract"}, forceinline=True, _nrt=False)
    decorated: Callable[_Arguments, _Result] = decorate(function)
    return decorated
