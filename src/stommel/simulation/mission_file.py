"""What a mission file may say: where to go, how to dive, what the ocean and the sensors are like."""

from datetime import UTC, datetime
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from stommel.vehicle.schema.fields import Finite, NotNegative, Positive, Table

Latitude = Annotated[float, Field(strict=True, ge=-90, le=90)]
Longitude = Annotated[float, Field(strict=True, ge=-180, le=360)]
Share = Annotated[float, Field(strict=True, ge=0, le=1)]
Triple = tuple[Finite, Finite, Finite]
PitchAngle = Annotated[float, Field(strict=True, ge=5, le=60)]


class Position(Table):
    """A place on the surface."""

    latitude_deg: Latitude
    longitude_deg: Longitude


class Dives(Table):
    """How the vehicle dives."""

    depth_m: Positive
    """Depth at which it turns."""
    pitch_deg: PitchAngle
    """Magnitude of the pitch, down and up."""
    speed_m_s: Positive | None = None
    """Speed along the path; the ballast volume follows from the trim."""
    ballast_ml: Positive | None = None
    """Magnitude of the ballast volume instead of the speed."""
    per_surfacing: Annotated[int, Field(strict=True, ge=1)] = 1
    """Dives from one stay at the surface to the next."""
    turn_depth_m: NotNegative = 10.0
    """Depth of the upper turn of dives that do not surface."""
    least_altitude_m: NotNegative = 10.0
    """Height above the bottom at which it turns, if the altimeter hears the bottom."""

    @model_validator(mode="after")
    def _one_drive(self) -> Self:
        if (self.speed_m_s is None) == (self.ballast_ml is None):
            raise ValueError("dives: give either speed_m_s or ballast_ml")
        return self


class Surfacing(Table):
    """What happens at the surface."""

    session_s: Annotated[float, Field(strict=True, ge=60)] = 300.0
    """Time for position and radio."""
    ballast_ml: Positive | None = None
    """Ballast volume that raises the antenna; the engine's greatest if left out."""
    depth_m: Positive = 1.0
    """The vehicle counts as surfaced when it is no deeper than this."""


class Ballasting(Table):
    """How the vehicle was trimmed before the mission."""

    neutral_depth_m: NotNegative | None = None
    """Depth at the start at which it is neutral with no ballast volume; if left out, it is neutral
    in the middle of the densities it meets."""


class Guidance(Table):
    """How waypoints are sought."""

    acceptance_radius_m: Positive = 500.0
    """A waypoint is reached within this distance."""
    lookahead_m: Positive = 3000.0
    """How far ahead on the line between waypoints the vehicle aims."""
    repeat: bool = False
    """Begin again with the first waypoint after the last."""


class Aborts(Table):
    """When a dive is broken off."""

    depth_m: Positive | None = None
    """Too deep; 10 % beyond the dive depth if left out."""
    dive_hours: Positive = 12.0
    """Too long without surfacing."""


class PitchControl(Table):
    """Feedback on pitch."""

    gain_mm_per_deg: NotNegative = 2.0
    """Correction of the moving mass for each degree of error, once a period."""
    dead_band_deg: NotNegative = 0.5
    """Error that is left alone."""
    period_s: Positive = 120.0
    """Time between corrections."""
    tolerance_mm: Positive = 0.5
    """Distance from its command below which the moving mass stays where it is."""


class HeadingControl(Table):
    """Feedback on heading by rudder or rolling mass."""

    gain: NotNegative = 0.25
    """Degrees of rudder (or roll of the mass) for each degree of heading error."""
    damping_s: NotNegative = 1.0
    """Degrees for each degree per second of heading rate."""
    dead_band_deg: NotNegative = 1.0
    """Change of command that is left alone."""
    limit_deg: Positive = 10.0
    """Greatest command to either side."""


