"""Kinds of records that a vehicle's log holds: one table, which the log's header repeats and its guide is made of."""

from dataclasses import dataclass, field

from stommel.control.dive_cycle import EVENTS, PHASES
from stommel.messages.log.layout import BYTES, TEXT
from stommel.onboard.coordination.health import CONDITIONS, SOURCES

ESSENTIAL, DETAIL, RAW = range(3)
"""Numbers of `SERIES`."""


@dataclass(frozen=True)
class Field:
    """One value of a record."""

    name: str
    format: str
    """Letter of Python's `struct`, little-endian, as `d`; `24s` for text filled up with zeros; `TEXT` or `BYTES`."""
    unit: str = ""
    meaning: str = ""
    words: tuple[str, ...] = field(default=(), repr=False)
    """What the numbers 0, 1, 2 ... stand for."""


@dataclass(frozen=True)
class RecordKind:
    """A kind of record."""

    number: int
    name: str
    series: int
    """`ESSENTIAL`, `DETAIL` or `RAW`."""
    meaning: str
    fields: tuple[Field, ...]
    urgent: bool = False
    """Whether it is brought to the disk at once."""


_T = Field("t", "d", "s", "time of the software")

READINGS = RecordKind(
    1,
    "readings",
    DETAIL,
    "what the decision was made on, to the last bit (`stommel.control.readings`)",
    (
        _T,
        Field("down_b2", "d", "", "direction down as the accelerometers feel it, to starboard"),
        Field("down_b3", "d", "", "the same through the keel"),
        Field("theta", "d", "rad", "pitch"),
        Field("psi", "d", "rad", "heading by the compass"),
        Field("depth", "d", "m", "by the pressure sensor"),
        Field("altitude", "d", "m", "height above the bottom; infinite where none is heard"),
        Field("r_px", "d", "m", "moving-mass position"),
        Field("V_b", "d", "m3", "ballast volume"),
        Field("steering", "d", "rad", "rudder, or rolling mass"),
        Field("leak", "?", "", "whether a leak detector is wet"),
        Field("internal_pressure", "d", "Pa", "of the air in the hull, absolute"),
        Field("voltage", "d", "V", "of the battery"),
        Field("current", "d", "A", "out of the battery"),
        Field("fixed", "?", "", "whether there is a new position"),
        Field("fix_time", "d", "s", "when it held"),
        Field("fix_latitude", "d", "rad", ""),
        Field("fix_longitude", "d", "rad", ""),
    ),
)
COMMANDS = RecordKind(
    2,
    "commands",
    DETAIL,
    "what the decision was (`stommel.control.commands`)",
    (
        _T,
        Field("r_px", "d", "m", "moving-mass position"),
        Field("V_b", "d", "m3", "ballast volume"),
        Field("steering", "d", "rad", "rudder, or rolling mass"),
        Field("hold_mass", "d", "m", "distance below which the mass stays"),
        Field("loads", "B", "", "groups of consumers that are on, as bits"),
        Field("sampling", "?", "", "whether the payload measures"),
        Field("radio", "?", "", "whether GPS and radio are on"),
        Field("ended", "B", "", "whether anything is left to do", ("going on", "complete", "aborted")),
    ),
)
DECISION = RecordKind(
    3,
    "decision",
    ESSENTIAL,
    "where in the dive cycle and on its way the vehicle is",
    (
        _T,
        Field("phase", "B", "", "of the dive cycle", PHASES),
        Field("since", "d", "s", "when it began"),
        Field("submerged_since", "d", "s", "when the vehicle left the surface"),
        Field("dives", "I", "", "begun"),
        Field("dives_here", "I", "", "since the last stay at the surface"),
        Field("event", "B", "", "what happened last", EVENTS),
        Field("alarm", "B", "", "what ends the mission", EVENTS),
        Field("waypoint", "I", "", "that is sought; the first is 0"),
        Field("heading_wanted", "d", "rad", ""),
    ),
)
NAVIGATION = RecordKind(
    4,
    "navigation",
    ESSENTIAL,
    "where the vehicle believes to be",
    (
        _T,
        Field("latitude", "d", "rad", ""),
        Field("longitude", "d", "rad", ""),
        Field("sigma", "f", "m", "uncertainty of the position"),
        Field("current_north", "f", "m/s", "mean current of the last dive"),
        Field("current_east", "f", "m/s", ""),
    ),
)
EVENT = RecordKind(
    5,
    "event",
    ESSENTIAL,
    "something happened: a code, and the reason in words",
    (_T, Field("code", "24s", "", "as `safety:leak`"), Field("reason", TEXT, "", "one sentence")),
    urgent=True,
)
ACTUATORS = RecordKind(
    6,
    "actuators",
    DETAIL,
    "what the motion-control node says",
    (
        _T,
        Field("V_b", "f", "m3", "ballast volume"),
        Field("r_px", "f", "m", "moving-mass position"),
        Field("steering", "f", "rad", "rudder, or rolling mass"),
        Field("limit_fore", "?", "", "forward limit switch"),
        Field("limit_aft", "?", "", "aft limit switch"),
        Field("pump_current", "f", "A", ""),
        Field("mass_current", "f", "A", ""),
        Field("steering_current", "f", "A", ""),
    ),
)
HULL = RecordKind(
    7,
    "hull",
    ESSENTIAL,
    "the inside of the hull",
    (
        _T,
        Field("pressure", "f", "Pa", "of the air, absolute"),
        Field("temperature", "f", "degC", ""),
        Field("leak_fore", "?", "", ""),
        Field("leak_aft", "?", "", ""),
        Field("leak_loop", "?", "", "whether the detectors' wires are whole"),
    ),
)
BATTERY = RecordKind(
    8,
    "battery",
    ESSENTIAL,
    "the battery",
    (
        _T,
        Field("voltage", "f", "V", ""),
        Field("current", "f", "A", "out of it"),
        Field("temperature", "f", "degC", ""),
        Field("energy_used", "d", "J", "since the start of the mission"),
    ),
)
CTD = RecordKind(
    9,
    "ctd",
    ESSENTIAL,
    "one sample of the CTD",
    (
        _T,
        Field("conductivity", "d", "S/m", ""),
        Field("temperature", "d", "degC", ""),
        Field("pressure", "d", "dbar", "of the sea"),
    ),
)
CAN_STATISTICS = RecordKind(
    10,
    "can_statistics",
    DETAIL,
    "the bus, counted from the start of the software",
    (
        _T,
        Field("frames", "I", "", "taken"),
        Field("rejected", "I", "", "with a wrong checksum or counter"),
        Field("lost", "I", "", "missing between two counters"),
        Field("errors", "I", "", "of the adapter"),
        Field("load", "f", "", "share of the bus that is used"),
    ),
)
CAN_FRAME = RecordKind(
    11,
    "can_frame",
    RAW,
    "a frame of the bus",
    (
        _T,
        Field("identifier", "H", "", ""),
        Field("sent", "?", "", "by this computer, or taken"),
        Field("data", BYTES, "", ""),
    ),
)
SERIAL = RecordKind(
    12,
    "serial",
    RAW,
    "bytes of a serial port",
    (
        _T,
        Field("port", "12s", "", "its name"),
        Field("sent", "?", "", "by this computer, or taken"),
        Field("data", BYTES, "", ""),
    ),
)
HEALTH = RecordKind(
    13,
    "health",
    ESSENTIAL,
    "a node or an instrument; counts since the software's start",
    (
        _T,
        Field("source", "B", "", "", SOURCES),
        Field("condition", "B", "", "", CONDITIONS),
        Field("age", "f", "s", "since last heard"),
        Field("heard", "I", "", "messages; bytes of the radio"),
        Field("lost", "I"),
        Field("rejected", "I"),
        Field("silences", "I"),
        Field("restarts", "I"),
    ),
)

KINDS = (
    READINGS, COMMANDS, DECISION, NAVIGATION, EVENT, ACTUATORS, HULL, BATTERY, CTD, CAN_STATISTICS, CAN_FRAME, SERIAL,
    HEALTH,
)  # fmt: skip
"""Every kind of record; numbers are never used twice."""
