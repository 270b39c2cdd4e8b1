"""The water at one place, as the equations of motion meet it."""

from typing import NamedTuple

from stommel.geometry.vectors import Vector


class Water(NamedTuple):
    """The water at the vehicle; SI units, vectors in the inertial frame (north, east, down)."""

    rho: float
    """Density [kg/m3]."""
    P: float = 0.0
    """Gauge pressure [Pa], which compresses the hull."""
    T: float = 15.0
    """Temperature [deg C], which expands the hull."""
    U: Vector = (0.0, 0.0, 0.0)
    """Current velocity [m/s]."""
    DU_Dt: Vector = (0.0, 0.0, 0.0)
    """Acceleration of the water particle, dU/dt + (U . grad) U [m/s2]."""
