"""A steady flight: what the vehicle does, and the settings that make it do so."""

from dataclasses import dataclass
from math import cos, degrees, inf, sin

import numpy as np
from numpy.typing import NDArray

from stommel.analysis.steady_equations import (
    ALL_EQUATIONS,
    ALPHA,
    BETA,
    DELTA_R,
    MU,
    PHI,
    R_PX,
    THETA,
    TURN,
    V_B,
    V,
    residuals,
)
from stommel.seawater.water import Water


@dataclass(frozen=True)
class SteadyFlight:
    """Steady flight, straight or turning; SI units and radians, symbols of the paper."""

    V: float
    """Speed along the path [m/s]."""
    alpha: float
    """Angle of attack [rad]."""
    beta: float
    """Sideslip [rad]."""
    phi: float
    """Roll [rad]."""
    theta: float
    """Pitch [rad]."""
    turn_rate: float
    """Rate of heading [rad/s]; positive to starboard."""
    r_px: float
    """Position of the moving mass [m]."""
    V_b: float
    """Ballast volume [m3]."""
    delta_r: float
    """Rudder angle [rad]."""
    mu: float
    """Roll angle of the moving mass [rad]."""
    residual: float
    """Largest of the six equilibrium equations that is left over [N, N m]."""

    @property
    def sinking_speed(self) -> float:
        """Speed downwards [m/s]."""
        v = self.velocity
        return -sin(self.theta) * v[0] + cos(self.theta) * (sin(self.phi) * v[1] + cos(self.phi) * v[2])

    @property
    def velocity(self) -> tuple[float, float, float]:
        """Velocity in the body frame (u, v, w) [m/s]."""
        V, alpha, beta = self.V, self.alpha, self.beta
        return V * cos(alpha) * cos(beta), V * sin(beta), V * sin(alpha) * cos(beta)

    @property
    def gamma(self) -> float:
        """Glide-path angle [rad]; negative downwards. Equal to theta - alpha with wings level."""
        return float(np.arcsin(np.clip(-self.sinking_speed / self.V, -1.0, 1.0)))

    @property
    def horizontal_speed(self) -> float:
        """Speed over the ground in still water [m/s]."""
        return self.V * cos(self.gamma)

    @property
    def radius(self) -> float:
        """Radius of the turn [m]; infinite in straight flight."""
        return self.horizontal_speed / abs(self.turn_rate) if self.turn_rate != 0.0 else inf

    @property
    def glide_ratio(self) -> float:
        """Distance over ground per change of depth; the lift-to-drag ratio in straight flight."""
        return self.horizontal_speed / abs(self.sinking_speed) if self.sinking_speed != 0.0 else inf

    def quantities(self) -> NDArray[np.float64]:
        """The ten quantities in the order of `stommel.analysis.steady_equations`."""
        z = np.zeros(10)
        z[[V, ALPHA, BETA, PHI, THETA, TURN, R_PX, V_B, DELTA_R, MU]] = (
            self.V,
            self.alpha,
            self.beta,
            self.phi,
            self.theta,
            self.turn_rate,
            self.r_px,
            self.V_b,
            self.delta_r,
            self.mu,
        )
        return z

    def as_row(self) -> dict[str, float]:
        """Wings-level flight in words with units, the keys of `stommel trim --json`."""
        return {
            "speed_m_s": self.V,
            "pitch_deg": degrees(self.theta),
            "glide_path_deg": degrees(self.gamma),
            "angle_of_attack_deg": degrees(self.alpha),
            "moving_mass_position_mm": self.r_px * 1e3,
            "ballast_volume_ml": self.V_b * 1e6,
            "residual": self.residual,
        }

    def as_turn(self) -> dict[str, float | None]:
        """Turning flight in words with units, the keys of `stommel steady --json`; no radius in straight flight."""
        return {
            **self.as_row(),
            "roll_deg": degrees(self.phi),
            "sideslip_deg": degrees(self.beta),
            "turn_rate_rad_s": self.turn_rate,
            "radius_m": None if self.radius == inf else self.radius,
            "rudder_deg": degrees(self.delta_r),
            "roll_mass_deg": degrees(self.mu),
            "horizontal_speed_m_s": self.horizontal_speed,
            "sinking_speed_m_s": self.sinking_speed,
        }


def flight_from(record: np.record, z: NDArray[np.float64], water: Water) -> SteadyFlight:
    """Make a `SteadyFlight` of ten solved quantities, with its residual measured anew."""
    out = np.empty(8)
    residuals(record, z, water, 0.0, 0.0, out)
    return SteadyFlight(
        V=float(z[V]),
        alpha=float(z[ALPHA]),
        beta=float(z[BETA]),
        phi=float(z[PHI]),
        theta=float(z[THETA]),
        turn_rate=float(z[TURN]),
        r_px=float(z[R_PX]),
        V_b=float(z[V_B]),
        delta_r=float(z[DELTA_R]),
        mu=float(z[MU]),
        residual=float(np.max(np.abs(out[list(ALL_EQUATIONS)]))),
    )
