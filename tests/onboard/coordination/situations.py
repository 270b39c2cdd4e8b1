"""Situations for the tests of safety and executive: a sound vehicle, and what is changed in it."""

from math import inf
from typing import Any

from stommel.control.dive_cycle import NOTHING, SURFACE
from stommel.control.readings import Readings
from stommel.onboard.coordination.limits import ActuatorLimits, SafetyLimits
from stommel.onboard.coordination.situation import Situation

LIMITS = SafetyLimits(
    hull_rating_depth=250.0,
    submerged_depth=3.0,
    longest_submerged=20000.0,
    turning_time=120.0,
    least_voltage=21.0,
    lowest_voltage=19.0,
    greatest_voltage=30.0,
    greatest_current=20.0,
    vacuum_lost=95e3,
    hull_flooding=120e3,
    least_field=20.0,
    greatest_field=70.0,
)
ACTUATORS = ActuatorLimits(
    V_b_least=-2.5e-4,
    V_b_greatest=2.5e-4,
    r_px_aft=0.20,
    r_px_fore=0.30,
    r_px_nose_up=0.21,
    r_px_surface=0.29,
    r_px_calling=0.21,
    steering=1.0,
    hold_mass=1e-3,
)
AT_SURFACE = Readings(
    down_b2=0.0,
    down_b3=1.0,
    theta=0.0,
    psi=0.0,
    depth=0.0,
    altitude=inf,
    r_px=0.25,
    V_b=2e-4,
    steering=0.0,
    leak=False,
    internal_pressure=80e3,
    voltage=25.0,
    current=0.5,
    fixed=True,
    fix_time=0.0,
    fix_latitude=0.5,
    fix_longitude=2.1,
)
WELL = Situation(
    t=0.0,
    readings=AT_SURFACE,
    phase=SURFACE,
    event=NOTHING,
    alarm=NOTHING,
    time_submerged=0.0,
    coming_up=False,
    motion_silent=False,
    acquisition_silent=False,
    motion_refused=False,
    acquisition_refused=False,
    unknown_nodes=0,
    compass_silent=False,
    gps_silent=False,
    ctd_silent=False,
    pressure_silent=False,
    altimeter_silent=False,
    leak_silent=False,
    vacuum_silent=False,
    battery_silent=False,
    ballast_silent=False,
    mass_silent=False,
    steering_silent=False,
    pump_stuck=False,
    valve_stuck=False,
    mass_stuck=False,
    steering_stuck=False,
    over_current=False,
    limit_fault=False,
    weight_released=False,
    leak_fore=False,
    leak_aft=False,
    leak_proven=True,
    pressure_proven=True,
    vacuum_proven=True,
    battery_proven=True,
    pump_proven=True,
    mass_proven=True,
    steering_proven=True,
    field=48.0,
    gravity=1.0,
    mission_present=True,
    mission_expired=False,
    exceptions=0,
    restarts=0,
    log_writable=True,
    key_alarm=False,
)
"""Proven, at the surface, with a mission."""


def situation(t: float, **changes: Any) -> Situation:
    """Return a situation at time `t`: a sound vehicle with some fields of it or of its readings changed."""
    readings = {name: changes.pop(name) for name in tuple(changes) if name in Readings._fields}
    if "depth" in readings:
        readings.setdefault("fixed", False)
    return WELL._replace(t=t, readings=AT_SURFACE._replace(**readings), **changes)
