"""The file of a vehicle's configuration, and what its tables must be to each other."""

from collections.abc import Iterator
from pathlib import PureWindowsPath
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from stommel.control.dive_cycle import PHASES
from stommel.control.vehicle_limits import VehicleLimits
from stommel.files.fields import Name, Table
from stommel.files.kinds import Format
from stommel.onboard.coordination.config.by_phase import Interval
from stommel.onboard.coordination.config.tables import (
    BenchPort,
    CanPort,
    CompassPort,
    FolderName,
    GnssPort,
    Log,
    Navigation,
    NodeParameters,
    Positions,
    Power,
    RadioPort,
    Safety,
)

_PORTS = ("compass", "gnss", "radio", "bench")
_PASCAL_PER_METRE = 1e4
"""Pressure of water per depth, as a floor: that of the sea is 1.01e4."""
_FASTEST_RISE = 1.0
"""Of a glider [m/s]."""
_GREATEST_TOLERANCE = 0.1
"""Share of the moving mass's travel."""
_BATTERY_HOURS = (0.2, 1000.0)
"""Time for which any glider's battery lasts with all consumers on [h]: a thousand times the energy is a slip."""
_LOG_FILES = 6.0
"""Files of their full size for which a log must have room."""
_COMPASS_BYTES = 90
"""Longest frame of readings."""
_GNSS_BYTES = {"novatel_binary": 256, "novatel_ascii": 500, "nmea": 164}
"""Of one position with velocity and time: headers, bodies and checksums of the OEM7 manual; two full sentences."""
_BITS_PER_BYTE = 10
"""Of a serial line: start, eight, stop."""


class ConfigurationFile(Table):
    """A vehicle's software."""

    format: Format
    kind: Literal["vehicle configuration"]
    vehicle: Name
    """Name of the vehicle."""
    vehicle_id: Annotated[int, Field(strict=True, ge=1, le=250)]
    """Number of the vehicle on the radio; each of a fleet has its own."""
    missions: FolderName = "missions"
    """Folder of the missions that were received, beside this file."""
    parameters: FolderName = "parameters"
    """Folder of the parameters and of what must outlive a restart."""
    inbox: FolderName = "inbox"
    """Folder of the files that were received, for nothing else: who commands by radio may write there."""
    sample_every_s: Interval = 10.0
    """Between two samples of the CTD, which is on the acquisition node; `power.sample_every_s` has other times."""
    limits: VehicleLimits
    positions: Positions
    can: CanPort = CanPort()
    compass: CompassPort
    gnss: GnssPort
    radio: RadioPort
    bench: BenchPort = BenchPort()
    safety: Safety
    log: Log = Log()
    power: Power = Power()
    navigation: Navigation = Navigation()
    node_parameters: NodeParameters = NodeParameters()

    @model_validator(mode="after")
    def _fits_together(self) -> Self:
        checks = (
            _of_actuators,
            _of_ports,
            _of_inbox,
            _of_lines,
            _of_depth_and_time,
            _of_pressures,
            _of_energy,
            _of_phases,
            _of_log,
        )
        found = [words for check in checks for words in check(self)]
        if found:
            raise ValueError("\n".join(found))
        return self


def _of_actuators(file: ConfigurationFile) -> Iterator[str]:
    """Ballast on both sides of neutral, and positions within the travel of the moving mass."""
    least, greatest = file.limits.ballast_ml
    if not least < 0.0 < greatest:
        yield (
            f"limits.ballast_ml = {[least, greatest]}: must go from below 0 to above it: heavier than water the "
            "vehicle dives, lighter it comes up"
        )
    low, high = file.limits.moving_mass_mm
    for name in ("nose_up_mm", "surface_mm", "calling_mm"):
        value = getattr(file.positions, name)
        if not low <= value <= high:
            allowed = f"between {low:g} and {high:g} mm, the ends of limits.moving_mass_mm"
            yield f"positions.{name} = {value:g}: must be {allowed}"
    most, tolerance = _GREATEST_TOLERANCE * (high - low), file.positions.tolerance_mm
    if tolerance > most:
        allowed = f"at most {most:g} mm, a tenth of the way between the ends of limits.moving_mass_mm"
        yield f"positions.tolerance_mm = {tolerance:g}: must be {allowed}"


def _of_ports(file: ConfigurationFile) -> Iterator[str]:
    """A port of its own for each."""
    ports = {f"{table}.port": str(port) for table in _PORTS if (port := getattr(file, table).port) is not None}
    if file.can.interface == "slcan" and file.can.channel:
        ports["can.channel"] = file.can.channel
    for key, port in ports.items():
        others = [other for other in ports if other != key and ports[other] == port]
        if others:
            yield f"{key} = {port!r}: is that of {others[0].partition('.')[0]} too; each needs a port of its own"
            return


