"""The tables of a vehicle's configuration, each key with its unit and its range.

What the tables must be to each other is with the whole file (`configuration_file`).
"""

from pathlib import PureWindowsPath
from typing import Annotated, Literal, Self

from pydantic import AfterValidator, Field, model_validator
from pydantic_core import PydanticCustomError

from stommel.errors import one_line
from stommel.files.fields import Table
from stommel.files.kinds import OWN_WORDS, Flag
from stommel.files.ranges import Hours, Position, Voltage, between
from stommel.files.sentences import PRINTABLE
from stommel.onboard.coordination.config.by_phase import Decisions, PhaseName, Samples
from stommel.onboard.nodes.acquisition_settings import AcquisitionSettings
from stommel.onboard.nodes.motion_settings import MotionSettings
from stommel.onboard.nodes.node_settings import objection_to


def _within(name: str) -> str:
    """Refuse a folder that lies elsewhere, by the rules of any system."""
    path = PureWindowsPath(name)
    if path.anchor or ".." in path.parts:
        raise PydanticCustomError(OWN_WORDS, "must be a folder beside this file, no path from / on and none with ..")
    return name


FileName = Annotated[str, Field(min_length=1, max_length=300, pattern=PRINTABLE)]
FolderName = Annotated[FileName, AfterValidator(_within)]
PortName = Annotated[str, Field(min_length=1, max_length=200, pattern=PRINTABLE)]
Baud = Literal[1200, 2400, 4800, 9600, 19_200, 38_400, 57_600, 115_200, 230_400, 460_800, 921_600]
FieldStrength = Annotated[float, between(1, 1000)]
AirPressure = Annotated[float, between(0.1, 1000)]


class Positions(Table):
    """Where the moving mass stands when the software brings the vehicle up, and what else is fitted."""

    nose_up_mm: Position
    """Of the moving mass, for coming up."""
    surface_mm: Position
    """Of the moving mass, which raises the antenna."""
    calling_mm: Position
    """Of the moving mass when an aborted vehicle lies at the surface and calls."""
    tolerance_mm: Annotated[float, between(0.01, 50)] = 0.5
    """Distance from the commanded position below which the mass's drive stays off."""
    drop_weight: Flag = False
    """Whether there is a drop weight, and its release."""
    altimeter: Flag = True
    """Whether there is an altimeter."""


class CanPort(Table):
    """The bus to the nodes."""

    interface: Literal["socketcan", "slcan", "udp_multicast", "virtual"] = "socketcan"
    """Kind of the adapter."""
    channel: Annotated[str, Field(max_length=200)] = ""
    """Name of the adapter, port or address; the usual one of its kind if left out."""
    bitrate: Literal[10_000, 20_000, 50_000, 100_000, 125_000, 250_000, 500_000, 750_000, 1_000_000] | None = None
    """Of `slcan` only; that of `socketcan` is set in the operating system."""


class CompassPort(Table):
    """The compass: its serial port, its calibration, and how its heading is held while something disturbs it."""

    port: PortName
    """Serial port, as the operating system names it."""
    baud: Baud = 38_400
    """Bits per second."""
    interval_s: Annotated[float, between(0.1, 3)] = 1.0
    """Between two readings; after 3.5 s without one the compass counts as silent."""
    calibration: FileName | None = None
    """File of `stommel vehicle calibrate-compass`, beside this one. Without it the field is taken as it is, and the
    heading is held while an actuator runs."""
    declination_deg: Annotated[float, between(-180, 180)] = 0.0
    """From magnetic to true north, east positive."""
    hold_s: Annotated[float, between(0, 600)] = 20.0
    """For how long a heading is held while something runs whose field is not known."""
    settle_s: Annotated[float, between(0, 60)] = 0.0
    """For how long it is held after that."""


class GnssPort(Table):
    """The receiver of GPS."""

    port: PortName
    """Serial port, as the operating system names it."""
    baud: Baud = 9600
    """Bits per second."""
    format: Literal["novatel_binary", "novatel_ascii", "nmea"] = "novatel_binary"
    """What the receiver is told to send."""
    receiver_port: Annotated[str, Field(pattern=r"^[A-Za-z]\w*$", max_length=20)] = "COM1"
    """Port of the receiver at which the vehicle is."""
    interval_s: Annotated[float, between(0.05, 2)] = 1.0
    """Between two positions; one that is older than 2 s is not believed."""


class RadioPort(Table):
    """The radio, and who is believed over it."""

    port: PortName
    """Serial port, as the operating system names it."""
    baud: Baud = 57_600
    """Bits per second."""
    key: FileName = "radio.key"
    """File of the vehicle's key (`stommel link key new`), beside this one; only its owner may read it. Without a sound
    one nothing is believed but on the bench."""
    unsigned: Flag = False
    """Whether whoever is heard may command, without a key: for trials. The shore is told."""
    half_duplex: Flag = True
    """Whether the radios take turns."""


class BenchPort(Table):
    """A serial port at which a person is who may open the hull: whoever speaks there is believed, key or not."""

    port: PortName | None = None
    """As the operating system names it; it need not be there."""
    baud: Baud = 115_200
    """Bits per second."""


