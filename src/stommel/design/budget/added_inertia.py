"""Added moment of inertia of a slender hull, by the closed form of a prolate spheroid."""

from math import log, pi, sqrt


def spheroid_added_inertia(length: float, diameter: float, rho: float) -> float:
    """Added moment of inertia in pitch and yaw of a prolate spheroid [kg m2] (eq-w8).

    Parameters
    ----------
    length, diameter
        Axes of the spheroid [m]; it must be longer than wide.
    rho
        Density of the water [kg/m3].

    Raises
    ------
    ValueError
        The body is not longer than wide.
    """
    a, b = 0.5 * length, 0.5 * diameter
    if not a > b > 0.0:
        raise ValueError(f"length = {length:g} m: must be greater than diameter = {diameter:g} m")
    e2 = 1.0 - (b / a) ** 2
    e = sqrt(e2)
    half_log = 0.5 * log((1.0 + e) / (1.0 - e))
    alpha = 2.0 * (1.0 - e2) / e**3 * (half_log - e)
    beta = 1.0 / e2 - (1.0 - e2) / e**3 * half_log
    k = e2**2 * (beta - alpha) / ((2.0 - e2) * (2.0 * e2 - (2.0 - e2) * (beta - alpha)))
    displaced = 4.0 / 3.0 * pi * rho * a * b**2
    return k * displaced * (a**2 + b**2) / 5.0
