"""Control laws of the actuators: feedback where the flight differs from the flight table (compiled).

Each has a dead band: a battery is not spent on the last tenth of a degree.
"""

import math
from typing import NamedTuple

from stommel.compilation import compiled

ENDABLE = 0.5
"""Part of the turn rate at which full steering just holds an unstable spiral, up to which the vehicle is told to turn.
Beyond that rate nothing stops the spiral but the end of the dive."""


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
    """Feedback on heading by the rudder, or by the rolling mass."""

    response: float
    """Time in which a heading error is turned away [s]."""
    dead_band: float
    """Change of command below which the actuator stays [rad]."""
    limit: float
    """Largest command to either side [rad]."""


class DriftLaw(NamedTuple):
    """Feedback on depth by the ballast, while the vehicle hangs in the water."""

    gain: float
    """Ballast volume for each metre per second by which it sinks too fast, once a period [m3 s/m]."""
    return_time: float
    """Time in which it should return to its depth [s]."""
    fastest: float
    """Vertical speed of the return, at most [m/s]."""
    dead_band: float
    """Distance from the depth that is left alone [m]."""
    period: float
    """Time between corrections [s]."""


@compiled
def pitch_correction(law: PitchLaw, correction: float, theta_wanted: float, theta: float) -> float:
    """Next correction of the moving-mass position [m]: forward pitches down."""
    error = theta_wanted - theta
    if abs(error) < law.dead_band:
        return correction
    return correction - law.gain * error


@compiled
def drift_correction(law: DriftLaw, correction: float, too_deep: float, sinking: float) -> float:
    """Next correction of the ballast volume [m3] at a distance below the wanted depth [m] and a vertical speed [m/s].

    Within the dead band nothing is done unless the vehicle leaves it faster than it should return.
    """
    wanted = min(law.fastest, max(-law.fastest, -too_deep / law.return_time))
    if abs(too_deep) < law.dead_band and abs(sinking) < law.dead_band / law.return_time:
        return correction
    return correction + law.gain * (sinking - wanted)


@compiled
def steering_gains(response: float, pole: float) -> tuple[float, float]:
    """Wanted turn acceleration per heading error [1/s2] and per turn rate [1/s] for a response time [s].

    Divided by the flight's drive they are K and D of `steering_command`.
    """
    omega = 1.0 / response
    damping = max(0.0, 2.0 * omega + pole)
    return 0.5 * omega * (damping - pole), damping


@compiled
def steering_command(
    law: HeadingLaw, previous: float, error: float, rate: float, pole: float, drive: float, way: float
) -> float:
    """Next command of rudder or rolling mass [rad]; kept while it would change too little.

    The turn answers as r' = pole r + drive delta (`stommel.control.flight_table`). With delta = K error - D r its
    characteristic equation is s^2 + (drive D - pole) s + drive K = 0: D brings the damping to that of a critical answer
    within the response time, where the flight has less of its own, and K follows. The drive's sign is taken as it is:
    a climb may turn the other way than a dive. Where the pole is positive the wanted turn rate is limited to what the
    steering can end again.

    Parameters
    ----------
    error
        Wanted less measured heading, in (-pi, pi] [rad].
    rate
        Measured turn rate [rad/s].
    pole, drive
        Of the flight, [1/s] and [1/s2].
    way
        Speed over that of the flight, at most 1: a vehicle that gathers way steers with the square of it.
    """
    stiffness, damping = steering_gains(law.response, pole)
    towards = stiffness * error
    if pole > 0.0:
        fastest = ENDABLE * abs(drive) * way * way * law.limit / pole
        # it settles where r' = pole r + towards - damping r is zero
        most = (damping - pole) * fastest
        towards = min(most, max(-most, towards))
    demand = towards - damping * rate
    # a flight that hardly answers gets the limit, not a division by nothing
    command = demand / drive if abs(drive) * law.limit > abs(demand) else math.copysign(law.limit, demand * drive)
    if abs(command - previous) < law.dead_band:
        return previous
    return command