_DISCHARGED = 0.25
"""Share of a battery's greatest voltage below which it is no battery."""


class Safety(Table):
    """Numbers that the failsafes and start checks hold readings against."""

    submerged_depth_m: Annotated[float, between(0.1, 50)]
    """Deeper than this the vehicle is under water, waves or not."""
    longest_submerged_hours: Hours
    """Time under water after which control has failed to bring it up: its own limit, and time to climb."""
    turning_time_s: Annotated[float, between(10, 86400)]
    """Longest time that a sound engine takes from a dive's ballast to a climb's, and the vehicle to turn."""
    least_voltage_v: Voltage
    """Below it there is no more dive."""
    lowest_voltage_v: Voltage
    """Below it the pump soon stops."""
    greatest_voltage_v: Voltage
    """Above it the gauge is wrong."""
    greatest_current_a: Annotated[float, between(0.01, 1000)]
    """Out of the battery, all consumers on."""
    vacuum_lost_kpa: AirPressure
    """Pressure in the hull above which its vacuum is lost."""
    hull_flooding_kpa: AirPressure
    """Pressure in the hull above which water presses its air together."""
    least_field_ut: FieldStrength = 20.0
    """Weakest plausible magnetic field."""
    greatest_field_ut: FieldStrength = 100.0
    """Strongest plausible one."""

    @model_validator(mode="after")
    def _are_ordered(self) -> Self:
        for lower, upper in (
            ("lowest_voltage_v", "least_voltage_v"),
            ("least_voltage_v", "greatest_voltage_v"),
            ("vacuum_lost_kpa", "hull_flooding_kpa"),
            ("least_field_ut", "greatest_field_ut"),
        ):
            low, high = getattr(self, lower), getattr(self, upper)
            if not low < high:
                raise ValueError(f"{lower} = {low:g}: must be less than {upper} = {high:g}")
        least = _DISCHARGED * self.greatest_voltage_v
        if self.lowest_voltage_v < least:
            allowed = f"at least {least:g} V, a quarter of greatest_voltage_v: no battery gives less and works"
            raise ValueError(f"lowest_voltage_v = {self.lowest_voltage_v:g}: must be {allowed}")
        return self


class Log(Table):
    """The vehicle's log."""

    folder: FolderName = "log"
    """Where it is kept, beside this file."""
    total_mib: Annotated[float, between(0.1, 1e6)] = 1024.0
    """Of all files together; the oldest that were sent ashore go first."""
    file_mib: Annotated[float, between(0.015625, 1024)] = 4.0
    """A file that has grown so large is closed, and the next begun."""
    raw: Flag = False
    """Whether frames of the bus and bytes of the ports are kept."""


class Power(Table):
    """What saves energy, and the account of it."""

    decide_every_s: Decisions = Decisions()
    compass_asleep_in: tuple[PhaseName, ...] = ()
    """Phases in which the compass rests between decisions, and measures a second before each."""
    sample_every_s: Samples = Samples()
    gps_in: tuple[PhaseName, ...] = ("surface", "recovery")
    """Phases in which GPS has power; elsewhere it hears nothing."""
    reserve: Annotated[float, between(0, 0.9)] = 0.1
    """Part of the battery's energy that is kept."""
    mean_over_hours: Hours = 4.0
    """Time over which the mean power is taken, for the estimate of the hours left."""


class Navigation(Table):
    """What is assumed of the errors of dead reckoning, standard deviations each.

    The vehicle tells by them how far its position may be wrong.
    """

    speed_error: Annotated[float, between(0, 1)] = 0.08
    """Of the speed through the water, a share of it."""
    speed_error_hours: Hours = 4.0
    """How long it keeps."""
    heading_error_deg: Annotated[float, between(0, 90)] = 3.0
    """Of the heading."""
    heading_error_hours: Hours = 2.0
    """How long it keeps."""
    current_m_s: Annotated[float, between(0, 3)] = 0.25
    """Of a current of which nothing is known yet, each of north and east."""
    current_change_m_s: Annotated[float, between(0, 3)] = 0.08
    """By how much a current has changed after `current_change_hours`, each of north and east."""
    current_change_hours: Hours = 6.0
    """After which time."""
    fix_m: Annotated[float, between(0.01, 1000)] = 10.0
    """Of a position by GPS that does not say so itself, each of north and east."""


class NodeParameters(Table):
    """What parameters of the nodes shall be at each start where they are something else; others are left as they are.

    Names, units and limits are those of the guide's page of the nodes, as in `{ quiet_after = 8.0 }`.
    """

    motion: dict[str, float] = Field(default_factory=dict)
    """Of the motion-control node."""
    acquisition: dict[str, float] = Field(default_factory=dict)
    """Of the data-acquisition node."""

    @model_validator(mode="after")
    def _are_allowed(self) -> Self:
        for node, settings in (("motion", MotionSettings), ("acquisition", AcquisitionSettings)):
            for name, value in getattr(self, node).items():
                if objection := objection_to(settings, name, value):
                    raise ValueError(f"{node}.{one_line(name, 40)} = {value:g}: {objection}")
        return self
