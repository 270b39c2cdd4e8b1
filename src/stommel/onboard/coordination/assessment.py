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
    key_alarm: bool
    drives_proven: tuple[bool, bool, bool]
    """Whether oil, moving mass and steering followed in the self-test."""
    has_altimeter: bool


class _Silent(NamedTuple):
    """Which sensors say nothing: theirs or their node's messages do not come, or say that nothing was measured."""

    compass: bool
    pressure: bool
    altimeter: bool
    leak: bool
    vacuum: bool
    battery: bool
    ballast: bool
    mass: bool
    steering: bool


def situation_of(seen: Perception, inside: Inside, readings: Readings, t: float) -> Situation:
    """Return the situation at a time [s]; readings of silent sensors become no numbers."""
    says, watch, silent = seen.says, seen.watch, _silent_at(t, seen, inside.has_altimeter)
    valve_stuck = watch.reports(MOTION, "ValveStuck")
    oil, mass, steering = inside.drives_proven
    return Situation(
        t=t,
        readings=_without_silent(readings, silent),
        phase=inside.phase,
        event=inside.event,
        alarm=inside.alarm,
        time_submerged=_time_submerged(inside, t),
        coming_up=inside.coming_up,
        motion_silent=watch.is_silent(MOTION, t),
        acquisition_silent=watch.is_silent(ACQUISITION, t),
        motion_refused=watch.is_refused(MOTION),
        acquisition_refused=watch.is_refused(ACQUISITION),
        unknown_nodes=len(watch.strangers),
        compass_silent=silent.compass,
        gps_silent=inside.gps_silent,
        ctd_silent=inside.ctd_silent,
        pressure_silent=silent.pressure,
        altimeter_silent=silent.altimeter,
        leak_silent=silent.leak,
        vacuum_silent=silent.vacuum,
        battery_silent=silent.battery,
        ballast_silent=silent.ballast,
        mass_silent=silent.mass,
        steering_silent=silent.steering,
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
        field=math.nan if silent.compass else seen.attitude.field,
        gravity=math.nan if silent.compass else seen.attitude.gravity,
        mission_present=inside.mission_present,
        mission_expired=inside.mission_expired,
        exceptions=inside.exceptions,
        restarts=watch.restarts_seen,
        log_writable=inside.log_writable,
        key_alarm=inside.key_alarm,
    )


def _silent_at(t: float, seen: Perception, has_altimeter: bool) -> _Silent:
    says = seen.says
    depth, hull = seen.is_silent("Depth", t), seen.is_silent("Hull", t)
    motion, battery = seen.is_silent("MotionStatus", t), seen.is_silent("Battery", t)
    return _Silent(
        compass=t - max(seen.attitude.at, seen.began) > seen.compass_patience,
        pressure=depth or not says("Depth", "pressure_measured"),
        altimeter=has_altimeter and (depth or not says("Depth", "altimeter_answers")),
        leak=hull or not says("Hull", "leak_measured"),
        vacuum=hull or not says("Hull", "pressure_measured"),
        battery=battery or not says("Battery", "battery_measured"),
        ballast=motion or not says("MotionStatus", "ballast_measured"),
        mass=motion or not says("MotionStatus", "mass_measured"),
        steering=motion or not says("MotionStatus", "steering_measured"),
    )


def _time_submerged(inside: Inside, t: float) -> float:
    """Since the vehicle left the surface [s]; 0 there, and before a mission."""
    down = inside.phase != SURFACE and not math.isnan(inside.submerged_since)
    return t - inside.submerged_since if down else 0.0


def _without_silent(readings: Readings, silent: _Silent) -> Readings:
    if not (silent.pressure or silent.vacuum or silent.battery or silent.compass):
        return readings
    nan = math.nan
    return readings._replace(
        depth=nan if silent.pressure else readings.depth,
        internal_pressure=nan if silent.vacuum else readings.internal_pressure,
        voltage=nan if silent.battery else readings.voltage,
        current=nan if silent.battery else readings.current,
        theta=nan if silent.compass else readings.theta,
        psi=nan if silent.compass else readings.psi,
    )
