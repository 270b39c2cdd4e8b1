"""End caps: flat plates and hemispheres under outer pressure."""

from math import cbrt, sqrt

MACHINED_SPHERE = 0.84
"""Krenzke and Kiernan (1963): measured near-perfect spheres buckle at 0.84 E (delta / R_o)^2 at nu = 0.3."""


def flat_wall_clamped(P: float, a: float, sigma: float) -> float:
    """Thickness [m] of a disc of radius a [m], clamped: sigma = 3/4 P (a / t)^2 (Timoshenko 1959, Art. 16)."""
    return a * sqrt(0.75 * P / sigma)


def flat_wall_supported(P: float, a: float, sigma: float, nu: float) -> float:
    """Thickness [m] of a disc of radius a [m] resting on its edge: sigma = 3 (3 + nu) / 8 P (a / t)^2, same source."""
    return a * sqrt(3.0 * (3.0 + nu) / 8.0 * P / sigma)


def zoelly(delta: float, R: float, E: float, nu: float) -> float:
    """Critical pressure [Pa] of a perfect sphere, R [m] to the middle: 2 E (delta / R)^2 / sqrt(3 (1 - nu^2))."""
    return 2.0 * E * (delta / R) ** 2 / sqrt(3.0 * (1.0 - nu**2))


def machined_sphere(delta: float, R_o: float, E: float) -> float:
    """Critical pressure [Pa] of a carefully machined sphere of outer radius R_o [m]: Krenzke and Kiernan (1963)."""
    return MACHINED_SPHERE * E * (delta / R_o) ** 2


def hemisphere_wall(P: float, R_o: float, sigma: float, E: float, factor: float) -> float:
    """Wall [m] of a hemisphere: Lame's stress permissible, and `factor` against the buckling of a machined sphere.

    Infinite where even a solid sphere would not do.
    """
    buckling = R_o * sqrt(factor * P / (MACHINED_SPHERE * E))
    remaining = 1.0 - 1.5 * P / sigma  # (R_i / R_o)^3 of sphere_first_yield
    if remaining <= 0.0:
        return float("inf")
    return max(buckling, R_o * (1.0 - cbrt(remaining)))