def _of_inbox(file: ConfigurationFile) -> Iterator[str]:
    """Nothing of the software's own where a shore may write."""
    inbox = PureWindowsPath(file.inbox)
    calibration = file.compass.calibration
    taken = {
        "this file": PureWindowsPath(),
        "missions": PureWindowsPath(file.missions),
        "parameters": PureWindowsPath(file.parameters),
        "log.folder": PureWindowsPath(file.log.folder),
        "radio.key": PureWindowsPath(file.radio.key).parent,
        "compass.calibration": PureWindowsPath(calibration or "").parent,
    }
    for key, folder in taken.items():
        if folder == inbox:
            yield f"inbox = {file.inbox!r}: {key} is there; received files need a folder of their own"
            return


def _of_lines(file: ConfigurationFile) -> Iterator[str]:
    """Serial lines that carry what is asked for."""
    for table, size in (("compass", _COMPASS_BYTES), ("gnss", _GNSS_BYTES[file.gnss.format])):
        port = getattr(file, table)
        least = size * _BITS_PER_BYTE / port.baud
        if port.interval_s < least:
            yield (
                f"{table}.interval_s = {port.interval_s:g}: must be at least {least:.2g} s, in which {table}.baud = "
                f"{port.baud} carries {size} bytes"
            )


def _of_depth_and_time(file: ConfigurationFile) -> Iterator[str]:
    """Depths and times of the failsafes, against the depth, the engine and the power that the file states."""
    limits, safety = file.limits, file.safety
    if safety.submerged_depth_m >= limits.depth_rating_m:
        allowed = f"less than limits.depth_rating_m = {limits.depth_rating_m:g}"
        yield f"safety.submerged_depth_m = {safety.submerged_depth_m:g}: must be {allowed}"
    oil = (limits.ballast_ml[1] - limits.ballast_ml[0]) / 1e6
    least = _PASCAL_PER_METRE * limits.depth_rating_m * oil / _greatest_power(safety)
    if safety.turning_time_s < least:
        yield (
            f"safety.turning_time_s = {safety.turning_time_s:g}: must be at least {least:.3g} s, in which "
            "greatest_current_a at greatest_voltage_v pumps limits.ballast_ml at limits.depth_rating_m"
        )
    least = (safety.turning_time_s + limits.depth_rating_m / _FASTEST_RISE) / 3600.0
    if safety.longest_submerged_hours < least:
        yield (
            f"safety.longest_submerged_hours = {safety.longest_submerged_hours:g}: must be at least {least:.3g} h, "
            "turning_time_s and a rise from limits.depth_rating_m at 1 m/s"
        )


def _of_pressures(file: ConfigurationFile) -> Iterator[str]:
    """Air at the surface between a lost vacuum and a flooding hull."""
    air, safety = file.limits.internal_pressure_kpa, file.safety
    low, high = safety.vacuum_lost_kpa, safety.hull_flooding_kpa
    if air is not None and not low <= air <= high:
        yield (
            f"limits.internal_pressure_kpa = {air:g}: must be between {low:g} and {high:g} kPa, "
            "safety.vacuum_lost_kpa and safety.hull_flooding_kpa"
        )


def _of_energy(file: ConfigurationFile) -> Iterator[str]:
    """A battery that its own greatest power empties neither at once nor never."""
    energy, power = file.limits.battery_wh, _greatest_power(file.safety)
    low, high = (hours * power for hours in _BATTERY_HOURS)
    if energy is not None and not low <= energy <= high:
        yield (
            f"limits.battery_wh = {energy:g}: must be between {low:.3g} and {high:.3g} Wh, which last "
            f"{_BATTERY_HOURS[0]:g} to {_BATTERY_HOURS[1]:g} h at safety.greatest_current_a and greatest_voltage_v"
        )


def _of_phases(file: ConfigurationFile) -> Iterator[str]:
    """Decisions in time, and positions where the vehicle is at the surface."""
    for phase in PHASES:
        interval = getattr(file.power.decide_every_s, phase)
        if interval >= file.safety.turning_time_s:
            allowed = f"less than safety.turning_time_s = {file.safety.turning_time_s:g}"
            yield f"power.decide_every_s.{phase} = {interval:g}: must be {allowed}"
    missing = [phase for phase in ("surface", "recovery") if phase not in file.power.gps_in]
    if missing:
        yield f"power.gps_in = {list(file.power.gps_in)}: must have {' and '.join(missing)}, where positions come from"
    if file.compass.settle_s > file.compass.hold_s:
        allowed = f"at most compass.hold_s = {file.compass.hold_s:g}"
        yield f"compass.settle_s = {file.compass.settle_s:g}: must be {allowed}, for which a heading is held"


def _of_log(file: ConfigurationFile) -> Iterator[str]:
    least = _LOG_FILES * file.log.file_mib
    if file.log.total_mib < least:
        yield f"log.total_mib = {file.log.total_mib:g}: must be at least {least:g}, six times log.file_mib"


def _greatest_power(safety: Safety) -> float:
    """All consumers on [W]."""
    return safety.greatest_current_a * safety.greatest_voltage_v
