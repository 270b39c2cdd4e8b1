"""Thick walls: Lame's stresses, yield, plastic collapse, and how much a closed tube shrinks."""

from math import log, sqrt


def tube_first_yield(D_i: float, D_o: float, sigma: float) -> float:
    """Outer pressure [Pa] at which the inside of a closed tube first yields, by Lame and von Mises' stress.

    On the inside the stresses are -2 p k^2 / (k^2 - 1) round the tube, half of that along it and none across it,
    k = D_o / D_i (Timoshenko and Goodier 1970, Art. 28); their equivalent is sqrt(3) p k^2 / (k^2 - 1).
    """
    k2 = (D_o / D_i) ** 2
    return sigma * (1.0 - 1.0 / k2) / sqrt(3.0)


def tube_plastic_collapse(D_i: float, D_o: float, sigma: float) -> float:
    """Outer pressure [Pa] at which the whole wall of a closed tube yields: 2 / sqrt(3) sigma ln(D_o / D_i)."""
    return 2.0 / sqrt(3.0) * sigma * log(D_o / D_i)


def sphere_first_yield(R_i: float, R_o: float, sigma: float) -> float:
    """Outer pressure [Pa] at which the inside of a hollow sphere yields: 2/3 sigma (1 - (R_i / R_o)^3), Lame."""
    return 2.0 / 3.0 * sigma * (1.0 - (R_i / R_o) ** 3)


def tube_compressibility(D_i: float, D_o: float, E: float, nu: float) -> float:
    """Relative loss of displaced volume of a closed tube per unit of outer pressure [1/Pa].

    Strains of Lame's solution at the outside, round the tube twice and along it once; the ends only pass their load on.
    A thin tube has (5 - 4 nu) R / (2 E delta), a solid bar 3 (1 - 2 nu) / E.
    """
    k2 = (D_o / D_i) ** 2 if D_i > 0.0 else float("inf")
    along = 1.0 if k2 == float("inf") else k2 / (k2 - 1.0)  # axial stress over -p
    around = 2.0 * along - 1.0  # hoop stress at the outside over -p: (k2 + 1) / (k2 - 1)
    hoop_strain = around - nu * (1.0 + along)
    axial_strain = along - nu * (1.0 + around)
    return (2.0 * hoop_strain + axial_strain) / E
