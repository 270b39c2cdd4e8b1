"""Finite elements for the buckling of a tube under pressure, for these tests; they share nothing with stommel.

The shell is a row of axial elements with cubic Hermite polynomials in u, v and w, and one Fourier term of n lobes round
the circumference. The energy is that of Sanders and Koiter's shell theory; the pre-buckling state is the membrane state
of a closed tube; the pressure follows the deforming wall (its potential is the pressure times the enclosed volume to
second order). The lowest eigenvalue over all n is the bifurcation pressure. Rings stand inside, fixed to the wall.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

Ends = Literal["simply supported", "clamped"]
Matrix = NDArray[np.float64]


@dataclass(frozen=True)
class Cylinder:
    modulus: float
    poisson: float
    radius: float
    """Of the middle surface."""
    wall: float
    length: float
    ends: Ends = "simply supported"
    hydrostatic: bool = True
    """Pressure on the end caps too; otherwise lateral pressure only."""
    rings: int = 0
    """Evenly spaced rings of rectangular section between the ends."""
    ring_height: float = 0.0
    ring_width: float = 0.0


def bifurcation_pressure(tube: Cylinder, elements: int = 24, lobes: range = range(2, 12)) -> tuple[float, int]:
    """Lowest bifurcation pressure and its number of lobes."""
    return min((_pressure_of(tube, n, elements), n) for n in lobes)


def _hermite(s: float, h: float) -> Matrix:
    """Values, first and second derivatives of the four cubic polynomials at s in [0, 1] of an element of length h."""
    return np.array(
        [
            [1 - 3 * s**2 + 2 * s**3, h * (s - 2 * s**2 + s**3), 3 * s**2 - 2 * s**3, h * (s**3 - s**2)],
            [(6 * s**2 - 6 * s) / h, 1 - 4 * s + 3 * s**2, (6 * s - 6 * s**2) / h, 3 * s**2 - 2 * s],
            [(12 * s - 6) / h**2, (6 * s - 4) / h, (6 - 12 * s) / h**2, (6 * s - 2) / h],
        ]
    )


def _pressure_of(tube: Cylinder, n: int, elements: int) -> float:
    """Eigenvalue of n lobes: u = U cos(n theta), v = V sin(n theta), w = W cos(n theta), W outward."""
    E, nu, R, t, L = tube.modulus, tube.poisson, tube.radius, tube.wall, tube.length
    C, D = E * t / (1 - nu**2), E * t**3 / (12 * (1 - nu**2))
    h, nodes = L / elements, elements + 1
    size = 6 * nodes
    K, G = np.zeros((size, size)), np.zeros((size, size))
    points, weights = np.polynomial.legendre.leggauss(4)
    for e in range(elements):
        index = np.array([6 * e + 2 * field + d + 6 * end for field in range(3) for end in (0, 1) for d in (0, 1)])
        for point, weight in zip(0.5 * (points + 1), 0.5 * h * weights, strict=True):
            N, N1, N2 = _hermite(point, h)
            zero = np.zeros(4)

            def row(u: Matrix, v: Matrix, w: Matrix) -> Matrix:
                return np.concatenate([u, v, w])

            # amplitudes; cos(n theta) and sin(n theta) integrate to the same pi
            U, V, W = row(N, zero, zero), row(zero, N, zero), row(zero, zero, N)
            U_x, V_x, W_x = row(N1, zero, zero), row(zero, N1, zero), row(zero, zero, N1)
            W_xx = row(zero, zero, N2)
            e_x, e_t, g = U_x, (n * V + W) / R, V_x - n * U / R
            k_x, k_t = -W_xx, (n**2 * W + n * V) / R**2
            k_xt = n * W_x / R + 0.75 * V_x / R + 0.25 * n * U / R**2
            local = C * (_sq(e_x) + _sq(e_t) + nu * _mixed(e_x, e_t) + 0.5 * (1 - nu) * _sq(g))
            local += D * (_sq(k_x) + _sq(k_t) + nu * _mixed(k_x, k_t) + 2 * (1 - nu) * _sq(k_xt))
            K[np.ix_(index, index)] += weight * R * local
            # stresses of unit pressure: N_theta = -R, N_x = -R/2; gradients in full
            round_ = _sq(n * U / R) + _sq((n * V + W) / R) + _sq((n * W + V) / R)
            load = R * R * round_
            if tube.hydrostatic:
                load += 0.5 * R * R * (_sq(U_x) + _sq(V_x) + _sq(W_x))
            # second-order volume: 1/2 (w^2 + 2 w v_theta + v^2 + 2 R u_x w)
            load -= _sq(W) + n * _mixed(W, V) + _sq(V) + R * _mixed(U_x, W)
            G[np.ix_(index, index)] += weight * load
    for k in range(1, tube.rings + 1):
        node = round(k * elements / (tube.rings + 1))
        _add_ring(K, tube, n, 6 * node)
    free = np.setdiff1d(np.arange(size), _held(tube.ends, nodes))
    K, G = K[np.ix_(free, free)], G[np.ix_(free, free)]
    # K - p G singular: the largest 1/p of the pencil (G, K), as K is positive definite
    return 1.0 / float(eigh(G, K, eigvals_only=True, subset_by_index=[len(free) - 1, len(free) - 1])[0])


def _add_ring(K: Matrix, tube: Cylinder, n: int, at: int) -> None:
    """Hoop strain energy of a ring: its section is integrated over the distance z from the middle surface."""
    R, top = tube.radius, -0.5 * tube.wall
    points, weights = np.polynomial.legendre.leggauss(4)
    V, W = np.zeros(len(K)), np.zeros(len(K))
    V[at + 2], W[at + 4] = 1.0, 1.0
    for point, weight in zip(points, 0.5 * tube.ring_height * weights, strict=True):
        z = top - 0.5 * tube.ring_height * (1 + point)
        strain = (n * V * (1 + z / R) + n**2 * W * z / R + W) / (R + z)
        K += weight * tube.ring_width * (R + z) * tube.modulus * _sq(strain)


def _sq(a: Matrix) -> Matrix:
    return np.outer(a, a)


def _mixed(a: Matrix, b: Matrix) -> Matrix:
    return np.outer(a, b) + np.outer(b, a)


def _held(ends: Ends, nodes: int) -> list[int]:
    """Degrees of freedom that are zero; a node has U, U', V, V', W, W'."""
    held = []
    for node in (0, nodes - 1):
        held += [6 * node + 2, 6 * node + 4]
        if ends == "clamped":
            held += [6 * node, 6 * node + 5]
    return held
