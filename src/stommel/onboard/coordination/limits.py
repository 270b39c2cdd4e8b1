"""Numbers of the vehicle that safety and executive go by."""

from typing import NamedTuple


class SafetyLimits(NamedTuple):
    """Numbers of the vehicle that the failsafes and start checks hold readings against; SI units."""

    hull_rating_depth: float
    """Depth that the hull is rated for [m]."""
    submerged_depth: float
    """Deeper than this the vehicle is under water, waves or not [m]."""
    longest_submerged: float
    """Time under water after which control has failed to bring it up [s]: its own limit, and time to climb."""
    turning_time: float
    """Longest time that a sound engine takes from a dive's ballast to a climb's, and the vehicle to turn [s]."""
    least_voltage: float
    """Below it there is no more dive [V]."""
    lowest_voltage: float
    """Below it the pump soon stops [V]."""
    greatest_voltage: float
    """Above it the gauge is wrong [V]."""
    greatest_current: float
    """Out of the battery, all consumers on [A]."""
    vacuum_lost: float
    """Pressure in the hull above which its vacuum is lost [Pa]."""
    hull_flooding: float
    """Pressure in the hull above which water presses its air together [Pa]."""
    least_field: float
    """Weakest plausible magnetic field [uT]."""
    greatest_field: float
    """Strongest plausible one [uT]."""


class ActuatorLimits(NamedTuple):
    """What the actuators can do, and where they stand when the executive commands them itself; SI units, radians."""

    V_b_least: float
    """Ballast volume with all oil inside [m3]."""
    V_b_greatest: float
    """With all oil outside [m3]."""
    r_px_aft: float
    """Moving-mass position at the end of its travel that raises the nose most [m]."""
    r_px_fore: float
    """At the other end [m]."""
    r_px_nose_up: float
    """Moving-mass position for coming up [m]."""
    r_px_surface: float
    """Moving-mass position that raises the antenna [m]."""
    r_px_calling: float
    """Where an aborted vehicle that has come up to stay puts the moving mass [m]: that of `r_px_surface` where its
    antenna is in the tail, else that of `r_px_nose_up`."""
    steering: float
    """Greatest angle of rudder or rolling mass to either side [rad]."""
    hold_mass: float
    """Distance from the commanded position below which the mass's drive stays off [m]."""
