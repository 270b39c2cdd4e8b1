"""Hard and soft iron from samples of a compass that was turned about: least squares, and how well they were spread.

An ellipsoid fitted to the samples gives the iron but for a rotation. The accelerometers tell that rotation: in one
place the field keeps its angle with down, whatever the attitude. So both are asked for at once, of n samples

    |C (b - h)| = F    and    down . C (b - h) = F sin I ,

which is linear in neither, and is solved by Gauss and Newton's method from the ellipsoid on.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.errors import StommelError
from stommel.onboard.coordination.compass.heading import heading_of

Samples = NDArray[np.float64]
"""n x 3."""

LEAST_SAMPLES = 24
WIDEST_GAP = 90.0
"""Between neighbouring headings [deg]; more is refused."""
NARROWEST_TILT = 20.0
"""Span of pitch, and of roll [deg]; less is refused for soft iron, which then looks like a turn about the keel."""
WORST_HEADING = 1.0
"""Standard error of a calibrated heading [deg] beyond which the samples are refused."""
WORST_RESIDUAL = 0.03
"""Root mean square of what is left, as a share of the field, beyond which it was not one field."""
WORST_RESIDUAL_OF_HARD_IRON = 0.06
"""The same where soft iron is not fitted, and so is left over."""
GOOD_GAP, GOOD_TILT, GOOD_HEADING = 45.0, 40.0, 0.4
"""What is warned of beyond [deg]."""

_FLOWN = [(math.radians(theta), math.radians(phi)) for theta in (-40.0, 0.0, 40.0) for phi in (-10.0, 0.0, 10.0)]
"""Pitch and roll of the attitudes that the error is told for."""


class CompassFitError(StommelError):
    """Samples that no calibration can be found of; the message names what they lack."""


class Coverage(NamedTuple):
    """How the samples are spread."""

    samples: int
    heading_gap_deg: float
    """Widest gap between neighbouring headings."""
    pitch_deg: tuple[float, float]
    """Lowest and highest."""
    roll_deg: tuple[float, float]
    """The same."""


@dataclass(frozen=True)
class CompassFit:
    """Iron of a vehicle, and how well it is known."""

    hard_iron: NDArray[np.float64]
    """[uT]"""
    correction: NDArray[np.float64]
    """3 x 3; the Earth's field is this times what is left of the measured one without the hard iron."""
    strength_ut: float
    """Of the Earth's field there, by the sensors' own scale."""
    inclination_deg: float
    """Of the Earth's field, down positive."""
    residual_ut: float
    """Root mean square of what is left of the strength."""
    residual_inclination_deg: float
    """The same of the inclination."""
    heading_error_deg: float
    """Standard error of a heading by this calibration, the largest at pitches to 40 deg and rolls to 10 deg."""
    raw_error_deg: float
    """Largest difference between the raw and the calibrated heading of a sample."""
    coverage: Coverage
    warnings: tuple[str, ...]


def fit_iron(acceleration: Samples, field: Samples, soft_iron: bool = True) -> CompassFit:
    """Fit hard and soft iron.

    Parameters
    ----------
    acceleration
        Felt in the body frame, down positive; the vehicle at rest or turning slowly (n x 3) [g].
    field
        Felt at the same times while nothing runs that disturbs (n x 3) [uT].
    soft_iron
        Whether soft iron is fitted too; without it the samples need less tilt.

    Raises
    ------
    CompassFitError
        The samples are too few, not spread enough, or of no one field.
    """
    usable = np.isfinite(acceleration).all(axis=1) & np.isfinite(field).all(axis=1)
    down, b = acceleration[usable], field[usable]
    if len(b) < LEAST_SAMPLES:
        raise CompassFitError(f"{len(b)} usable samples: at least {LEAST_SAMPLES} are needed")
    lengths = np.linalg.norm(down, axis=1)
    if lengths.min() < 0.8 or lengths.max() > 1.2:
        raise CompassFitError(
            f"the acceleration goes from {lengths.min():.2f} to {lengths.max():.2f} g: must be within 0.8 to 1.2 g, "
            "of a vehicle that is turned slowly"
        )
    down = down / lengths[:, None]
    _refuse_narrow_tilt(down, soft_iron)
    parameters, scale = _start(down, b, soft_iron)
    parameters, jacobian, residuals = _refined(parameters, down, b / scale)
    return _described(parameters, jacobian, residuals, scale, down, b)


