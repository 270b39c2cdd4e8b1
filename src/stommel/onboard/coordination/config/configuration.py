"""A configuration that was read: the settings of the software's parts, SI units and radians."""

from contextlib import suppress
from dataclasses import dataclass
from math import radians
from pathlib import Path

from stommel.control.dive_cycle import PHASES
from stommel.errors import FileError, Problem
from stommel.files.toml_reader import read_table
from stommel.instruments.gnss.driver import GnssSettings
from stommel.instruments.tcm.driver import CompassSettings
from stommel.messages.adapters import Adapter, BusError
from stommel.messages.database import ACQUISITION, MOTION
from stommel.onboard.coordination.compass.calibration import CompassCalibration
from stommel.onboard.coordination.compass.calibration_file import read_calibration
from stommel.onboard.coordination.compass.compensation import Masking
from stommel.onboard.coordination.config.configuration_file import ConfigurationFile
from stommel.onboard.coordination.limits import ActuatorLimits, SafetyLimits
from stommel.onboard.coordination.logbook.logbook import LogSettings
from stommel.onboard.coordination.navigation import NavigationErrors
from stommel.onboard.coordination.node_parameters import Wanted
from stommel.onboard.coordination.power import PowerSchedule
from stommel.onboard.coordination.settings import CoordinatorSettings

_MIB = 1 << 20


@dataclass(frozen=True)
class Configuration:
    """What the software of a vehicle is set up with; `file` holds the numbers as they were written."""

    file: ConfigurationFile
    folder: Path
    """Of the file: what it names stands beside it."""
    calibration: CompassCalibration
    """Of the compass; the identity where the file names none."""
    adapter: Adapter
    """Of the CAN bus."""
    origin: str = "configuration"
    """Path of the file, for messages."""

    def path(self, name: str) -> Path:
        """Path of what the file names."""
        return self.folder / name

    @property
    def safety(self) -> SafetyLimits:
        """What failsafes and start checks hold readings against."""
        safety, limits = self.file.safety, self.file.limits
        return SafetyLimits(
            hull_rating_depth=limits.depth_rating_m,
            submerged_depth=safety.submerged_depth_m,
            longest_submerged=3600.0 * safety.longest_submerged_hours,
            turning_time=safety.turning_time_s,
            least_voltage=safety.least_voltage_v,
            lowest_voltage=safety.lowest_voltage_v,
            greatest_voltage=safety.greatest_voltage_v,
            greatest_current=safety.greatest_current_a,
            vacuum_lost=1e3 * safety.vacuum_lost_kpa,
            hull_flooding=1e3 * safety.hull_flooding_kpa,
            least_field=safety.least_field_ut,
            greatest_field=safety.greatest_field_ut,
        )

    @property
    def actuators(self) -> ActuatorLimits:
        """What the actuators can do, and where they stand when the vehicle is brought up."""
        limits, positions = self.file.limits, self.file.positions
        return ActuatorLimits(
            V_b_least=limits.ballast_ml[0] / 1e6,
            V_b_greatest=limits.ballast_ml[1] / 1e6,
            r_px_aft=limits.moving_mass_mm[0] / 1e3,
            r_px_fore=limits.moving_mass_mm[1] / 1e3,
            r_px_nose_up=positions.nose_up_mm / 1e3,
            r_px_surface=positions.surface_mm / 1e3,
            r_px_calling=positions.calling_mm / 1e3,
            steering=radians(limits.steering_deg),
            hold_mass=positions.tolerance_mm / 1e3,
        )

    @property
    def coordinator(self) -> CoordinatorSettings:
        """Settings of the coordinator."""
        file = self.file
        return CoordinatorSettings(
            safety=self.safety,
            actuators=self.actuators,
            has_drop_weight=file.positions.drop_weight,
            navigation=self.navigation,
            usable_energy=self.usable_energy,
            mean_power_over=3600.0 * file.power.mean_over_hours,
            schedule=self.schedule,
            node_parameters=self.node_parameters,
            has_altimeter=file.positions.altimeter,
            declination=radians(file.compass.declination_deg),
            calibration=self.calibration,
            masking=Masking(longest=file.compass.hold_s, settling=file.compass.settle_s),
            compass=self.compass,
            gnss=GnssSettings(format=file.gnss.format, port=file.gnss.receiver_port, interval=file.gnss.interval_s),
        )

    @property
    def compass(self) -> CompassSettings:
        """How the compass is to measure; one that sends by itself cannot rest."""
        return CompassSettings(interval=self.file.compass.interval_s, polled=any(self.schedule.compass_rests))

    @property
    def node_parameters(self) -> Wanted:
        """What parameters of the nodes shall be, by number of the node."""
        wanted = self.file.node_parameters
        return {node: values for node, values in ((MOTION, wanted.motion), (ACQUISITION, wanted.acquisition)) if values}

    @property
    def log(self) -> LogSettings:
        """How much the log may take."""
        log = self.file.log
        return LogSettings(total_bytes=round(log.total_mib * _MIB), file_bytes=round(log.file_mib * _MIB), raw=log.raw)

    @property
    def schedule(self) -> PowerSchedule:
        """When the controller decides, and what is on meanwhile."""
        power, file = self.file.power, self.file
        return PowerSchedule(
            decide=tuple(getattr(power.decide_every_s, phase) for phase in PHASES),
            compass_rests=tuple(phase in power.compass_asleep_in for phase in PHASES),
            ctd=tuple(getattr(power.sample_every_s, phase) or file.sample_every_s for phase in PHASES),
            gps=tuple(phase in power.gps_in for phase in PHASES),
        )

    @property
    def usable_energy(self) -> float | None:
        """Energy of the charged battery that may be taken [J]; None where the file does not say."""
        capacity = self.file.limits.battery_wh
        return None if capacity is None else 3600.0 * capacity * (1.0 - self.file.power.reserve)

    @property
    def navigation(self) -> NavigationErrors:
        """What is assumed of the errors of dead reckoning."""
        errors = self.file.navigation
        return NavigationErrors(
            speed=errors.speed_error,
            speed_time=3600.0 * errors.speed_error_hours,
            heading=radians(errors.heading_error_deg),
            heading_time=3600.0 * errors.heading_error_hours,
            current=errors.current_m_s,
            current_change=errors.current_change_m_s,
            current_time=3600.0 * errors.current_change_hours,
            fix=errors.fix_m,
        )


