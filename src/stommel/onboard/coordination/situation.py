"""What safety and executive look at in one decision, and what an operator asks: plain records, no behaviour."""

from typing import NamedTuple

from stommel.control.readings import Readings


class Situation(NamedTuple):
    """Everything that is known at one decision; SI units and radians.

    No field has a default: what the software forgets to tell must not read as "all is well". A reading that an
    instrument does not give is not a number in `readings`, and its `silent` field is set.
    """

    t: float
    """Monotonic time of the vehicle [s]."""
    readings: Readings

    # what the decision of `stommel.control` said last
    phase: int
    """Of the dive cycle, `SURFACE` to `DRIFT` of `stommel.control.dive_cycle`; `SURFACE` where nothing has decided."""
    event: int
    """What happened last in the dive cycle, one of its `EVENTS`."""
    alarm: int
    """Alarm that ends the mission, one of its `MISSION_ENDS`, or `NOTHING`."""
    time_submerged: float
    """Since the vehicle left the surface [s]; 0 at the surface."""
    coming_up: bool
    """Whether the executive brought the vehicle up at the last decision."""

    # nodes of the CAN bus
    motion_silent: bool
    acquisition_silent: bool
    motion_refused: bool
    """Whether the motion node is of another version of the CAN database."""
    acquisition_refused: bool
    unknown_nodes: int
    """Identifiers on the bus that the database does not know."""

    # instruments that do not answer
    compass_silent: bool
    gps_silent: bool
    """Whether GPS is switched on and says nothing; waiting for a position is not silence."""
    ctd_silent: bool
    """Whether the payload measures and says nothing."""
    pressure_silent: bool
    """The sensor of the depth, or the node that reads it."""
    altimeter_silent: bool
    """False where the vehicle has none."""
    leak_silent: bool
    """Whether the circuit of the leak detectors is broken."""
    vacuum_silent: bool
    """The sensor of the pressure in the hull."""
    battery_silent: bool
    """The gauge of voltage and current."""
    ballast_silent: bool
    """The displacement sensor of the oil."""
    mass_silent: bool
    """The position sensor of the moving mass."""
    steering_silent: bool
    """The angle sensor of the rudder or rolling mass."""

    # what the motion node says of its drives
    pump_stuck: bool
    """Whether the oil does not follow the pump; also where the node does not say whether pump or valve is stuck."""
    valve_stuck: bool
    """Whether the oil does not follow the valve."""
    mass_stuck: bool
    steering_stuck: bool
    over_current: bool
    """Whether a motor took too much and was stopped."""
    limit_fault: bool
    """Whether the limit switches contradict the position of the moving mass."""
    weight_released: bool
    """Whether the drop weight was told to go."""

    # leak detectors, bay by bay
    leak_fore: bool
    leak_aft: bool

    # what has proved itself
    leak_proven: bool
    pressure_proven: bool
    vacuum_proven: bool
    battery_proven: bool
    pump_proven: bool
    """Whether the oil followed in the motion node's self-test."""
    mass_proven: bool
    steering_proven: bool
    field: float
    """Strength of the magnetic field by the compass [uT]; not a number where it does not answer."""
    gravity: float
    """Strength of the acceleration by the compass, in units of standard gravity; not a number likewise."""

    # the software itself
    mission_present: bool
    """Whether there is a mission that has been validated against this vehicle."""
    mission_expired: bool
    """Whether its time is over."""
    exceptions: int
    """Decisions in a row that ended in an exception; 0 after one that did not."""
    restarts: int
    """How often the nodes have restarted since the coordinator started."""
    log_writable: bool
    """Whether the last record of the log is on disk."""
    key_alarm: bool
    """Whether nothing that comes by radio is believed, or not safely: its key or its time stamps are amiss."""


class OperatorRequests(NamedTuple):
    """What an operator asks for, each for one decision."""

    start: bool = False
    """Fly the mission."""
    hold: bool = False
    """Stay at the surface from the next surfacing on."""
    surface: bool = False
    """End this dive, and come up."""
    abort: bool = False
    """Last reaction."""
    clear: bool = False
    """Alarms whose cause is gone are over, and an abort with them."""
    check: bool = False
    """Do the start checks again."""


NO_REQUESTS = OperatorRequests()