class Sensing(Table):
    """Errors of the sensors."""

    attitude_noise_deg: NotNegative = 0.2
    """Pitch and roll, standard deviation."""
    heading_noise_deg: NotNegative = 0.3
    """Standard deviation; 0.3 deg is the accuracy of the compass in section 5.2 of the paper."""
    pressure_noise_m: NotNegative = 0.05
    """Standard deviation, as depth."""
    pressure_bias_m: Finite = 0.0
    """As depth."""
    gps_noise_m: NotNegative = 3.0
    """Standard deviation of a position, each of north and east."""
    first_fix_s: Positive = 40.0
    """Time from surfacing to the first position."""
    altimeter_range_m: NotNegative = 50.0
    """Farther away the bottom is not heard."""
    magnetic_inclination_deg: Annotated[float, Field(strict=True, ge=-90, le=90)] = 45.0
    """Dip of the Earth's field below the horizontal."""
    hard_iron: Triple = (0.0, 0.0, 0.0)
    """Field of the vehicle's own magnets in the body frame, in parts of the Earth's."""
    soft_iron: tuple[Triple, Triple, Triple] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    """Distortion of the Earth's field by iron, by rows."""
    pump_field: Triple = (0.0, 0.0, 0.0)
    """Field of the running pump, in parts of the Earth's."""
    valve_field: Triple = (0.0, 0.0, 0.0)
    """Field of the open valve."""
    pitch_drive_field: Triple = (0.0, 0.0, 0.0)
    """Field of the running pitch drive."""
    steering_field: Triple = (0.0, 0.0, 0.0)
    """Field of the running steering motor."""
    shielding: Share = 0.0
    """Part of the motors' and the valve's fields that shielding takes away."""


class OceanChoice(Table):
    """The water to fly in."""

    name: str | None = None
    """An analytic ocean; see `stommel ocean`."""
    file: str | None = None
    """A CF NetCDF file instead."""
    outside: Literal["error", "hold"] = "error"
    """Beyond the data in space or time: stop, or hold the nearest values."""
    parameters: dict[str, Finite] = Field(default_factory=dict)
    """Numbers of an analytic ocean."""

    @model_validator(mode="after")
    def _one_ocean(self) -> Self:
        if (self.name is None) == (self.file is None):
            raise ValueError("ocean: give either name or file")
        return self


class Integration(Table):
    """How finely time is cut."""

    control_step_s: Annotated[float, Field(strict=True, gt=0, le=10)] = 1.0
    """Between two decisions of the software."""
    steady_steps: Annotated[int, Field(strict=True, ge=1, le=1000)] = 2
    """Integration steps in a control step while nothing moves."""
    moving_steps: Annotated[int, Field(strict=True, ge=1, le=1000)] = 4
    """The same while an actuator moves or the vehicle answers it."""
    settle_s: NotNegative = 30.0
    """How long it answers."""
    ocean_s: Positive = 600.0
    """Between two looks at the ocean around the vehicle."""


class MissionFile(Table):
    """A mission, as its file describes it."""

    format: Literal[1] = 1
    name: Annotated[str, Field(min_length=1)]
    vehicle: Annotated[str, Field(min_length=1)]
    """Built-in vehicle or vehicle file, beside the mission file."""
    changes: dict[str, Finite] = Field(default_factory=dict)
    """Numbers of the vehicle file that this mission changes, by their dotted keys."""
    physics: Literal["paper", "full"] = "full"
    start_time: datetime
    """With its time zone."""
    duration_days: Annotated[float, Field(strict=True, gt=0, le=730)]
    """The mission ends here at the latest."""
    seed: Annotated[int, Field(strict=True, ge=0)] = 0
    """Of every random draw."""
    output_every_s: Positive = 10.0
    start: Position
    heading_deg: Finite = 0.0
    """At the start."""
    waypoints: tuple[Position, ...] = ()
    dives: Dives
    surface: Surfacing = Surfacing()
    ballasting: Ballasting = Ballasting()
    guidance: Guidance = Guidance()
    abort: Aborts = Aborts()
    pitch_control: PitchControl = PitchControl()
    heading_control: HeadingControl = HeadingControl()
    sensors: Sensing = Sensing()
    ocean: OceanChoice
    integration: Integration = Integration()

    @property
    def start_seconds(self) -> float:
        """Start [s since 1970-01-01 UTC]."""
        return self.start_time.timestamp()

    @model_validator(mode="after")
    def _is_consistent(self) -> Self:
        if self.start_time.tzinfo is None:
            raise ValueError(
                f"start_time = {self.start_time.isoformat()}: needs a time zone, such as "
                f"{self.start_time.replace(tzinfo=UTC).isoformat()}"
            )
        if self.sensors.first_fix_s >= self.surface.session_s:
            raise ValueError(
                f"sensors.first_fix_s = {self.sensors.first_fix_s:g}: must be less than surface.session_s = "
                f"{self.surface.session_s:g}, or no position is ever found"
            )
        steps = self.output_every_s / self.integration.control_step_s
        if abs(steps - round(steps)) > 1e-9 or steps < 1:
            raise ValueError(
                f"output_every_s = {self.output_every_s:g}: must be a multiple of integration.control_step_s = "
                f"{self.integration.control_step_s:g}"
            )
        return self
