"""Tables of an orders file: what each is called, and between which numbers it may lie."""

from typing import Annotated, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from stommel.files.fields import Name, Table
from stommel.files.kinds import Flag, Format
from stommel.files.ranges import Depth, DepthOrZero, ZeroOr, between

_MOST = 200
"""Longest side of a flight table."""
_MOST_WAYPOINTS = 5000
_TWO_YEARS = 17520.0 * 3600.0
"""[s]"""

Ballast = Annotated[float, between(-0.1, 0.1)]
MassPosition = Annotated[float, between(-5, 5)]
Angle = Annotated[float, between(0, 1.571)]
Period = Annotated[float, between(1, 86400)]
SAMPLES = (0.1, 3600.0)
"""Between two samples of the CTD, as the message to its node can say it [s]."""
SampleInterval = Annotated[float, between(*SAMPLES)]
Latitude = Annotated[float, between(-1.571, 1.571)]
Longitude = Annotated[float, between(-3.142, 6.284)]
Cells = Annotated[tuple[tuple[Annotated[float, between(-1e3, 1e3)], ...], ...], Field(min_length=2, max_length=_MOST)]


class DivesTable(Table):
    """What one dive is asked to do."""

    depth_m: Depth
    """Greatest depth."""
    turns_early_m: Annotated[float, between(0, 12000)]
    """Way above it at which the vehicle turns, because it goes on sinking meanwhile."""
    pitch_rad: Annotated[float, between(0.05, 1.2)]
    """Magnitude of the pitch, down and up."""
    ballast_dive_m3: Ballast
    """Ballast volume of the descent."""
    ballast_climb_m3: Ballast
    """Ballast volume of the ascent."""
    ballast_surface_m3: Ballast
    """Ballast volume at the surface, to raise the antenna."""
    ballast_drift_m3: Ballast
    """Ballast volume that is neutral at `depth_m`."""
    moving_mass_drift_m: MassPosition
    """Moving-mass position at which it then lies level."""
    moving_mass_surface_m: MassPosition | None = None
    """Moving-mass position that raises the antenna; where the ascent left it if left out."""
    surface_s: Annotated[float, between(0, 86400)]
    """Time at the surface for position and radio."""
    longest_surface_s: Annotated[float, between(0, 864000)]
    """How long it waits at the surface for a position that does not come."""
    drift_s: Annotated[float, between(0, _TWO_YEARS)]
    """How long it hangs in the water at the turn."""
    surfacing_interval_s: Annotated[float, between(1, _TWO_YEARS)] | None = None
    """Time under water after which the next ascent goes to the surface; no such time if left out."""
    least_altitude_m: Annotated[float, ZeroOr(0.1, 1000)]
    """Height above the bottom at which it turns."""
    surfaced_depth_m: Annotated[float, between(0.01, 50)]
    """It counts as surfaced when it is no deeper than this."""
    per_surfacing: Annotated[int, Field(strict=True, ge=1, le=10_000)]
    """Dives from one stay at the surface to the next."""
    turn_depth_m: DepthOrZero
    """Depth of the upper turn of dives that do not surface."""
    abort_depth_m: Annotated[float, between(0.5, 13200)]
    """Too deep."""
    abort_time_s: Annotated[float, between(1, _TWO_YEARS)]
    """Too long without surfacing."""

    @model_validator(mode="after")
    def _can_be_flown(self) -> Self:
        for less, more in (
            ("surface_s", "longest_surface_s"),
            ("turns_early_m", "depth_m"),
            ("ballast_dive_m3", "ballast_climb_m3"),
        ):
            low, high = getattr(self, less), getattr(self, more)
            if low > high:
                raise ValueError(f"{more} = {high:g}: must not be less than {less} = {low:g}")
        return self


class PitchControlTable(Table):
    """Feedback on pitch by the moving mass."""

    gain_m_per_rad: Annotated[float, between(0, 60)]
    dead_band_rad: Angle
    period_s: Period
    tolerance_m: Annotated[float, between(1e-9, 1)]


