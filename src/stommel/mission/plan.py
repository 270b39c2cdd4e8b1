"""The plan: what a vehicle is told of its mission, in the words of its file."""

from typing import Annotated, Literal, Self

from pydantic import AfterValidator, Field, model_validator

from stommel.files.fields import Name, Table
from stommel.files.kinds import Flag, Format
from stommel.files.ranges import Depth, DepthOrZero, Hours, Share, Speed, Volume, ZeroOr, between
from stommel.geometry.longitudes import wrapped_deg

Latitude = Annotated[float, between(-90, 90)]
Longitude = Annotated[float, between(-180, 360), AfterValidator(wrapped_deg)]
"""Written to 180 or to 360; held, as every output has it, above -180 and up to 180."""
PitchAngle = Annotated[float, between(5, 60)]
DeadBand = Annotated[float, between(0, 90)]
Period = Annotated[float, between(1, 86400)]


class Position(Table):
    """A place on the surface."""

    latitude_deg: Latitude
    longitude_deg: Longitude


class Dives(Table):
    """How the vehicle dives."""

    depth_m: Depth
    """Greatest depth; it turns earlier by the way that it goes on sinking."""
    pitch_deg: PitchAngle
    """Magnitude of the pitch, down and up."""
    speed_m_s: Speed | None = None
    """Mean speed along the path through the water of the dive, while no oil flows; the ballast follows from trim and
    water."""
    least_speed_m_s: Speed | None = None
    """Speed along the path where the water drives least. Beside `speed_m_s`, which it defaults to half of, a bound on
    how slow the dive may become; instead of it, what the ballast volume follows from."""
    ballast_ml: Volume | None = None
    """Ballast volume beyond neutral where the water drives least, instead of a speed."""
    per_surfacing: Annotated[int, Field(strict=True, ge=1, le=10_000)] = 1
    """Dives from one stay at the surface to the next."""
    turn_depth_m: DepthOrZero = 10.0
    """Depth of the upper turn of dives that do not surface."""
    least_altitude_m: Annotated[float, ZeroOr(0.1, 1000)] = 10.0
    """Height above the bottom at which it turns, if the altimeter hears the bottom."""
    drift_hours: Annotated[float, between(0, 17520)] = 0.0
    """Time for which it hangs neutrally buoyant at `depth_m` before it climbs."""

    @model_validator(mode="after")
    def _one_drive(self) -> Self:
        by_speed = self.speed_m_s is not None or self.least_speed_m_s is not None
        if by_speed == (self.ballast_ml is not None):
            raise ValueError("dives: give speed_m_s or least_speed_m_s, or else ballast_ml")
        if self.speed_m_s is not None and self.least_speed_m_s is not None and self.least_speed_m_s > self.speed_m_s:
            raise ValueError(
                f"dives.least_speed_m_s = {self.least_speed_m_s:g}: must be at most "
                f"dives.speed_m_s = {self.speed_m_s:g}"
            )
        return self


class Surfacing(Table):
    """What happens at the surface."""

    session_s: Annotated[float, between(60, 86400)] = 300.0
    """Time for position and radio."""
    longest_s: Annotated[float, between(60, 864000)] = 1800.0
    """How long it waits for a position while waves wash over the antenna; then it dives without."""
    every_hours: Hours | None = None
    """Surface after the dive that is under way when so much time has passed, whatever `dives.per_surfacing` says."""
    pitch_deg: Annotated[float, between(-60, 60)] = -45.0
    """Pitch that raises the antenna; used where the vehicle file says where the antenna is."""
    ballast_ml: Volume | None = None
    """Ballast volume that raises the antenna; the engine's greatest if left out."""
    depth_m: Annotated[float, between(0.01, 50)] = 1.0
    """The vehicle counts as surfaced when it is no deeper than this."""


class Guidance(Table):
    """How waypoints are sought."""

    acceptance_radius_m: Annotated[float, between(5, 100000)] = 500.0
    """A waypoint is reached within this distance."""
    lookahead_m: Annotated[float, between(5, 1e6)] = 3000.0
    """How far ahead on the line between waypoints the vehicle aims."""
    repeat: Flag = False
    """Begin again with the first waypoint after the last."""


class Aborts(Table):
    """When a dive is broken off."""

    depth_m: Depth | None = None
    """Too deep; 10 % beyond the dive depth if left out."""
    dive_hours: Hours = 12.0
    """Too long without surfacing."""
    battery_share: Share = 0.02
    """The mission ends when no more than this part of the usable energy is left, by the vehicle's own account."""
    leak: Flag = True
    """The mission ends when the leak detectors find water."""
    internal_pressure_kpa: Annotated[float, between(0.1, 1000)] | None = None
    """The mission ends above this pressure in the hull: the vacuum is lost."""


class PitchControl(Table):
    """Feedback on pitch."""

    gain_mm_per_deg: Annotated[float, between(0, 1000)] | None = None
    """Correction of the moving mass for each degree of error, once a period; if left out, a third of what the flight
    table has between two flights a degree apart."""
    dead_band_deg: DeadBand = 0.5
    """Error that is left alone."""
    period_s: Period = 120.0
    """Time between corrections."""
    tolerance_mm: Annotated[float, between(1e-6, 1000)] = 0.5
    """Distance from its command below which the moving mass stays where it is."""


class HeadingControl(Table):
    """Feedback on heading by rudder or rolling mass; its gain follows from how the flight turns."""

    response_s: Annotated[float, between(0.1, 10000)] = 30.0
    """Time in which a heading error is turned away."""
    dead_band_deg: DeadBand = 1.0
    """Change of command that is left alone."""
    limit_deg: DeadBand = 10.0
    """Greatest command to either side; zero keeps it amidships."""


class DriftControl(Table):
    """Feedback on depth while the vehicle hangs in the water."""

    gain_ml_s_m: Annotated[float, between(0, 1e5)] = 60.0
    """Ballast volume for each metre per second by which it sinks too fast, once a period."""
    return_minutes: Annotated[float, between(0.1, 1440)] = 10.0
    """Time in which it should return to its depth."""
    fastest_m_s: Annotated[float, between(0.001, 2)] = 0.05
    """Vertical speed of the return."""
    dead_band_m: DepthOrZero = 3.0
    """Distance from the depth that is left alone."""
    period_s: Period = 60.0
    """Time between corrections."""


class Sampling(Table):
    """When the CTD measures."""

    every_s: Annotated[float, between(0.05, 86400)] = 10.0
    """Time between two samples."""
    phases: tuple[Literal["descent", "drift", "inflection", "ascent"], ...] = (
        "descent",
        "drift",
        "inflection",
        "ascent",
    )
    """Phases of the dive in which it is on."""


class Plan(Table):
    """A plan, as its file describes it; a vehicle needs nothing else to fly its mission."""

    format: Format = 1
    name: Name
    waypoints: tuple[Position, ...] = ()
    dives: Dives
    surface: Surfacing = Surfacing()
    guidance: Guidance = Guidance()
    abort: Aborts = Aborts()
    pitch_control: PitchControl = PitchControl()
    heading_control: HeadingControl = HeadingControl()
    drift_control: DriftControl = DriftControl()
    sampling: Sampling = Sampling()

    @model_validator(mode="after")
    def _waits_long_enough(self) -> Self:
        if self.surface.longest_s < self.surface.session_s:
            raise ValueError(
                f"surface.longest_s = {self.surface.longest_s:g}: must not be less than surface.session_s = "
                f"{self.surface.session_s:g}"
            )
        return self
