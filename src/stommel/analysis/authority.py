"""Control authority: how far a small actuator change finally takes the flight.

Section 3.2 of the paper trades stability against control authority; these are the numbers on the other side of the
scale. With x' = A x + B u the final change of a stable flight is -A^-1 B u.
"""

from dataclasses import dataclass
from math import cos, degrees, pi

import numpy as np

from stommel.analysis.linearization import Linearization, LinearModel


@dataclass(frozen=True)
class Authority:
    """Final change of the flight per unit of actuator change; linear, about one flight."""

    pitch_deg_per_mm: float
    """Pitch per millimetre of the moving mass; negative: forward pitches down."""
    speed_m_s_per_ml: float
    """Speed along the path per millilitre of ballast."""
    initial_pitch_acceleration_deg_s2_per_mm: float
    """Pitch acceleration at once, before the flight answers."""
    peak_pitch_rate_deg_s_per_mm: float
    """Greatest pitch rate that a step of the moving mass reaches: how briskly the vehicle can be pitched."""
    turn_rate_deg_s_per_rudder_deg: float | None
    """None without a rudder or without lateral coefficients."""
    turn_rate_deg_s_per_roll_deg: float | None
    """Per degree of the moving mass about the hull; None where it cannot roll or without lateral coefficients."""

    def as_row(self) -> dict[str, float | None]:
        """The authority in words with units."""
        return dict(vars(self))


def authority(linear: Linearization) -> Authority:
    """Control authority of the flight that `linear` was linearised about."""
    longitudinal = linear.longitudinal
    final = -np.linalg.solve(longitudinal.A, longitudinal.B)
    u, _, w = linear.flight.velocity
    speed_per_m3 = (u * final[0, 1] + w * final[1, 1]) / linear.flight.V
    rudder, roll = _turn_rates(linear)
    return Authority(
        pitch_deg_per_mm=degrees(final[3, 0]) * 1e-3,
        speed_m_s_per_ml=float(speed_per_m3) * 1e-6,
        initial_pitch_acceleration_deg_s2_per_mm=degrees(longitudinal.B[2, 0]) * 1e-3,
        peak_pitch_rate_deg_s_per_mm=_peak_pitch_rate(longitudinal),
        turn_rate_deg_s_per_rudder_deg=rudder,
        turn_rate_deg_s_per_roll_deg=roll,
    )


def _peak_pitch_rate(longitudinal: LinearModel) -> float:
    """Greatest |q| [deg/s per mm] after a step of r_px, over five periods or time constants of the fastest mode."""
    values, vectors = np.linalg.eig(longitudinal.A)
    shares = np.linalg.solve(vectors, longitudinal.B[:, 0])
    times = np.linspace(0.0, 5.0 * 2.0 * pi / float(np.abs(values).max()), 400)
    q = ((np.exp(np.outer(times, values)) - 1.0) / values * shares) @ vectors[2]
    return degrees(float(np.abs(q.real).max())) * 1e-3


def _turn_rates(linear: Linearization) -> tuple[float | None, float | None]:
    """Final turn rate per angle of rudder and of roll mass; degrees per second per degree."""
    lateral = linear.lateral
    if lateral is None:
        return None, None
    final = -np.linalg.solve(lateral.A, lateral.B)
    # heading rate of a wings-level flight, to first order: psi' = r / cos(theta)
    rates = [float(final[2, j]) / cos(linear.flight.theta) for j in range(2)]
    steers = [bool(np.any(lateral.B[:, j] != 0.0)) for j in range(2)]
    rudder, roll = (rate if able else None for rate, able in zip(rates, steers, strict=True))
    return rudder, roll