def _refuse_narrow_tilt(down: Samples, soft_iron: bool) -> None:
    """Without tilt in both ways soft iron cannot be told."""
    if not soft_iron:
        return
    for name, angles in zip(("pitch", "roll"), _tilts(down), strict=True):
        if np.ptp(angles) < NARROWEST_TILT:
            raise CompassFitError(
                f"coverage of {name}: {np.ptp(angles):.0f} deg from the lowest to the highest sample, at least "
                f"{NARROWEST_TILT:.0f} deg are needed for soft iron; tilt further, or fit hard iron only"
            )


def _tilts(down: Samples) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Pitch and roll of each sample [deg]."""
    across = np.hypot(down[:, 1], down[:, 2])
    return np.degrees(np.arctan2(-down[:, 0], across)), np.degrees(np.arctan2(down[:, 1], down[:, 2]))


def _start(down: Samples, b: Samples, soft_iron: bool) -> tuple[NDArray[np.float64], float]:
    """Return the parameters to begin with, and the strength that the samples are scaled by.

    They are the nine numbers of the correction (one, if no soft iron is asked for), the hard iron and the sine of the
    inclination, all for fields of strength 1.
    """
    middle = b.mean(axis=0)
    scale = float(np.sqrt(((b - middle) ** 2).sum(axis=1).mean()))
    if not scale > 0.01:
        raise CompassFitError("the field is the same in all samples: the compass was not turned, or does not answer")
    x = (b - middle) / scale
    if soft_iron:
        correction, centre = _ellipsoid(x)
        start = correction.ravel()
    else:
        radius, centre = _sphere(x)
        correction = np.eye(3) / radius
        start = np.array([1.0 / radius])
    sines = (down * ((x - centre) @ correction.T)).sum(axis=1)
    return np.concatenate([start, centre + middle / scale, [float(np.median(sines))]]), scale


def _sphere(x: Samples) -> tuple[float, NDArray[np.float64]]:
    """Radius and centre of the sphere nearest to points: |x|^2 = 2 c x + r^2 - |c|^2, linear in c and the rest."""
    rows = np.hstack([2.0 * x, np.ones((len(x), 1))])
    found, _, rank, _ = np.linalg.lstsq(rows, (x * x).sum(axis=1), rcond=1e-10)
    square = found[3] + found[:3] @ found[:3]
    if rank < 4 or not square > 0.0:
        raise CompassFitError("no sphere fits the samples: they lie in one plane; turn and tilt the vehicle further")
    return math.sqrt(square), found[:3]


def _ellipsoid(x: Samples) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Symmetric correction that makes the ellipsoid nearest to points a unit sphere, and its centre."""
    x1, x2, x3 = x.T
    rows = np.column_stack([x1**2, x2**2, x3**2, 2 * x1 * x2, 2 * x1 * x3, 2 * x2 * x3, 2 * x])
    a, _, rank, _ = np.linalg.lstsq(rows, np.ones(len(x)), rcond=1e-10)
    A = np.array([[a[0], a[3], a[4]], [a[3], a[1], a[5]], [a[4], a[5], a[2]]])
    if rank < 9 or np.linalg.eigvalsh(A)[0] <= 0.0:
        raise CompassFitError(
            "no ellipsoid fits the samples: they cover too little of the directions, or are not of one field; turn and "
            "tilt the vehicle further, or fit hard iron only"
        )
    centre = -np.linalg.solve(A, a[6:9])
    values, vectors = np.linalg.eigh(A / (1.0 + centre @ A @ centre))
    return vectors * np.sqrt(values) @ vectors.T, centre


