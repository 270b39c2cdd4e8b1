"""What moves and what drives it: the state and the inputs of x' = f(x, u, environment).

The state is the paper's: position, attitude, and the *momenta* of Eqs. (4)-(6), not the velocities. A prescribed motion
of the moving mass or a jump of its speed then needs no acceleration, momentum stays conserved through it, and the
equations stand as printed. `velocities` and `momenta` (in `stommel.dynamics.inertia`) convert.
"""

from typing import NamedTuple

from stommel.geometry.vectors import Quaternion, Vector

STATE_SIZE = 16
"""Length of a flat state: X 0:3, Q 3:7, p 7:10, h 10:13, r_px 13, p_px 14, V_b 15."""

X_NORTH, X_EAST, DEPTH, R_PX, P_PX, V_B = 0, 1, 2, 13, 14, 15
"""Places in a flat state."""

MOMENTA = slice(7, 13)
"""Places of p and h."""


class State(NamedTuple):
    """State of the glider, or its rate; SI units.

    In the driven mode (a self-locking gear holds or drives the moving mass) `p_px` is not a state and stays constant.
    """

    X: Vector
    """Position of the body frame in the inertial frame (north, east, down) [m]."""
    Q: Quaternion
    """Attitude: unit quaternion of the rotation R_IB from the body frame to the inertial frame."""
    p: Vector
    """Translational momentum in the body frame, with the water's [kg m/s]."""
    h: Vector
    """Angular momentum about the body frame's origin, with the water's [kg m2/s]."""
    r_px: float
    """Position of the moving mass along b1 [m]."""
    p_px: float
    """Axial momentum of the moving mass [kg m/s]; a state in the free mode only."""
    V_b: float
    """Ballast volume: displaced volume above neutral [m3]."""


class Actuation(NamedTuple):
    """Inputs u of the equations of motion; SI units."""

    r_px_dot: float = 0.0
    """Speed of the moving mass along b1 relative to the body [m/s]; driven mode."""
    u_px: float = 0.0
    """Force of the drive on the moving mass along b1 [N]; free mode."""
    u_b: float = 0.0
    """Rate of the ballast volume [m3/s]."""
    delta_r: float = 0.0
    """Rudder angle [rad]; positive yaws the nose to starboard."""
    mu: float = 0.0
    """Roll angle of the moving mass about b1 [rad]; positive swings it to port."""
    mu_dot: float = 0.0
    """Rate of `mu` [rad/s]."""