class HeadingControlTable(Table):
    """Feedback on heading by rudder or rolling mass."""

    response_s: Annotated[float, between(0.1, 10000)]
    dead_band_rad: Angle
    limit_rad: Angle


class DriftControlTable(Table):
    """Feedback on depth while the vehicle hangs in the water."""

    gain_m3_s_m: Annotated[float, between(0, 0.1)]
    return_time_s: Annotated[float, between(6, 86400)]
    fastest_m_s: Annotated[float, between(0.001, 2)]
    dead_band_m: DepthOrZero
    period_s: Period


class AlarmsTable(Table):
    """What ends the mission."""

    energy_j: Annotated[float, between(0, 1e12)] | None = None
    """Measured energy out of the battery; no such alarm if left out."""
    leak: Flag
    """Whether the leak detectors do."""
    internal_pressure_pa: Annotated[float, between(100, 1e6)] | None = None
    """Measured pressure in the hull, absolute; no such alarm if left out."""


class WayTable(Table):
    """Dives, or climbs: rows over pitch, columns over ballast volume."""

    moving_mass_m: Cells
    angle_of_attack_rad: Cells
    speed_m_s: Cells
    turn_pole_per_s: Cells
    turn_drive_per_s2: Cells


class FlightTableTable(Table):
    """What the software knows of the vehicle's flight."""

    drag_per_mass_per_m: Annotated[float, between(1e-6, 10)]
    pitch_rad: Annotated[tuple[Angle, ...], Field(min_length=2, max_length=_MOST)]
    ballast_m3: Annotated[tuple[Annotated[float, between(1e-9, 0.1)], ...], Field(min_length=2, max_length=_MOST)]
    dive: WayTable
    climb: WayTable

    @model_validator(mode="after")
    def _is_even_and_whole(self) -> Self:
        for key in ("pitch_rad", "ballast_m3"):
            steps = np.diff(getattr(self, key))
            if steps.min() <= 0.0 or np.ptp(steps) > 1e-6 * steps.max():
                raise ValueError(f"{key}: must rise in even steps")
        for way in ("dive", "climb"):
            for name, rows in getattr(self, way):
                if len(rows) != len(self.pitch_rad) or any(len(row) != len(self.ballast_m3) for row in rows):
                    wanted = f"{len(self.pitch_rad)} rows of {len(self.ballast_m3)} numbers"
                    raise ValueError(f"{way}.{name}: must be {wanted}, for pitch_rad and ballast_m3")
        return self


class OrdersFile(Table):
    """Orders, as their file describes them."""

    format: Format
    kind: Literal["orders"]
    mission: Name
    created_from: Annotated[str, Field(max_length=200)]
    vehicle: Annotated[str, Field(min_length=1)]
    vehicle_sha256: Annotated[str, Field(pattern="^[0-9a-f]{64}$")]
    physics: Literal["paper", "full"]
    density_kg_m3: Annotated[float, between(900, 1200)]
    stommel: str
    expires_hours: Annotated[float, between(0.01, 17520)] | None = None
    """The mission expires so long after its start; never if left out."""
    step_s: Annotated[float, between(0.01, 60)]
    """Between two decisions."""
    guidance_every: Annotated[int, Field(strict=True, ge=1, le=100_000)]
    """Decisions from one look at waypoint and alarms to the next."""
    sampled_phases: tuple[Literal["surface", "descent", "inflection", "ascent", "recovery", "drift"], ...]
    """Phases in which the payload measures."""
    sample_every_s: SampleInterval | None = None
    """Between two samples of the CTD; as the vehicle's configuration says if left out."""
    waypoints_rad: Annotated[tuple[tuple[Latitude, Longitude], ...], Field(max_length=_MOST_WAYPOINTS)]
    """Latitude and longitude of each."""
    acceptance_radius_m: Annotated[float, between(5, 100000)]
    """A waypoint is reached within this distance."""
    lookahead_m: Annotated[float, between(5, 1e6)]
    """How far ahead on the line between waypoints it aims."""
    dives: DivesTable
    pitch_control: PitchControlTable
    heading_control: HeadingControlTable
    drift_control: DriftControlTable
    alarms: AlarmsTable
    flight_table: FlightTableTable
