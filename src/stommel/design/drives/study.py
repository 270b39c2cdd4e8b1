"""All that is asked of the drives of a vehicle, in one value for terminal, report and scripts."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import degrees, isfinite, isinf, radians
from typing import Any

from stommel.analysis.trim import trim
from stommel.design.drives.trim_change import TrimChange, pitches_between, trim_change
from stommel.design.named_warning import NamedWarning
from stommel.errors import StommelError
from stommel.machinery.drives.failures import DriveError
from stommel.machinery.drives.limit_switches import LimitSwitches, OverRun, over_run
from stommel.machinery.drives.pitch import PitchDrive, PitchPoint
from stommel.machinery.drives.rudder import RudderDrive, RudderStep, RudderTurn
from stommel.vehicle import Vehicle
from stommel.vehicle.missing_table import missing_table

DEFAULT_SPEED_M_S, DEFAULT_PITCH_DEG, DEFAULT_STEEPEST_DEG, DEFAULT_RUDDER_DEG = 0.4, 35.0, 50.0, 30.0
AGREEMENT = 0.02
"""Relative difference up to which two speeds count as the same."""
STEP_DEG = 5.0


@dataclass(frozen=True)
class PitchStudy:
    """The drive of the moving mass."""

    drive: PitchDrive
    points: tuple[PitchPoint, ...]
    """Every pitch of the table, moving forward and aft."""
    steepest: tuple[PitchPoint, ...]
    """The four starts at the steepest pitches: nose down and up, forward and aft."""
    dive_to_climb: TrimChange | None
    """None where the vehicle cannot fly its design flight, or the motor stalls."""
    climb_to_dive: TrimChange | None
    limits: LimitSwitches | None
    over_runs: tuple[OverRun, ...]
    file_speed: float | None
    """Speed that the actuators' table states [m/s]."""

    @property
    def worst_start(self) -> PitchPoint:
        """The start at the steepest pitch with the least margin."""
        return min(self.steepest, key=lambda point: point.stall_margin)

    @property
    def speed(self) -> float | None:
        """Mean speed over both trim changes [m/s]; None where there are none."""
        changes = [change for change in (self.dive_to_climb, self.climb_to_dive) if change is not None]
        return sum(c.travel for c in changes) / sum(c.time for c in changes) if changes else None

    def as_row(self) -> dict[str, Any]:
        """Words with units."""
        drive = self.drive
        return {
            "efficiency": drive.efficiency,
            "self_locking": drive.self_locking,
            "screw": drive.screw.as_row(),
            "worm": drive.worm.as_row() if drive.worm else None,
            "speed_mm_s": None if self.speed is None else self.speed * 1e3,
            "file_speed_mm_s": None if self.file_speed is None else self.file_speed * 1e3,
            "hardest_start": self.worst_start.as_row(),
            "dive_to_climb": self.dive_to_climb.as_row() if self.dive_to_climb else None,
            "climb_to_dive": self.climb_to_dive.as_row() if self.climb_to_dive else None,
            "over_runs": [run.as_row() for run in self.over_runs],
            "points": [point.as_row() for point in self.points],
        }


@dataclass(frozen=True)
class RudderStudy:
    """The drive of the rudder."""

    drive: RudderDrive
    V: float
    """Speed through the water [m/s]."""
    full_angle: float
    """Greatest angle [rad]."""
    hinge_moment: float
    """Greatest hinge moment within the travel [N m], with its sign."""
    full_step: RudderStep | None
    """From zero to the greatest angle; None where the motor stalls."""
    turn: RudderTurn | None
    holding_margin: float | None
    """At the greatest hinge moment; None without a brake."""
    file_speed: float | None
    """Speed that the actuators' table states [rad/s]."""

    @property
    def speed(self) -> float | None:
        """Mean speed of the full step [rad/s]."""
        return self.full_angle / self.full_step.time if self.full_step else None

    def as_row(self) -> dict[str, Any]:
        """Words with units; no margin of a brake that holds against nothing."""
        margin = self.holding_margin
        return {
            "speed_through_water_m_s": self.V,
            "hinge_moment_mn_m": self.hinge_moment * 1e3,
            "full_step": self.full_step.as_row() if self.full_step else None,
            "speed_deg_s": None if self.speed is None else degrees(self.speed),
            "file_speed_deg_s": None if self.file_speed is None else degrees(self.file_speed),
            "holding_margin": None if margin is None or isinf(margin) else margin,
            "turn": self.turn.as_row() if self.turn else None,
        }


