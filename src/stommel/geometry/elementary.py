"""Square root, sine, cosine, arctangent and arcsine that accept a complex step.

A tiny complex step h (1e-40) carries a derivative in the imaginary part [Squire and Trapp 1998]:
f(x + i h) = f(x) + i h f'(x) + O(h^2), where the O(h^2) is far below rounding. The complex functions of the C
library are slow and lose such small imaginary parts, so these propagate them to first order, exactly as a dual number
would. Real arguments go straight to the C library.
"""

import math

from numba.core import types
from numba.extending import overload


def sqrt(x: float) -> float:
    """Square root of `x`, with its first derivative in the imaginary part of a complex `x`."""
    return math.sqrt(x)


def atan2(y: float, x: float) -> float:
    """Angle [rad] of the point (x, y), in (-pi, pi]."""
    return math.atan2(y, x)


def asin(x: float) -> float:
    """Arcsine [rad] of `x`, in [-pi/2, pi/2]."""
    return math.asin(x)


def cos(x: float) -> float:
    """Cosine of the angle `x` [rad]."""
    return math.cos(x)


def sin(x: float) -> float:
    """Sine of the angle `x` [rad]."""
    return math.sin(x)


def real_part(x: float) -> float:
    """Value without its complex step, for comparisons."""
    return x.real


@overload(sqrt)
def _sqrt(x):  # type: ignore[no-untyped-def]  # Numba compares signatures
    if isinstance(x, types.Complex):

        def complex_sqrt(x):  # type: ignore[no-untyped-def]  # as above
            root = math.sqrt(x.real)
            return complex(root, 0.5 * x.imag / root)

        return complex_sqrt
    return lambda x: math.sqrt(x)


@overload(atan2)
def _atan2(y, x):  # type: ignore[no-untyped-def]  # Numba compares signatures
    if isinstance(x, types.Complex) or isinstance(y, types.Complex):

        def complex_atan2(y, x):  # type: ignore[no-untyped-def]  # as above
            square = x.real * x.real + y.real * y.real
            return complex(math.atan2(y.real, x.real), (x.real * y.imag - y.real * x.imag) / square)

        return complex_atan2
    return lambda y, x: math.atan2(y, x)


@overload(asin)
def _asin(x):  # type: ignore[no-untyped-def]  # Numba compares signatures
    if isinstance(x, types.Complex):

        def complex_asin(x):  # type: ignore[no-untyped-def]  # as above
            return complex(math.asin(x.real), x.imag / math.sqrt(1.0 - x.real * x.real))

        return complex_asin
    return lambda x: math.asin(x)


@overload(cos)
def _cos(x):  # type: ignore[no-untyped-def]  # Numba compares signatures
    if isinstance(x, types.Complex):
        return lambda x: complex(math.cos(x.real), -math.sin(x.real) * x.imag)
    return lambda x: math.cos(x)


@overload(sin)
def _sin(x):  # type: ignore[no-untyped-def]  # Numba compares signatures
    if isinstance(x, types.Complex):
        return lambda x: complex(math.sin(x.real), math.cos(x.real) * x.imag)
    return lambda x: math.sin(x)


@overload(real_part)
def _real_part(x):  # type: ignore[no-untyped-def]  # Numba compares signatures
    if isinstance(x, types.Complex):
        return lambda x: x.real
    return lambda x: x
