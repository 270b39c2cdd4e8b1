"""From what is heard to the situation that safety and executive look at: a sensor that is silent says nothing."""

import math
from typing import NamedTuple

from stommel.control.dive_cycle import SURFACE
from stommel.control.readings import Readings
from stommel.messages.database import ACQUISITION, MOTION
from stommel.onboard.coordination.perception import Perception
from stommel.onboard.coordination.situation import Situation


class Inside(NamedTuple):
    """What the software knows of itself."""

    phase: int
    event: int
    alarm: int
    submerged_since: float
    """Time at which the vehicle left the surface [s]; not a number before a mission."""
    coming_up: bool
    """Whether the executive brought the vehicle up at the last decision."""
    gps_silent: bool
    ctd_silent: bool
    mission_present: bool
    mission_expired: bool
    exceptions: int
    log_writable: bool
    drives_proven: tuple[bool, bool, bool]
    """Whether oil, moving mass and steering followed in the self-test."""
    has_altimeter: bool


def situation_of(seen: Perception, inside: Inside, readings: Readings, t: float) -> Situation:
    """Return the situation at a time [s]; readings of silent sensors become no numbers."""
    says, watch = seen.says, seen.watch
    depth_late, hull_late = seen.is_silent("Depth", t), seen.is_silent("Hull", t)
    motion_late, battery_late = seen.is_silent("MotionStatus", t), seen.is_silent("Battery", t)
    compass_silent = t - max(seen.attitude.at, seen.began) > seen.compass_patience
    pressure_silent = depth_late or not says("Depth", "pressure_measured")
    vacuum_silent = hull_late or not says("Hull", "pressure_measured")
    battery_silent = battery_late or not says("Battery", "battery_measured")
    valve_stuck = watch.reports(MOTION, "ValveStuck")
    down = inside.phase != SURFACE and inside.submerged_since == inside.submerged_since
    oil, mass, steering = inside.drives_proven
    return Situation(
        t=t,
        readings=_without_silent(readings, pressure_silent, vacuum_silent, battery_silent, compass_silent),
        phase=inside.phase,
        event=inside.event,
        alarm=inside.alarm,
        time_submerged=t - inside.submerged_since if down else 0.0,
        coming_up=inside.coming_up,
        motion_silent=watch.is_silent(MOTION, t),
        acquisition_silent=watch.is_silent(ACQUISITION, t),
        motion_refused=watch.is_refused(MOTION),
        acquisition_refused=watch.is_refused(ACQUISITION),
        unknown_nodes=len(watch.strangers),
        compass_silent=compass_silent,
        gps_silent=inside.gps_silent,
        ctd_silent=inside.ctd_silent,
        pressure_silent=pressure_silent,
        altimeter_silent=inside.has_altimeter and (depth_late or not says("Depth", "altimeter_answers")),
        leak_silent=hull_late or not says("Hull", "leak_measured"),
        vacuum_silent=vacuum_silent,
        battery_silent=battery_silent,
        ballast_silent=motion_late or not says("MotionStatus", "ballast_measured"),
        mass_silent=motion_late or not says("MotionStatus", "mass_measured"),
        steering_silent=motion_late or not says("MotionStatus", "steering_measured"),
        pump_stuck=watch.reports(MOTION, "PumpStuck") or (says("MotionDrives", "engine_stuck") and not valve_stuck),
        valve_stuck=valve_stuck,
        mass_stuck=says("MotionDrives", "mass_stuck"),
        steering_stuck=says("MotionDrives", "steering_stuck"),
        over_current=says("MotionDrives", "over_current"),
        limit_fault=says("MotionDrives", "limit_fault"),
        weight_released=says("MotionDrives", "weight_released"),
        leak_fore=says("Hull", "leak_fore"),
        leak_aft=says("Hull", "leak_aft"),
        leak_proven=says("Hull", "leak_proven"),
        pressure_proven=says("Depth", "pressure_proven"),
        vacuum_proven=says("Hull", "vacuum_proven"),
        battery_proven=says("Battery", "voltage_proven"),
        pump_proven=oil,
        mass_proven=mass,
        steering_proven=steering,
        field=math.nan if compass_silent else seen.attitude.field,
        gravity=math.nan if compass_silent else seen.attitude.gravity,
        mission_present=inside.mission_present,
        mission_expired=inside.mission_expired,
        exceptions=inside.exceptions,
        restarts=watch.restarts_seen,
        log_writable=inside.log_writable,
    )


def _without_silent(readings: Readings, pressure: bool, vacuum: bool, battery: bool, compass: bool) -> Readings:
    if not (pressure or vacuum or battery or compass):
        return readings
    nan = math.nan
    return readings._replace(
        depth=nan if pressure else readings.depth,
        internal_pressure=nan if vacuum else readings.internal_pressure,
        voltage=nan if battery else readings.voltage,
        current=nan if battery else readings.current,
        theta=nan if compass else readings.theta,
        psi=nan if compass else readings.psi,
    )
