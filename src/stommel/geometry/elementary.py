"""Square root, sine, cosine, arctangent and arcsine that accept a complex step.

A tiny complex step h (1e-40) carries a derivative in the imaginary part [Squire and Trapp 1998]:
f(x + i h) = f(x) + i h f'(x) + O(h^2), where the O(h^2) is far below rounding. The complex functions of the C
library are slow and lose such small imaginary parts, so these propagate them to first order, exactly as a dual number
would. Real arguments go straight to the C library; where it has no answer, these give NaN, as compiled code does.
"""

import math

from stommel.compilation import before_compiling


def _with_step(value: float, step: float) -> float:
    return complex(value, step)  # type: ignore[return-value]  # stands for a float wherever one is asked for


def sqrt(x: float) -> float:
    """Square root of `x`, with its first derivative in the imaginary part of a complex `x`."""
    if isinstance(x, complex):
        root = sqrt(x.real)
        return _with_step(root, 0.5 * x.imag / root)
    return math.sqrt(x) if x >= 0.0 else math.nan


def atan2(y: float, x: float) -> float:
    """Angle [rad] of the point (x, y), in (-pi, pi]."""
    if isinstance(x, complex) or isinstance(y, complex):
        square = x.real * x.real + y.real * y.real
        return _with_step(math.atan2(y.real, x.real), (x.real * y.imag - y.real * x.imag) / square)
    return math.atan2(y, x)


def asin(x: float) -> float:
    """Arcsine [rad] of `x`, in [-pi/2, pi/2]."""
    if isinstance(x, complex):
        return _with_step(asin(x.real), x.imag / math.sqrt(1.0 - x.real * x.real))
    return math.asin(x) if -1.0 <= x <= 1.0 else math.nan


def cos(x: float) -> float:
    """Cosine of the angle `x` [rad]."""
    if isinstance(x, complex):
        return _with_step(math.cos(x.real), -math.sin(x.real) * x.imag)
    return math.cos(x)


def sin(x: float) -> float:
    """Sine of the angle `x` [rad]."""
    if isinstance(x, complex):
        return _with_step(math.sin(x.real), math.cos(x.real) * x.imag)
    return math.sin(x)


def real_part(x: float) -> float:
    """Value without its complex step, for comparisons."""
    return x.real


@before_compiling
def _tell_numba() -> None:
    from stommel.geometry.elementary_compiled import tell_numba  # noqa: PLC0415 - imports Numba

    tell_numba(sqrt, atan2, asin, cos, sin, real_part)
