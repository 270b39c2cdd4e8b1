"""Vectors, symmetric matrices and rotations as tuples, so that compiled equations read as they are printed.

Tuples live in registers: none of these functions allocates. Shapes: a `Vector` has 3 components; a `Symmetric` matrix
its 6 entries (xx, yy, zz, xy, xz, yz); a `Matrix` its 9 entries by rows; a `Quaternion` (scalar, i, j, k) rotates from
the body frame to the inertial frame.
"""

from typing import TypeAlias

from stommel.compilation import inlined

Vector: TypeAlias = tuple[float, float, float]
Symmetric: TypeAlias = tuple[float, float, float, float, float, float]
Matrix: TypeAlias = tuple[float, float, float, float, float, float, float, float, float]
Quaternion: TypeAlias = tuple[float, float, float, float]


@inlined
def dot(a: Vector, b: Vector) -> float:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@inlined
def cross(a: Vector, b: Vector) -> Vector:
    """Vector product a x b."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@inlined
def add(a: Vector, b: Vector) -> Vector:
    """Sum of two vectors."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


@inlined
def subtract(a: Vector, b: Vector) -> Vector:
    """Difference a - b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


@inlined
def scale(s: float, a: Vector) -> Vector:
    """Vector `a` times the number `s`."""
    return (s * a[0], s * a[1], s * a[2])


@inlined
def symmetric_times(S: Symmetric, a: Vector) -> Vector:
    """Product of a symmetric matrix and a vector."""
    return (
        S[0] * a[0] + S[3] * a[1] + S[4] * a[2],
        S[3] * a[0] + S[1] * a[1] + S[5] * a[2],
        S[4] * a[0] + S[5] * a[1] + S[2] * a[2],
    )


@inlined
def matrix_times(A: Matrix, a: Vector) -> Vector:
    """Product of a matrix and a vector."""
    return (
        A[0] * a[0] + A[1] * a[1] + A[2] * a[2],
        A[3] * a[0] + A[4] * a[1] + A[5] * a[2],
        A[6] * a[0] + A[7] * a[1] + A[8] * a[2],
    )


@inlined
def transpose_times(A: Matrix, a: Vector) -> Vector:
    """Product of the transpose of a matrix and a vector."""
    return (
        A[0] * a[0] + A[3] * a[1] + A[6] * a[2],
        A[1] * a[0] + A[4] * a[1] + A[7] * a[2],
        A[2] * a[0] + A[5] * a[1] + A[8] * a[2],
    )


@inlined
def symmetric_inverse(S: Symmetric) -> Symmetric:
    """Inverse of a symmetric positive definite matrix by its adjugate: one division."""
    xx = S[1] * S[2] - S[5] * S[5]
    xy = S[4] * S[5] - S[3] * S[2]
    xz = S[3] * S[5] - S[1] * S[4]
    d = 1.0 / (S[0] * xx + S[3] * xy + S[4] * xz)
    return (
        xx * d,
        (S[0] * S[2] - S[4] * S[4]) * d,
        (S[0] * S[1] - S[3] * S[3]) * d,
        xy * d,
        xz * d,
        (S[3] * S[4] - S[0] * S[5]) * d,
    )


@inlined
def rotation(Q: Quaternion) -> Matrix:
    """R_IB of a unit quaternion."""
    w, x, y, z = Q
    return (
        1.0 - 2.0 * (y * y + z * z),
        2.0 * (x * y - w * z),
        2.0 * (x * z + w * y),
        2.0 * (x * y + w * z),
        1.0 - 2.0 * (x * x + z * z),
        2.0 * (y * z - w * x),
        2.0 * (x * z - w * y),
        2.0 * (y * z + w * x),
        1.0 - 2.0 * (x * x + y * y),
    )


@inlined
def to_inertial(Q: Quaternion, a: Vector) -> Vector:
    """R_IB a: components in the inertial frame of the body-frame vector `a`, for a unit quaternion."""
    return matrix_times(rotation(Q), a)


@inlined
def to_body(Q: Quaternion, a: Vector) -> Vector:
    """R_IB' a: components in the body frame of the inertial vector `a`, for a unit quaternion."""
    return transpose_times(rotation(Q), a)


@inlined
def down_in_body(Q: Quaternion) -> Vector:
    """The tilt vector zeta = R_IB' i3: the direction of gravity in the body frame."""
    R = rotation(Q)
    return (R[6], R[7], R[8])


@inlined
def quaternion_rate(Q: Quaternion, omega: Vector) -> Quaternion:
    """Rate of the attitude quaternion for body rates `omega` [rad/s], with a pull back to unit length [1/s]."""
    restore = 0.5 * (1.0 - Q[0] * Q[0] - Q[1] * Q[1] - Q[2] * Q[2] - Q[3] * Q[3])
    p, q, r = 0.5 * omega[0], 0.5 * omega[1], 0.5 * omega[2]
    return (
        -Q[1] * p - Q[2] * q - Q[3] * r + restore * Q[0],
        Q[0] * p + Q[2] * r - Q[3] * q + restore * Q[1],
        Q[0] * q + Q[3] * p - Q[1] * r + restore * Q[2],
        Q[0] * r + Q[1] * q - Q[2] * p + restore * Q[3],
    )
