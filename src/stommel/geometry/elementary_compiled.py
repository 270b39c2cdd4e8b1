"""What Numba makes of the elementary functions: reals go straight to the C library, complex numbers carry a step."""

import math
from collections.abc import Callable
from typing import Any

from numba.core import types
from numba.extending import overload


def _sqrt(x):  # type: ignore[no-untyped-def]  # Numba compares signatures
    if isinstance(x, types.Complex):

        def complex_sqrt(x):  # type: ignore[no-untyped-def]  # as above
            root = math.sqrt(x.real)
            return complex(root, 0.5 * x.imag / root)

        return complex_sqrt
    return lambda x: math.sqrt(x)


def _atan2(y, x):  # type: ignore[no-untyped-def]  # Numba compares signatures
    if isinstance(x, types.Complex) or isinstance(y, types.Complex):

        def complex_atan2(y, x):  # type: ignore[no-untyped-def]  # as above
            square = x.real * x.real + y.real * y.real
            return complex(math.atan2(y.real, x.real), (x.real * y.imag - y.real * x.imag) / square)

        return complex_atan2
    return lambda y, x: math.atan2(y, x)


def _asin(x):  # type: ignore[no-untyped-def]  # Numba compares signatures
    if isinstance(x, types.Complex):

        def complex_asin(x):  # type: ignore[no-untyped-def]  # as above
            return complex(math.asin(x.real), x.imag / math.sqrt(1.0 - x.real * x.real))

        return complex_asin
    return lambda x: math.asin(x)


def _cos(x):  # type: ignore[no-untyped-def]  # Numba compares signatures
    if isinstance(x, types.Complex):
        return lambda x: complex(math.cos(x.real), -math.sin(x.real) * x.imag)
    return lambda x: math.cos(x)


def _sin(x):  # type: ignore[no-untyped-def]  # Numba compares signatures
    if isinstance(x, types.Complex):
        return lambda x: complex(math.sin(x.real), math.cos(x.real) * x.imag)
    return lambda x: math.sin(x)


def _real_part(x):  # type: ignore[no-untyped-def]  # Numba compares signatures
    if isinstance(x, types.Complex):
        return lambda x: x.real
    return lambda x: x


_MADE_OF = {"sqrt": _sqrt, "atan2": _atan2, "asin": _asin, "cos": _cos, "sin": _sin, "real_part": _real_part}


def tell_numba(*functions: Callable[..., Any]) -> None:
    """Let Numba compile each of the elementary functions by what stands here under its name."""
    for function in functions:
        overload(function)(_MADE_OF[function.__name__])  # type: ignore[type-var]  # it takes any function
