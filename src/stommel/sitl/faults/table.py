"""The table of faults: everything that can be broken on purpose. The guide's table is made from it."""

from typing import NamedTuple

BUS, SENSOR, SERIAL, MACHINERY, SUPPLY, SOFTWARE, HULL, RADIO = (
    "CAN bus", "sensor", "serial port", "machinery", "supply", "software", "hull", "radio",
)  # fmt: skip
"""Where a fault acts."""

COORDINATOR, MOTION, ACQUISITION = "coordinator", "motion", "acquisition"
COMPUTERS = (COORDINATOR, MOTION, ACQUISITION)
COMPASS, GPS, CTD = "compass", "gps", "ctd"
PORTS = (COMPASS, GPS, CTD)
LEAK_DETECTOR = "leak_detector"
ALL = "all"
MOST = 1e6
"""Greatest bias or noise of a sensor, in its unit: far beyond each, and all that is made of it stays a number."""


class Sensor(NamedTuple):
    """A sensor that can be broken."""

    unit: str
    """Of biases and noise; empty where it says yes or no."""
    bias: float
    """Greatest bias that a campaign draws."""
    noise: float
    """Greatest standard deviation that a campaign draws."""
    words: str


SENSORS = {
    "pressure": Sensor("m", 5.0, 2.0, "depth by the pressure sensor"),
    "altimeter": Sensor("m", 20.0, 10.0, "height above the bottom"),
    COMPASS: Sensor("deg", 90.0, 30.0, "heading; stuck and silent also its pitch and roll"),
    GPS: Sensor("m", 1000.0, 300.0, "position, to the north"),
    LEAK_DETECTOR: Sensor("", 0.0, 0.0, "leak detector and the loop through its test resistor"),
    "vacuum": Sensor("Pa", 2e4, 5e3, "pressure of the air in the hull"),
    "voltage": Sensor("V", 4.0, 2.0, "voltage of the battery"),
    "current": Sensor("A", 2.0, 1.0, "current out of the battery"),
    "displacement": Sensor("ml", 60.0, 20.0, "volume of the oil outside"),
    "mass_position": Sensor("mm", 60.0, 10.0, "position of the moving mass"),
    "steering_angle": Sensor("deg", 20.0, 5.0, "angle of rudder or rolling mass"),
    CTD: Sensor("dbar", 5.0, 2.0, "pressure of the CTD's sample; stuck and silent all of it"),
}
"""Sensors that can be broken, by name."""

ANALOG = tuple(name for name in SENSORS if name != LEAK_DETECTOR)
"""Sensors that give a number."""
DRIVES = ("pump", "mass", "steering")
"""Drives whose current is measured."""
FORE, AFT = "fore", "aft"
SWITCHES = (FORE, AFT)
"""Limit switches of the moving mass."""


class FaultKind(NamedTuple):
    """One row of the table."""

    name: str
    where: str
    """`BUS` to `RADIO`."""
    targets: tuple[str, ...]
    """What of it can be broken; empty: there is only one."""
    unit: str
    """Of its value; empty for a share."""
    low: float
    """Least value."""
    high: float
    """Greatest value."""
    default: float
    """Value of a fault whose file gives none; not used by kinds without a value, whose `low` is `high`."""
    drawn: tuple[float, float]
    """Values that a campaign draws; of kinds that are none of `DRAWN`, values that are worth a trial."""
    survivable: bool
    """Whether a vehicle without a drop weight is sure to come up when nothing else is broken, with any drawn value."""
    words: str

    @property
    def has_value(self) -> bool:
        """Whether its value tells anything."""
        return self.low < self.high


_NONE = (0.0, 0.0, 0.0, (0.0, 0.0))
_SHARE = (0.0, 1.0)

