"""The table of failsafes: what is detected, for how long, what the vehicle does, and how it is over again.

The table is the documentation: the guide's table is made from it. What `stommel.control` decides itself is not decided
here again: such a row only looks at control's event or alarm, and another row adds what follows if that did not help.
"""

from collections.abc import Callable
from enum import Enum, IntEnum
from typing import NamedTuple

from stommel.control.dive_cycle import (
    ABORT_BATTERY,
    ABORT_DEPTH,
    ABORT_LEAK,
    ABORT_PRESSURE,
    ABORT_TIME,
    ASCENT,
    BOTTOM_AHEAD,
    DESCENT,
    SURFACE,
)
from stommel.onboard.coordination.limits import SafetyLimits
from stommel.onboard.coordination.situation import Situation
from stommel.onboard.coordination.track import Track

EXCEPTIONS_ALLOWED = 3
"""Decisions in a row that may end in an exception while the last commands hold."""


class Reaction(IntEnum):
    """What the vehicle does; each includes those before it."""

    NONE = 0
    REPORT = 1
    NO_DIVE = 2
    SURFACE = 3
    ABORT = 4
    DROP_WEIGHT = 5


REACTION_WORDS = {
    Reaction.NONE: "nothing",
    Reaction.REPORT: "told to the operator",
    Reaction.NO_DIVE: "this dive goes on to its end, no other begins",
    Reaction.SURFACE: "the dive ends, the vehicle comes up",
    Reaction.ABORT: "last reaction: greatest ballast, nose up, rudder amidships, then calling at the surface",
    Reaction.DROP_WEIGHT: "last reaction, and the drop weight goes where the vehicle has one",
}


class Cleared(Enum):
    """How an alarm is over again, once its cause is gone."""

    SELF = "by itself"
    OPERATOR = "by the operator"
    RESTART = "by a restart of the software"
    NEVER = "never at sea"


Detection = Callable[[Situation, Track, SafetyLimits], bool]


class Failsafe(NamedTuple):
    """One row of the table."""

    name: str
    words: str
    """What is detected, for the documentation."""
    detected_by: str
    """Who decides that it is so: `safety`, a node, or `control` with its event or alarm."""
    holds: Detection
    debounce: float
    """How long it must hold without a break [s]."""
    reaction: Reaction
    cleared_by: Cleared
    clear_after: float
    """How long its cause must be gone before it is over by itself [s]."""
    reason: str
    """Word for it in the CAN database's `Abort.reason`."""
    what_to_do: str
    """Words for the operator."""


R, C = Reaction, Cleared
SAFETY, MOTION, ACQUISITION = "safety", "motion node", "acquisition node"


def _is_still_sinking(event: int) -> Detection:
    return lambda now, seen, *_: now.event == event and seen.asked_up and seen.sinking


