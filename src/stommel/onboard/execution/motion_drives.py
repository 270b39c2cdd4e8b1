"""The three drives of the motion-control board: buoyancy engine, pitch drive, steering."""

from dataclasses import dataclass, field
from math import inf

from stommel.onboard.execution.drive_axis import Axis, AxisLimits
from stommel.onboard.execution.motion_io import DriveOutputs, MotionReadings
from stommel.onboard.nodes.motion_settings import MotionSettings

UNSURE = 1.1
"""What a first movement takes for the speed of pump and mass, in expected ones: it rather stops short."""


def engine_limits(s: MotionSettings) -> AxisLimits:
    """Limits of the buoyancy engine: up is the pump, down the valve."""
    return AxisLimits(
        s.ballast_low, s.ballast_high, s.oil_tolerance, s.pump_flow, s.valve_flow, UNSURE * s.pump_flow,
        max(s.valve_fastest, s.valve_flow), s.pump_current_limit, s.stuck_after, s.pause, s.retries,
    )  # fmt: skip


def mass_limits(s: MotionSettings) -> AxisLimits:
    """Limits of the pitch drive: up is forward."""
    return AxisLimits(
        s.mass_low, s.mass_high, s.mass_tolerance, s.mass_speed, s.mass_speed, UNSURE * s.mass_speed,
        UNSURE * s.mass_speed, s.mass_current_limit, s.stuck_after, s.pause, s.retries,
    )  # fmt: skip


def steering_limits(s: MotionSettings) -> AxisLimits:
    """Limits of the steering."""
    return AxisLimits(
        -s.steering_limit, s.steering_limit, s.steering_tolerance, s.steering_speed, s.steering_speed,
        s.steering_speed, s.steering_speed, s.steering_current_limit, s.stuck_after, s.pause, s.retries,
    )  # fmt: skip


@dataclass
class LimitSwitches:
    """The switches at both ends of the moving mass's way; pressed, they are obeyed even where they must be wrong."""

    fore: bool = False
    aft: bool = False
    broken: bool = False
    """Both are pressed, one is where the mass is not, or one is not where the mass has passed it."""
    _contradicts_since: float = inf

    def observe(self, t: float, readings: MotionReadings, position: float, s: MotionSettings) -> None:
        """Take the switches at a time, and hold them against the mass's position; not a number tells nothing."""
        self.fore, self.aft = bool(readings.limit_fore), bool(readings.limit_aft)
        margin = s.switch_margin
        contradicts = (self.fore and self.aft) or (
            (self.fore and position < s.mass_high - margin)
            or (self.aft and position > s.mass_low + margin)
            or (not self.fore and position > s.mass_high + margin)
            or (not self.aft and position < s.mass_low - margin)
        )
        if not contradicts:
            self._contradicts_since = inf
        elif self._contradicts_since == inf:
            self._contradicts_since = t
        self.broken = t - self._contradicts_since >= s.switch_patience


@dataclass
class MotionDrives:
    """All drives together; pump and valve are one axis, so that they never work against each other."""

    settings: MotionSettings
    engine: Axis = field(init=False)
    mass: Axis = field(init=False)
    steering: Axis = field(init=False)
    switches: LimitSwitches = field(default_factory=LimitSwitches)

    def __post_init__(self) -> None:
        self.engine = Axis(engine_limits(self.settings))
        self.mass = Axis(mass_limits(self.settings))
        self.steering = Axis(steering_limits(self.settings))

    def set(self, settings: MotionSettings) -> None:
        """Take other settings."""
        self.settings = settings
        self.engine.limits = engine_limits(settings)
        self.mass.limits = mass_limits(settings)
        self.steering.limits = steering_limits(settings)

    def clear(self) -> None:
        """Forget failures."""
        for axis in (self.engine, self.mass, self.steering):
            axis.clear()

    def observe(self, t: float, readings: MotionReadings) -> None:
        """Take readings at a time."""
        self.engine.observe(t, readings.V_b, readings.pump_current)
        self.mass.observe(t, readings.r_px, readings.mass_current)
        self.steering.observe(t, readings.steering, readings.steering_current)
        self.switches.observe(t, readings, self.mass.reading, self.settings)

    def hold(self, interval: float, *, drop: bool) -> DriveOutputs:
        """Stop and brake."""
        return self.drive(None, None, None, interval, drop=drop)

    def blow(self, interval: float, *, drop: bool) -> DriveOutputs:
        """Pump all oil out, mass aft, which raises the nose, steering amidships."""
        s = self.settings
        return self.drive(s.ballast_high, s.mass_low, 0.0, interval, drop=drop, endless=True)

    def drive(
        self,
        ballast: float | None,
        moving_mass: float | None,
        steering: float | None,
        interval: float,
        *,
        drop: bool,
        endless: bool = False,
    ) -> DriveOutputs:
        """Go to set points; None stops a drive.

        In the last reaction, which is `endless`, the valve stays shut, even with more oil outside than there may be.
        """
        oil = self.engine.drive(ballast, interval, endless, may_down=not endless)
        switches = self.switches
        r_px = self.mass.drive(moving_mass, interval, endless, not switches.fore, not switches.aft)
        if switches.fore and switches.aft:
            r_px = self.mass.drive(None, interval)
        angle = self.steering.drive(steering, interval)
        return DriveOutputs(max(oil, 0.0), -oil if oil < 0.0 else 0.0, r_px, angle, angle == 0.0, drop)
