"""Eqs. (8)-(10) of Fan et al. (2013), and what they say of a given wall."""

from math import pow, sqrt

YIELD = "yield, Eq. (8)"
CIRCUMFERENTIAL = "circumferential buckling, Eq. (9)"
AXIAL = "axial buckling, Eq. (10)"

SHORT_TUBE = 2.59
"""Factor of Eq. (9): 2.42 / (1 - 0.3^2)^0.75 of Windenburg and Trilling (1934)."""
AXIAL_FACTOR = 0.182
"""Factor of Eq. (10): 0.3 of the 0.605 of a perfect tube."""


def yield_wall(P: float, D_i: float, sigma: float, phi_s: float = 1.0, C: float = 0.0) -> float:
    """Wall that keeps the hoop stress permissible.

    Parameters
    ----------
    P
        Working pressure [Pa].
    D_i
        Inner diameter [m].
    sigma
        Permissible stress [Pa]; 2 sigma phi_s must exceed P.
    phi_s
        Weld joint efficiency [1].
    C
        Additional wall [m].

    Returns
    -------
    float
        delta_y [m], Eq. (8); infinite where no wall is enough.
    """
    if 2.0 * sigma * phi_s <= P:
        return float("inf")
    return P * D_i / (2.0 * sigma * phi_s - P) + C  # (8)


def yield_wall_in_outer(P: float, D_o: float, sigma: float, phi_s: float = 1.0, C: float = 0.0) -> float:
    """Eq. (8) with the inner diameter that the wall itself leaves in an outer diameter D_o [m]: D_i = D_o - 2 delta."""
    return (P * D_o + (2.0 * sigma * phi_s - P) * C) / (2.0 * sigma * phi_s + P)


def circumferential_wall(P: float, D_o: float, L: float, E: float, m_c: float) -> float:
    """Wall [m] against buckling round the circumference, Eq. (9), for a tube of length L [m] and modulus E [Pa]."""
    return D_o * pow(m_c * P * L / (SHORT_TUBE * E * D_o), 0.4)  # (9)


def axial_critical_stress(delta: float, R: float, E: float, m_a: float) -> float:
    """Permissible critical stress of axial buckling [Pa], Eq. (10); R is the radius of the middle surface [m]."""
    return AXIAL_FACTOR * E * delta / (m_a * R)  # (10)


def axial_wall(P: float, D_o: float, E: float, m_a: float) -> float:
    """Wall [m] whose axial stress P D_o^2 / (8 R delta) equals Eq. (10); the paper compares the stress with P only."""
    return sqrt(m_a * P * D_o**2 / (8.0 * AXIAL_FACTOR * E))


def yield_pressure(delta: float, D_i: float, sigma: float, phi_s: float = 1.0, C: float = 0.0) -> float:
    """Pressure [Pa] at which Eq. (8) asks for the wall delta [m]."""
    wall = max(delta - C, 0.0)
    return 2.0 * sigma * phi_s * wall / (D_i + wall)


def circumferential_pressure(delta: float, D_o: float, L: float, E: float, m_c: float = 1.0) -> float:
    """Pressure [Pa] at which Eq. (9) asks for the wall delta [m]."""
    return SHORT_TUBE * E * pow(delta / D_o, 2.5) * D_o / (L * m_c)


def axial_pressure(delta: float, D_o: float, E: float, m_a: float = 1.0) -> float:
    """Pressure [Pa] at which Eq. (10) asks for the wall delta [m]."""
    return 8.0 * AXIAL_FACTOR * E * (delta / D_o) ** 2 / m_a