@dataclass(frozen=True)
class DriveStudy:
    """Both drives of a vehicle, as far as its file describes them."""

    vehicle: Vehicle
    pitch: PitchStudy | None
    rudder: RudderStudy | None
    warnings: tuple[NamedWarning, ...]

    def as_json(self) -> dict[str, Any]:
        """The study in words with units."""
        return {
            "vehicle": self.vehicle.name,
            "pitch": self.pitch.as_row() if self.pitch else None,
            "rudder": self.rudder.as_row() if self.rudder else None,
            "warnings": [warning.as_row() for warning in self.warnings],
        }


def drive_study(
    vehicle: Vehicle,
    *,
    steepest_deg: float | None = None,
    speed_m_s: float | None = None,
    rudder_deg: float | None = None,
    hold_s: float = 60.0,
) -> DriveStudy:
    """Compute the drives of a vehicle.

    Parameters
    ----------
    steepest_deg
        Steepest pitch, up and down; the specification's if left out.
    speed_m_s
        Speed at which the rudder works; the specification's greatest if left out.
    rudder_deg
        Angle of the rudder in a turn; its full travel if left out.
    hold_s
        Time that it is held over.

    Raises
    ------
    DriveError
        The file describes neither drive, or a number is impossible.
    """
    d = vehicle.description
    if d.drives is None or (d.drives.pitch is None and d.drives.rudder is None):
        raise DriveError(
            f"{vehicle.origin}: has neither a table [drives.pitch] nor [drives.rudder]; add one; "
            f"{missing_table('drives.pitch')}; {missing_table('drives.rudder')}"
        )
    spec = d.specification
    steepest = steepest_deg if steepest_deg is not None else spec.pitch_deg if spec else DEFAULT_STEEPEST_DEG
    speed = speed_m_s if speed_m_s is not None else (spec.speed_m_s if spec else None) or DEFAULT_SPEED_M_S
    travel = d.actuators.rudder.travel_deg if d.actuators.rudder else None
    full = travel or (spec.rudder_deg if spec else None) or DEFAULT_RUDDER_DEG
    turn = full if rudder_deg is None else rudder_deg
    _in_range("steepest pitch", steepest, 0.0, 90.0, "deg")
    _in_range("speed", speed, 0.0, 5.0, "m/s")
    _in_range("rudder angle", turn, 0.0, full + 1e-9, "deg")
    if not (isfinite(hold_s) and hold_s >= 0.0):
        raise DriveError(f"hold = {hold_s:g} s: must be at least 0")
    notes: list[NamedWarning] = []
    pitch = _pitch(vehicle, radians(steepest), notes) if d.drives.pitch else None
    rudder = _rudder(vehicle, speed, radians(full), radians(turn), hold_s) if d.drives.rudder else None
    if pitch:
        notes += _pitch_warnings(pitch)
    if rudder:
        notes += _rudder_warnings(rudder)
    return DriveStudy(vehicle, pitch, rudder, tuple(notes))


def _in_range(name: str, value: float, low: float, high: float, unit: str) -> None:
    if not low < value <= high:
        raise DriveError(f"{name} = {value:g} {unit}: must be greater than {low:g} and at most {high:g} {unit}")


def _pitch(vehicle: Vehicle, steepest: float, notes: list[NamedWarning]) -> PitchStudy:
    drive, limits = PitchDrive.of(vehicle), LimitSwitches.of(vehicle)
    if limits is not None and not (limits.switches[0] <= limits.travel[0] and limits.travel[1] <= limits.switches[1]):
        raise DriveError(
            f"{vehicle.origin}: drives.pitch.switches_mm = [{limits.switches[0] * 1e3:g}, "
            f"{limits.switches[1] * 1e3:g}]: must enclose actuators.moving_mass.travel_mm = "
            f"[{limits.travel[0] * 1e3:g}, {limits.travel[1] * 1e3:g}]"
        )
    changes = _trim_changes(vehicle, drive, notes)
    edge = degrees(steepest)
    stated = vehicle.description.actuators.moving_mass
    return PitchStudy(
        drive=drive,
        points=tuple(
            drive.point(theta, direction)
            for theta in pitches_between(-edge, edge, min(STEP_DEG, edge))
            for direction in (-1, 1)
        ),
        steepest=tuple(drive.point(theta, direction) for theta in (-steepest, steepest) for direction in (-1, 1)),
        dive_to_climb=changes[0],
        climb_to_dive=changes[1],
        limits=limits,
        over_runs=tuple(over_run(drive, limits, direction, steepest) for direction in (-1, 1)) if limits else (),
        file_speed=stated.speed_mm_s / 1e3 if stated and stated.speed_mm_s else None,
    )


