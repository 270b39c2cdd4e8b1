"""What the vehicle's software is told before a mission: dives, laws, flight table, waypoints, alarms."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.control.dive_cycle import DivePlan
from stommel.control.flight_table import FlightTable
from stommel.control.laws import DriftLaw, HeadingLaw, PitchLaw

GUIDANCE_PERIOD = 10.0
"""Between two looks at waypoint and alarms [s]."""


class Laws(NamedTuple):
    """The laws of the actuators."""

    pitch: PitchLaw
    heading: HeadingLaw
    drift: DriftLaw


class Alarms(NamedTuple):
    """What ends the mission."""

    energy: float
    """Measured energy out of the battery [J]."""
    leak: bool
    """Whether the leak detectors do."""
    internal_pressure: float
    """Measured pressure in the hull [Pa]; infinite for none."""


class Orders(NamedTuple):
    """What the vehicle's software is told; SI units and radians."""

    step: float
    """Between two decisions [s]."""
    guidance_every: int
    """Decisions from one look at waypoint and alarms to the next."""
    dives: DivePlan
    laws: Laws
    table: FlightTable
    waypoints: NDArray[np.float64]
    """Latitude and longitude [rad] (n x 2)."""
    radius: float
    """Distance at which a waypoint is reached [m]."""
    lookahead: float
    """How far ahead on the line to aim [m]."""
    alarms: Alarms
    sampled: NDArray[np.float64]
    """1 for each phase of the dive in which the payload measures, else 0."""
