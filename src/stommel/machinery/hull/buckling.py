"""Classical elastic buckling of tubes under hydrostatic pressure."""

from math import pi, pow, sqrt
from typing import NamedTuple

MOST_LOBES = 60


class Lobes(NamedTuple):
    """Critical pressure and its number of lobes round the circumference."""

    pressure: float
    """[Pa]."""
    n: int


def von_mises(delta: float, R: float, L: float, E: float, nu: float) -> Lobes:
    """Critical pressure of a simply supported tube under pressure on wall and ends, least over the lobes.

    Parameters
    ----------
    delta, R, L
        Wall, radius of the middle surface, length [m]; delta / R at most about 0.1.
    E, nu
        Elastic modulus [Pa], Poisson ratio [1].

    Notes
    -----
    von Mises (1929) in the form of Windenburg and Trilling (1934), their Eq. (6), with R to the middle surface. It lies
    within 1 % of a finite-element solution of Sanders' shell equations for hulls like these (tests/hull).
    """
    lam = pi * R / L

    def pressure(n: int) -> float:
        membrane = 1.0 / (1.0 + (n / lam) ** 2) ** 2
        bending = (delta / R) ** 2 / (12.0 * (1.0 - nu**2)) * (n**2 - 1.0 + lam**2) ** 2
        return E * delta / R / (n**2 - 1.0 + 0.5 * lam**2) * (membrane + bending)

    return min((Lobes(pressure(n), n) for n in range(2, MOST_LOBES)), key=lambda found: found.pressure)


def windenburg_trilling(delta: float, R: float, L: float, E: float, nu: float) -> float:
    """Critical pressure [Pa] without lobes: Windenburg and Trilling (1934), Eq. (9), of tubes shorter than critical.

    Infinite for a tube so short that the formula has no value. A line through the arches of `von_mises`, from 16 %
    below to 15 % above them: not on the safe side.
    """
    D = 2.0 * R
    slender = delta / D
    length = L / D - 0.45 * sqrt(slender)
    if length <= 0.0:
        return float("inf")
    return 2.42 * E * pow(slender, 2.5) / (pow(1.0 - nu**2, 0.75) * length)


def long_tube(delta: float, R: float, E: float, nu: float) -> float:
    """Critical pressure [Pa] of a tube without ends: E / (4 (1 - nu^2)) (delta / R)^3, Bresse and Bryan."""
    return E / (4.0 * (1.0 - nu**2)) * (delta / R) ** 3


def critical_length(delta: float, D_o: float) -> float:
    """Length [m] beyond which the ends no longer help: 1.17 D_o sqrt(D_o / delta), Southwell (1913)."""
    return 1.17 * D_o * sqrt(D_o / delta)


class RingSection(NamedTuple):
    """A ring of rectangular section inside the tube."""

    spacing: float
    """L_f [m]."""
    height: float
    """[m]."""
    width: float
    """[m]."""


def ring_inertia(delta: float, R: float, ring: RingSection) -> float:
    """Second moment of area of a ring with the wall that works with it [m4], about their common centroid.

    The effective breadth is the width of the ring and 1.56 sqrt(R delta), at most the spacing.
    """
    breadth = min(ring.spacing, ring.width + 1.56 * sqrt(R * delta))
    wall, web = breadth * delta, ring.width * ring.height
    apart = 0.5 * (delta + ring.height)
    own = breadth * delta**3 / 12.0 + ring.width * ring.height**3 / 12.0
    return own + wall * web / (wall + web) * apart**2


def bryant(delta: float, R: float, L: float, ring: RingSection, E: float) -> Lobes:
    """Critical pressure of tube and rings buckling together between the ends, least over the lobes: Bryant (1954).

    Parameters
    ----------
    delta, R, L
        Wall, radius of the middle surface, length between bulkheads [m].
    ring
        The rings.
    E
        Elastic modulus of wall and rings [Pa].
    """
    lam = pi * R / L
    EI = E * ring_inertia(delta, R, ring)

    def pressure(n: int) -> float:
        shell = E * delta / R * lam**4 / ((n**2 - 1.0 + 0.5 * lam**2) * (n**2 + lam**2) ** 2)
        return shell + (n**2 - 1.0) * EI / (R**3 * ring.spacing)

    return min((Lobes(pressure(n), n) for n in range(2, MOST_LOBES)), key=lambda found: found.pressure)