def _trim_changes(
    vehicle: Vehicle, drive: PitchDrive, notes: list[NamedWarning]
) -> tuple[TrimChange | None, TrimChange | None]:
    """Dive to climb and back at the design speed and pitch of the specification."""
    spec = vehicle.description.specification
    speed = (spec.design_speed_m_s if spec else None) or DEFAULT_SPEED_M_S
    pitch = (spec.design_pitch_deg if spec else None) or DEFAULT_PITCH_DEG
    try:
        dive, climb = (trim(vehicle, speed_m_s=speed, pitch_deg=side * pitch) for side in (-1.0, 1.0))
    except StommelError as error:
        notes.append(NamedWarning("no_trim_change", f"time and energy of the trim change are unknown, because {error}"))
        return None, None
    return trim_change(drive, dive, climb), trim_change(drive, climb, dive)


def _rudder(vehicle: Vehicle, V: float, full: float, angle: float, hold: float) -> RudderStudy:
    drive = RudderDrive.of(vehicle)
    angles = [full * k / 60 for k in range(61)]
    worst = max(angles, key=lambda delta_r: abs(drive.hinge_moment(delta_r, V)))
    stated = vehicle.description.actuators.rudder
    return RudderStudy(
        drive=drive,
        V=V,
        full_angle=full,
        hinge_moment=drive.hinge_moment(worst, V),
        full_step=drive.step(0.0, full, V),
        turn=drive.turn(angle, V, hold),
        holding_margin=drive.holding_margin(worst, V),
        file_speed=radians(stated.speed_deg_s) if stated and stated.speed_deg_s else None,
    )


def _pitch_warnings(study: PitchStudy) -> Iterator[NamedWarning]:
    drive, worst = study.drive, study.worst_start
    if not drive.self_locking:
        yield NamedWarning(
            "mass_not_held",
            "neither worm nor screw locks itself: the moving mass needs a brake, or current, to stay where it is",
        )
    elif drive.worm is not None and not drive.worm.self_locking:
        yield NamedWarning("worm_back_drives", "the worm does not lock itself; the screw alone holds the moving mass")
    if not worst.starts:
        yield NamedWarning(
            "cannot_start",
            f"at pitch {degrees(worst.theta):g} deg the motor needs {worst.starting_torque * 1e3:.3g} mN m to start "
            f"and has {drive.motor.stall_torque * 1e3:.3g} mN m",
        )
    hottest = max(point.motor.current for point in study.points)
    if hottest > drive.motor.I_continuous:
        yield NamedWarning(
            "motor_overloaded",
            f"the pitch motor takes {hottest:.3g} A, more than the {drive.motor.I_continuous:g} A that it bears",
        )
    for run in study.over_runs:
        if not run.caught:
            end = "forward" if run.direction > 0 else "aft"
            yield NamedWarning(
                "over_run",
                f"the {end} switch leaves {run.room * 1e3:g} mm to the end stop; the mass runs on "
                f"{run.run_on * 1e3:.3g} mm after it has opened",
            )
    yield from _speed_warning("moving_mass_speed", study.speed, study.file_speed, 1e3, "mm/s", "moving_mass.speed_mm_s")


def _rudder_warnings(study: RudderStudy) -> Iterator[NamedWarning]:
    drive = study.drive
    if study.full_step is None:
        yield NamedWarning("rudder_stalls", f"the motor cannot put the rudder over at {study.V:g} m/s")
    elif study.full_step.greatest_current > drive.motor.I_continuous:
        yield NamedWarning(
            "motor_overloaded",
            f"the rudder motor takes {study.full_step.greatest_current:.3g} A, more than the "
            f"{drive.motor.I_continuous:g} A that it bears",
        )
    angles = [study.full_angle * k / 60 for k in range(1, 61)]
    over = [delta_r for delta_r in angles if drive.hinge_moment(delta_r, study.V) < 0.0]
    if over:
        yield NamedWarning(
            "rudder_overbalanced",
            f"up to {degrees(max(over)):.0f} deg the water pushes the rudder farther over, because the stock lies aft "
            "of the centre of pressure; without brake or gearbox it would not return by itself",
        )
    if study.holding_margin is None:
        yield NamedWarning("no_brake", "the rudder has no brake: the motor must hold it")
    elif study.holding_margin < 1.0:
        yield NamedWarning(
            "brake_slips", f"the brake holds {100 * study.holding_margin:.0f} % of the greatest hinge moment"
        )
    if drive.brake is not None and not drive.brake.normally_closed:
        yield NamedWarning("brake_needs_power", "the brake holds only while it is fed: a rudder without power is loose")
    yield from _speed_warning(
        "rudder_speed", study.speed, study.file_speed, degrees(1.0), "deg/s", "rudder.speed_deg_s"
    )


def _speed_warning(
    name: str, found: float | None, stated: float | None, factor: float, unit: str, key: str
) -> Iterator[NamedWarning]:
    if found is not None and stated is not None and abs(found / stated - 1.0) > AGREEMENT:
        yield NamedWarning(
            f"{name}_differs",
            f"the drive moves at {found * factor:.3g} {unit}; actuators.{key} = {stated * factor:.3g} says otherwise",
        )