FAILSAFES = (
    # water and depth
    Failsafe(
        "leak", "a leak detector is wet", "control: abort: leak",
        lambda now, *_: now.alarm == ABORT_LEAK,
        0.0, R.NO_DIVE, C.OPERATOR, 0.0, "Leak", "recover the vehicle, find the water",
    ),
    Failsafe(
        "leak, sinking on", "wet, and the vehicle still sinks after control asked for the climb", SAFETY,
        lambda now, seen, *_: now.alarm == ABORT_LEAK and seen.asked_up and seen.sinking,
        60.0, R.ABORT, C.OPERATOR, 0.0, "Leak", "recover the vehicle, find the water",
    ),
    Failsafe(
        "leak in both bays", "the leak detectors of both bays are wet", ACQUISITION,
        lambda now, *_: now.leak_fore and now.leak_aft,
        3.0, R.ABORT, C.OPERATOR, 0.0, "Leak", "recover the vehicle at once, find the water",
    ),
    Failsafe(
        "too deep", "deeper than the mission allows", "control: abort: too deep",
        lambda now, *_: now.event == ABORT_DEPTH,
        0.0, R.REPORT, C.SELF, 0.0, "OverDepth", "look at ballast and water of the dive",
    ),
    Failsafe(
        "too deep, sinking on", "too deep, and the vehicle still sinks after control asked for the climb", SAFETY,
        _is_still_sinking(ABORT_DEPTH),
        60.0, R.ABORT, C.OPERATOR, 0.0, "OverDepth", "look at the engine's log before the next dive",
    ),
    Failsafe(
        "deeper than the hull rating", "deeper than the hull is rated for", SAFETY,
        lambda now, _seen, limits: now.readings.depth > limits.hull_rating_depth,
        3.0, R.DROP_WEIGHT, C.NEVER, 0.0, "OverDepth", "inspect the hull and its seals on land",
    ),
    Failsafe(
        "sinking on", "a climb was asked for, an inflection's time is over, and the vehicle sinks", SAFETY,
        lambda _now, seen, limits: seen.sinking and seen.asked_up_for > limits.turning_time,
        60.0, R.ABORT, C.OPERATOR, 0.0, "OverDepth", "look at the engine's log before the next dive",
    ),
    Failsafe(
        "bottom", "the bottom is within the least altitude", "control: bottom ahead",
        lambda now, *_: now.event == BOTTOM_AHEAD,
        0.0, R.REPORT, C.SELF, 0.0, "Bottom", "the water is shallower than the mission's depth",
    ),
    Failsafe(
        "bottom, sinking on", "bottom ahead, and the vehicle still sinks after control asked for the climb", SAFETY,
        _is_still_sinking(BOTTOM_AHEAD),
        60.0, R.ABORT, C.OPERATOR, 0.0, "Bottom", "look at the engine's log before the next dive",
    ),
    Failsafe(
        "no rise", "the vehicle was asked to come up, and has not risen by a metre", SAFETY,
        lambda _now, seen, limits: seen.asked_up_for > limits.turning_time and seen.not_risen,
        300.0, R.ABORT, C.OPERATOR, 0.0, "NoSurfacing", "look for what holds it: bottom, net, ice, leak, engine",
    ),
    Failsafe(
        "no rise, last resort", "the last reaction runs, and the vehicle has not risen by a metre", SAFETY,
        lambda now, seen, *_: now.coming_up and seen.not_risen,
        900.0, R.DROP_WEIGHT, C.OPERATOR, 0.0, "NoSurfacing", "look for what holds it: bottom, net, ice, leak, engine",
    ),
    Failsafe(
        "does not sink", "control dives, and the depth does not grow", SAFETY,
        lambda now, seen, *_: now.phase == DESCENT and not seen.submerged,
        900.0, R.SURFACE, C.OPERATOR, 0.0, "SilentInstrument", "look at ballast, valve and pressure sensor",
    ),
    # time
    Failsafe(
        "no surfacing", "longer under water than the mission allows", "control: abort: dive too long",
        lambda now, *_: now.event == ABORT_TIME,
        0.0, R.REPORT, C.SELF, 0.0, "NoSurfacing", "look at speed and currents of the dive",
    ),
    Failsafe(
        "no surfacing, still under water", "control's limit and the time to climb are over", SAFETY,
        lambda now, _seen, limits: now.time_submerged > limits.longest_submerged,
        10.0, R.ABORT, C.OPERATOR, 0.0, "NoSurfacing", "look for what held it down",
    ),
    Failsafe(
        "mission expired", "the mission's time is over", SAFETY,
        lambda now, *_: now.mission_expired,
        0.0, R.SURFACE, C.SELF, 0.0, "MissionExpired", "send a new mission, or recover the vehicle",
    ),
    # energy
    Failsafe(
        "low battery", "the mission's share of the energy is used", "control: abort: battery low",
        lambda now, *_: now.alarm == ABORT_BATTERY,
        0.0, R.NO_DIVE, C.OPERATOR, 0.0, "LowBattery", "recover the vehicle, charge or change the battery",
    ),
    Failsafe(
        "low voltage", "the battery's voltage is below the least for a dive", ACQUISITION,
        lambda now, _seen, limits: now.readings.voltage < limits.least_voltage,
        60.0, R.SURFACE, C.OPERATOR, 0.0, "LowBattery", "recover the vehicle, charge or change the battery",
    ),
    Failsafe(
        "voltage nearly gone", "the pump will soon not run any more", ACQUISITION,
        lambda now, _seen, limits: now.readings.voltage < limits.lowest_voltage,
        10.0, R.ABORT, C.RESTART, 0.0, "LowBattery", "recover the vehicle, charge or change the battery",
    ),
    Failsafe(
        "over-current of the battery", "more current than all consumers take", ACQUISITION,
        lambda now, _seen, limits: now.readings.current > limits.greatest_current,
        5.0, R.SURFACE, C.OPERATOR, 0.0, "OverCurrent", "look for a short circuit",
    ),
    # drives
    Failsafe(
        "over-current of a motor", "a motor took too much and was stopped", MOTION,
        lambda now, *_: now.over_current,
        5.0, R.SURFACE, C.OPERATOR, 0.0, "OverCurrent", "test the drives at the surface, then clear",
    ),
    Failsafe(
        "pump stuck", "the oil does not follow the pump", MOTION,
        lambda now, *_: now.pump_stuck,
        5.0, R.ABORT, C.OPERATOR, 0.0, "StuckActuator", "test the pump at the surface, then clear",
    ),
    Failsafe(
        "valve stuck", "the oil does not follow the valve", MOTION,
        lambda now, *_: now.valve_stuck,
        5.0, R.SURFACE, C.OPERATOR, 0.0, "StuckActuator", "test the valve at the surface, then clear",
    ),
    Failsafe(
        "moving mass stuck", "the moving mass does not follow: no command of the pitch", MOTION,
        lambda now, *_: now.mass_stuck,
        5.0, R.SURFACE, C.OPERATOR, 0.0, "StuckActuator", "test the pitch drive at the surface, then clear",
    ),
    Failsafe(
        "steering stuck", "rudder or rolling mass does not follow: no command of the heading", MOTION,
        lambda now, *_: now.steering_stuck,
        5.0, R.NO_DIVE, C.OPERATOR, 0.0, "StuckActuator", "test the steering at the surface, then clear",
    ),
    Failsafe(
        "limit switch", "a limit switch contradicts the position of the moving mass", MOTION,
        lambda now, *_: now.limit_fault,
        5.0, R.NO_DIVE, C.OPERATOR, 0.0, "StuckActuator", "test the limit switches at the surface, then clear",
    ),
    Failsafe(
        "weight released", "the drop weight is gone: the vehicle cannot sink any more", MOTION,
        lambda now, *_: now.weight_released,
        0.0, R.NO_DIVE, C.NEVER, 0.0, "Operator", "recover the vehicle, mount a new weight",
    ),
    # nodes and instruments
    Failsafe(
        "silent motion node", "under water the motion node misses its periods; it blows ballast by itself then", SAFETY,
        lambda now, seen, *_: now.motion_silent and seen.submerged,
        10.0, R.ABORT, C.OPERATOR, 0.0, "SilentNode", "look at bus and node, then clear",
    ),
    Failsafe(
        "silent acquisition node", "under water the acquisition node misses its periods: the vehicle is blind", SAFETY,
        lambda now, seen, *_: now.acquisition_silent and seen.submerged,
        10.0, R.ABORT, C.OPERATOR, 0.0, "SilentNode", "look at bus and node, then clear",
    ),
    Failsafe(
        "node of another version", "a node has another CAN database and is refused", SAFETY,
        lambda now, *_: now.motion_refused or now.acquisition_refused,
        0.0, R.NO_DIVE, C.SELF, 10.0, "SilentNode", "load the same version on all nodes",
    ),
    Failsafe(
        "unknown node", "identifiers on the bus that the database does not know", SAFETY,
        lambda now, *_: now.unknown_nodes > 0,
        0.0, R.REPORT, C.SELF, 60.0, "SilentNode", "find out who speaks; health names the identifiers",
    ),
    Failsafe(
        "silent pressure sensor", "no depth under water: the vehicle is blind", ACQUISITION,
        lambda now, seen, *_: now.pressure_silent and seen.submerged,
        10.0, R.ABORT, C.OPERATOR, 0.0, "SilentInstrument", "change the pressure sensor",
    ),
    Failsafe(
        "pressure sensor stuck", "the depth stands still in a descent or an ascent: the vehicle is blind", SAFETY,
        lambda now, seen, *_: (
            now.phase in (DESCENT, ASCENT) and seen.submerged and seen.depth_still
        ),
        180.0, R.ABORT, C.OPERATOR, 0.0, "SilentInstrument", "look at pressure sensor, ballast and bottom",
    ),
    Failsafe(
        "blind, last resort", "no depth, and no position for an hour of coming up", SAFETY,
        lambda now, seen, *_: now.pressure_silent and seen.submerged and now.coming_up,
        3600.0, R.DROP_WEIGHT, C.OPERATOR, 0.0, "SilentInstrument", "change the pressure sensor",
    ),
    Failsafe(
        "silent compass", "the compass does not answer", SAFETY,
        lambda now, *_: now.compass_silent,
        60.0, R.SURFACE, C.SELF, 300.0, "SilentInstrument", "look at compass and its cable",
    ),
    Failsafe(
        "silent GPS", "GPS says nothing at the surface", SAFETY,
        lambda now, *_: now.gps_silent and now.phase == SURFACE,
        600.0, R.NO_DIVE, C.SELF, 60.0, "SilentInstrument", "look at GPS and antenna; find the vehicle by radio",
    ),
    Failsafe(
        "silent CTD", "the payload measures and says nothing", SAFETY,
        lambda now, *_: now.ctd_silent,
        60.0, R.REPORT, C.SELF, 60.0, "SilentInstrument", "look at CTD and its pump",
    ),
    Failsafe(
        "silent altimeter", "the altimeter does not answer: a bottom would not be seen", ACQUISITION,
        lambda now, *_: now.altimeter_silent,
        60.0, R.SURFACE, C.SELF, 300.0, "SilentInstrument", "look at the altimeter, or fly a mission without it",
    ),
    Failsafe(
        "silent leak detector", "the circuit of the leak detectors is broken", ACQUISITION,
        lambda now, *_: now.leak_silent,
        10.0, R.SURFACE, C.OPERATOR, 0.0, "SilentInstrument", "repair the circuit of the leak detectors",
    ),
    Failsafe(
        "silent hull pressure", "the sensor of the pressure in the hull does not answer", ACQUISITION,
        lambda now, *_: now.vacuum_silent,
        60.0, R.NO_DIVE, C.SELF, 300.0, "SilentInstrument", "look at the sensor of the pressure in the hull",
    ),
    Failsafe(
        "silent battery gauge", "voltage and current are not measured", ACQUISITION,
        lambda now, *_: now.battery_silent,
        60.0, R.SURFACE, C.SELF, 300.0, "SilentInstrument", "look at the battery's gauge",
    ),
    Failsafe(
        "silent displacement sensor", "the volume of the oil is not measured", MOTION,
        lambda now, *_: now.ballast_silent,
        10.0, R.SURFACE, C.OPERATOR, 0.0, "SilentInstrument", "look at the displacement sensor, then clear",
    ),
    Failsafe(
        "silent mass position", "the position of the moving mass is not measured", MOTION,
        lambda now, *_: now.mass_silent,
        10.0, R.SURFACE, C.OPERATOR, 0.0, "SilentInstrument", "look at the position sensor, then clear",
    ),
    Failsafe(
        "silent steering angle", "the angle of the steering is not measured", MOTION,
        lambda now, *_: now.steering_silent,
        10.0, R.NO_DIVE, C.OPERATOR, 0.0, "SilentInstrument", "look at the angle sensor, then clear",
    ),
    # the hull
    Failsafe(
        "hull pressure of the mission", "the pressure in the hull passes the mission's limit",
        "control: abort: pressure inside the hull",
        lambda now, *_: now.alarm == ABORT_PRESSURE,
        0.0, R.NO_DIVE, C.OPERATOR, 0.0, "VacuumLoss", "recover the vehicle, look at seals and vacuum",
    ),
    Failsafe(
        "vacuum loss", "the vacuum in the hull is lost", ACQUISITION,
        lambda now, _seen, limits: now.readings.internal_pressure > limits.vacuum_lost,
        10.0, R.SURFACE, C.OPERATOR, 0.0, "VacuumLoss", "recover the vehicle, look at seals and vacuum",
    ),
    Failsafe(
        "hull flooding", "water presses the air in the hull together", ACQUISITION,
        lambda now, _seen, limits: now.readings.internal_pressure > limits.hull_flooding,
        3.0, R.ABORT, C.OPERATOR, 0.0, "VacuumLoss", "recover the vehicle at once",
    ),
    # the software
    Failsafe(
        "software exception", "a decision ended in an exception; the last commands hold", SAFETY,
        lambda now, *_: now.exceptions > 0,
        0.0, R.REPORT, C.SELF, 600.0, "SoftwareException", "send the log to the developers",
    ),
    Failsafe(
        "software exceptions in a row", f"more than {EXCEPTIONS_ALLOWED} decisions in a row ended in an exception",
        SAFETY,
        lambda now, *_: now.exceptions > EXCEPTIONS_ALLOWED,
        0.0, R.ABORT, C.OPERATOR, 0.0, "SoftwareException", "recover the vehicle, send the log to the developers",
    ),
    Failsafe(
        "node restarted", "a node has started anew", SAFETY,
        lambda _now, seen, *_: seen.node_restarted,
        0.0, R.REPORT, C.SELF, 600.0, "SilentNode", "look for brown-outs in the log",
    ),
    Failsafe(
        "log not written", "a record did not reach the disk", SAFETY,
        lambda now, *_: not now.log_writable,
        60.0, R.REPORT, C.SELF, 60.0, "SoftwareException", "make room on the disk, or change it",
    ),
    Failsafe(
        "radio key", "nothing by radio is believed, or not safely: key or time stamps are missing or damaged", "link",
        lambda now, *_: now.key_alarm,
        0.0, R.REPORT, C.SELF, 0.0, "Unproven", "put the key in place (stommel link key), start the software anew",
    ),
    Failsafe(
        "unproven safety input", "a start check has not passed", "start checks",
        lambda _now, seen, *_: bool(seen.unproven),
        0.0, R.NO_DIVE, C.SELF, 0.0, "Unproven", "do what the start check's row says",
    ),
)  # fmt: skip
"""Every failsafe of the vehicle's software."""