def _correction_of(parameters: NDArray[np.float64]) -> NDArray[np.float64]:
    """The correction that the parameters begin with: nine numbers, or one for all axes."""
    count = len(parameters) - 4
    return parameters[:9].reshape(3, 3) if count == 9 else parameters[0] * np.eye(3)


def _refined(
    parameters: NDArray[np.float64], down: Samples, b: Samples
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Gauss and Newton's method; returns parameters, the last Jacobian and residuals (strengths first)."""
    for _ in range(50):
        jacobian, residuals = _linearised(parameters, down, b)
        step = np.linalg.lstsq(jacobian, -residuals, rcond=1e-12)[0]
        parameters = parameters + step
        if np.abs(step).max() < 1e-10:
            break
    jacobian, residuals = _linearised(parameters, down, b)
    if not np.isfinite(residuals).all():
        raise CompassFitError("the fit does not settle: the samples are not of one field")
    return parameters, jacobian, residuals


def _linearised(
    parameters: NDArray[np.float64], down: Samples, b: Samples
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Jacobian and residuals of |m| = 1 and down . m = sin I."""
    C = _correction_of(parameters)
    left = b - parameters[-4:-1]
    m = left @ C.T
    strengths = np.linalg.norm(m, axis=1)
    blocks = []
    for along in (m / strengths[:, None], down):
        by_matrix = along[:, :, None] * left[:, None, :]  # of C, row by row
        by_C = by_matrix.reshape(-1, 9)
        if len(parameters) == 5:
            by_C = np.einsum("ijj->i", by_matrix)[:, None]
        blocks.append(np.hstack([by_C, -along @ C, np.zeros((len(b), 1))]))
    blocks[1][:, -1] = -1.0
    residuals = np.concatenate([strengths - 1.0, (down * m).sum(axis=1) - parameters[-1]])
    return np.vstack(blocks), residuals


def _described(
    parameters: NDArray[np.float64],
    jacobian: NDArray[np.float64],
    residuals: NDArray[np.float64],
    scale: float,
    down: Samples,
    b: Samples,
) -> CompassFit:
    """Look at what was found, and refuse it by name if it is not good enough."""
    C, centre, sine = _correction_of(parameters), parameters[-4:-1] * scale, float(parameters[-1])
    strength = scale / float(np.cbrt(np.linalg.det(C)))  # the correction itself keeps volumes
    if not math.isfinite(strength) or strength <= 0.0 or abs(sine) >= 1.0:
        raise CompassFitError("the fit does not settle: the samples are not of one field")
    n = len(b)
    rms = float(np.sqrt((residuals[:n] ** 2).mean()))
    worst = WORST_RESIDUAL if len(parameters) == 13 else WORST_RESIDUAL_OF_HARD_IRON
    if rms > worst:
        raise CompassFitError(
            f"{100 * rms:.1f} % of the field is left over, at most {100 * worst:.0f} % may be: it was not one "
            "field; keep away from iron, and let nothing run meanwhile"
        )
    corrected = (b - centre) @ C.T
    headings = np.array([heading_of(tuple(a), tuple(m)) for a, m in zip(down, corrected, strict=True)])
    raw = np.array([heading_of(tuple(a), tuple(m)) for a, m in zip(down, b, strict=True)])
    pitch, roll = _tilts(down)
    coverage = Coverage(n, _widest_gap(headings), (pitch.min(), pitch.max()), (roll.min(), roll.max()))
    error = _heading_error(parameters, jacobian, residuals, math.asin(sine))
    _refuse_poor(coverage, error)
    return CompassFit(
        hard_iron=centre,
        correction=C * strength / scale,
        strength_ut=strength,
        inclination_deg=math.degrees(math.asin(sine)),
        residual_ut=rms * strength,
        residual_inclination_deg=math.degrees(float(np.sqrt((residuals[n:] ** 2).mean())) / math.sqrt(1.0 - sine**2)),
        heading_error_deg=error,
        raw_error_deg=float(np.degrees(np.abs(np.angle(np.exp(1j * (raw - headings))))).max()),
        coverage=coverage,
        warnings=_warnings(coverage, error, soft_iron=len(parameters) == 13),
    )


def _widest_gap(headings: NDArray[np.float64]) -> float:
    """Widest gap between neighbouring headings [deg]."""
    around = np.sort(headings)
    return float(np.degrees(np.diff(np.append(around, around[0] + 2.0 * math.pi)).max()))


def _heading_error(
    parameters: NDArray[np.float64], jacobian: NDArray[np.float64], residuals: NDArray[np.float64], inclination: float
) -> float:
    """Largest standard error of a heading that the uncertainty of the parameters leaves [deg]."""
    n, p = jacobian.shape
    values, vectors = np.linalg.eigh(jacobian.T @ jacobian)
    if values[0] <= 1e-12 * values[-1]:
        return math.inf
    covariance = (vectors / values) @ vectors.T * (residuals @ residuals) / (n - p)
    C, level = _correction_of(parameters), math.cos(inclination)
    C_inverse = np.linalg.inv(C)
    worst = 0.0
    for theta, phi in _FLOWN:
        for psi in np.radians(np.arange(0.0, 360.0, 30.0)):
            R = _to_body(phi, theta, psi)
            left = C_inverse @ R @ [level, 0.0, math.sin(inclination)]
            east = R @ [0.0, 1.0, 0.0]
            by_C = np.outer(east, left).ravel() if p == 13 else [float(east @ left)]
            gradient = np.concatenate([by_C, -east @ C, [0.0]]) / level  # the part to the east turns the heading
            worst = max(worst, float(gradient @ covariance @ gradient))
    return math.degrees(math.sqrt(worst))


def _to_body(phi: float, theta: float, psi: float) -> NDArray[np.float64]:
    """Rotation from north, east, down to the body frame."""
    (s1, s2, s3), (c1, c2, c3) = np.sin([phi, theta, psi]), np.cos([phi, theta, psi])
    return np.array(
        [
            [c2 * c3, c2 * s3, -s2],
            [s1 * s2 * c3 - c1 * s3, s1 * s2 * s3 + c1 * c3, s1 * c2],
            [c1 * s2 * c3 + s1 * s3, c1 * s2 * s3 - s1 * c3, c1 * c2],
        ]
    )


def _refuse_poor(coverage: Coverage, error: float) -> None:
    if coverage.heading_gap_deg > WIDEST_GAP:
        raise CompassFitError(
            f"coverage of heading: a gap of {coverage.heading_gap_deg:.0f} deg without a sample, at most "
            f"{WIDEST_GAP:.0f} deg may be; turn the vehicle all the way round"
        )
    if error > WORST_HEADING:
        raise CompassFitError(
            f"coverage: the samples leave a heading uncertain by {error:.3g} deg, at most {WORST_HEADING:g} deg may "
            "be; turn and tilt the vehicle further, or take more samples"
        )


def _warnings(coverage: Coverage, error: float, soft_iron: bool) -> tuple[str, ...]:
    found = []
    if coverage.heading_gap_deg > GOOD_GAP:
        found.append(f"coverage of heading: a gap of {coverage.heading_gap_deg:.0f} deg without a sample")
    for name, (low, high) in (("pitch", coverage.pitch_deg), ("roll", coverage.roll_deg)):
        if soft_iron and high - low < GOOD_TILT:
            found.append(f"coverage of {name}: only {high - low:.0f} deg from the lowest to the highest sample")
    if error > GOOD_HEADING:
        found.append(f"the samples leave a heading uncertain by {error:.2f} deg")
    return tuple(found)