def read_configuration(path: str | Path) -> Configuration:
    """Read a vehicle's configuration, and the calibration of the compass that it names.

    Raises
    ------
    FileError
        A file cannot be read, is not TOML, or one problem for each wrong key, with what is allowed.
    """
    file = read_table(path, ConfigurationFile)
    folder = Path(path).parent
    try:
        adapter = Adapter(file.can.interface, file.can.channel, file.can.bitrate)
    except BusError as error:
        raise FileError([Problem(str(path), "can", str(error))]) from None
    return Configuration(file, folder, _calibration(file, Path(path)), adapter, str(path))


def _calibration(file: ConfigurationFile, path: Path) -> CompassCalibration:
    """Read the calibration that a configuration names; what cannot be used is said to be named there."""
    name, key = file.compass.calibration, "compass.calibration"
    if name is None:
        return CompassCalibration()
    named = path.parent / name
    if _is_one(named, path):
        why = "is this file itself; must be one of `stommel vehicle calibrate-compass`"
        raise FileError([Problem(str(path), key, f"{key} = {name!r}: {why}")])
    try:
        calibration = read_calibration(named)
    except FileError as error:
        here = Problem(str(path), key, f"{key} = {name!r}: cannot be used, see below")
        raise FileError([here, *error.problems]) from None
    low, high = file.safety.least_field_ut, file.safety.greatest_field_ut
    if not calibration.strength[0] < high or not low < calibration.strength[1]:
        believed = f"it believes fields of {calibration.strength[0]:g} to {calibration.strength[1]:g} uT"
        why = f"{believed}; safety has {low:g} to {high:g}: no heading would be good"
        raise FileError([Problem(str(path), key, f"{key} = {name!r}: {why}")])
    return calibration


def _is_one(path: Path, other: Path) -> bool:
    with suppress(OSError):
        return path.samefile(other)
    return False