KINDS = (
    FaultKind("frame_bits_flipped", BUS, (ALL, *COMPUTERS), "", *_SHARE, 0.01, (0.001, 0.3), True,
        "one to three bits of a frame of this sender are flipped, with this probability"),
    FaultKind("frames_lost", BUS, (ALL, *COMPUTERS), "", *_SHARE, 0.1, (0.01, 0.5), True,
        "a frame of this sender is lost, with this probability"),
    FaultKind("frames_late", BUS, (ALL, *COMPUTERS), "", *_SHARE, 0.1, (0.01, 0.5), True,
        "a frame of this sender comes one step late, with this probability"),
    FaultKind("frames_repeated", BUS, (ALL, *COMPUTERS), "", *_SHARE, 0.1, (0.01, 0.5), True,
        "a frame of this sender comes twice, with this probability"),
    FaultKind("bus_off", BUS, COMPUTERS, "", *_NONE, True,
        "its controller is off the bus: it neither speaks nor hears"),
    FaultKind("stranger", BUS, (), "1/s", 1.0, 100.0, 5.0, (1.0, 50.0), True,
        "so many frames a second of identifiers that the database does not know"),
    FaultKind("wrong_database", BUS, COMPUTERS, "", *_NONE, True,
        "it says that it has another CAN database"),
    FaultKind("sensor_stuck", SENSOR, tuple(SENSORS), "", *_NONE, False,
        "it says for ever what it said as the fault began"),
    FaultKind("sensor_biased", SENSOR, ANALOG, "of the sensor", -MOST, MOST, 1.0, (-1.0, 1.0), False,
        "it says so much more; a campaign draws a share of the greatest bias of the table of sensors"),
    FaultKind("sensor_noisy", SENSOR, ANALOG, "of the sensor", 0.0, MOST, 1.0, (0.1, 1.0), True,
        "normal noise of this standard deviation; a campaign draws a share as for the bias"),
    FaultKind("sensor_silent", SENSOR, tuple(SENSORS), "", *_NONE, True,
        "it does not answer"),
    FaultKind("gps_jump", SENSOR, (), "km", -1000.0, 1000.0, 10.0, (-100.0, 100.0), True,
        "positions jump to the north and to the east by this"),
    FaultKind("bytes_garbled", SERIAL, PORTS, "", *_SHARE, 0.01, (0.001, 0.5), True,
        "a byte from the instrument is another, with this probability"),
    FaultKind("bytes_lost", SERIAL, PORTS, "", *_SHARE, 0.01, (0.001, 0.5), True,
        "a byte from the instrument is lost, with this probability"),
    FaultKind("pump_dead", MACHINERY, (), "", *_NONE, False,
        "the pump turns and moves no oil"),
    FaultKind("pump_weak", MACHINERY, (), "", *_SHARE, 0.5, (0.1, 0.9), True,
        "share of its flow that the pump still has"),
    FaultKind("oil_creeps", MACHINERY, (), "ml/min", 0.0, 1000.0, 5.0, (0.5, 20.0), True,
        "oil that runs back into the hull past pump and valve"),
    FaultKind("valve_stuck_open", MACHINERY, (), "", *_SHARE, 1.0, (0.05, 1.0), False,
        "share of the time for which the valve is open, whatever it is told"),
    FaultKind("valve_stuck_shut", MACHINERY, (), "", *_NONE, True,
        "the valve does not open"),
    FaultKind("limit_switch_broken", MACHINERY, (), "", *_NONE, True,
        "the limit switches are never pressed, and the mass runs on to its mechanical stop"),
    FaultKind("limit_switch_pressed", MACHINERY, SWITCHES, "", *_NONE, True,
        "this limit switch is always pressed"),
    FaultKind("mass_jammed", MACHINERY, (), "", *_SHARE, 0.0, (0.0, 0.5), True,
        "share of its speed that the pitch drive still has"),
    FaultKind("steering_jammed", MACHINERY, (), "", *_SHARE, 0.0, (0.0, 0.5), True,
        "share of its speed that the steering still has"),
    FaultKind("brown_out", SUPPLY, COMPUTERS, "", *_SHARE, 1.0, _SHARE, False,
        "it is without power from the middle of a step on, in which it still said this share of its frames; then it"
        " starts anew"),
    FaultKind("supply_drop", SUPPLY, (), "V", 0.0, 60.0, 20.0, (5.0, 30.0), False,
        "voltage of the supply; below 15 V all three computers are without power, and start anew after it"),
    FaultKind("battery_run_down", SUPPLY, (), "", *_SHARE, 0.1, (0.02, 0.3), True,
        "share of the usable energy that the battery has left"),
    FaultKind("current_spike", SUPPLY, DRIVES, "A", 0.0, 100.0, 15.0, (1.0, 40.0), True,
        "current that the sensor of this drive shows on top, whether its motor runs or not"),
    FaultKind("decision_exception", SOFTWARE, (), "", *_SHARE, 1.0, (0.01, 1.0), True,
        "the decision ends in an exception, with this probability"),
    FaultKind("disk_full", SOFTWARE, (), "", *_NONE, True,
        "the disk of the log takes nothing"),
    FaultKind("clock_jump", SOFTWARE, (), "s", -1e6, 1e6, 3600.0, (-7200.0, 7200.0), True,
        "the coordinator's clock is wrong by this"),
    FaultKind("early_expiry", SOFTWARE, (), "", *_NONE, True,
        "the mission's time is over as the fault begins"),
    FaultKind("hull_leak", HULL, (), "ml/min", 0.0, 1e5, 20.0, (0.5, 200.0), False,
        "water runs into the hull"),
    FaultKind("radio_dead", RADIO, (), "", *_NONE, True,
        "the radio neither sends nor hears"),
    FaultKind("radio_packets_lost", RADIO, (), "", *_SHARE, 0.5, (0.1, 0.9), True,
        "at least this share of the radio's packets is lost, each way"),
)  # fmt: skip
"""Every kind of fault."""

DRAWN = tuple(kind for kind in KINDS if kind.where != RADIO)
"""Kinds that a campaign draws from. Nobody is ashore in a campaign, so that the radio breaks nothing there; and with
more kinds the seeds of all campaigns so far would mean other faults."""

BY_NAME = {kind.name: kind for kind in KINDS}

BROWN_OUT_VOLTAGE = 15.0
"""Supply below which the computers are without power [V]; an assumption."""
