"""Control laws of the actuators: feedback where the flight differs from the flight table (compiled).

Each has a dead band: a battery is not spent on the last tenth of a degree.
"""

import math
from typing import NamedTuple

from stommel.dynamics.compilation import compiled, inlined


class PitchLaw(NamedTuple):
    """Feedback on pitch by the moving mass."""

    gain: float
    """Metres of moving mass per radian of pitch error, integrated once a period [m/rad]."""
    dead_band: float
    """Error below which the mass stays [rad]."""
    period: float
    """Time between corrections [s]; the flight must settle in between."""
    tolerance: float
    """Distance from the commanded position below which the drive stays off [m]."""


class HeadingLaw(NamedTuple):
    """Proportional and derivative law on heading by the rudder, or by the rolling mass."""

    gain: float
    """Radians of actuator per radian of heading error."""
    damping: float
    """Radians of actuator per radian per second of heading rate [s]."""
    dead_band: float
    """Change of command below which the actuator stays [rad]."""
    limit: float
    """Largest command to either side [rad]."""


@inlined
def wrapped(angle: float) -> float:
    """The angle in (-pi, pi]."""
    return math.atan2(math.sin(angle), math.cos(angle))


@compiled
def pitch_correction(law: PitchLaw, correction: float, theta_wanted: float, theta: float) -> float:
    """Next correction of the moving-mass position [m]: forward pitches down."""
    error = theta_wanted - theta
    if abs(error) < law.dead_band:
        return correction
    return correction - law.gain * error


@compiled
def steering_command(law: HeadingLaw, previous: float, heading_wanted: float, heading: float, rate: float) -> float:
    """Next command of rudder or roll mass [rad]; positive turns to starboard, kept while it would change too little."""
    command = law.gain * wrapped(heading_wanted - heading) - law.damping * rate
    command = min(law.limit, max(-law.limit, command))
    if abs(command - previous) < law.dead_band:
        return previous
    return command
