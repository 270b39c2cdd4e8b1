"""The tables of a scenario file on what is not the vehicle's choice: ocean, waves, errors of sensors, time steps."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from stommel.files.fields import Finite, Name, Point, Table
from stommel.files.kinds import FileNames, Flag
from stommel.files.ranges import DepthOrZero, Seconds, Share, between

FieldPart = Annotated[float, between(-5, 5)]
Triple = tuple[FieldPart, FieldPart, FieldPart]
AngleNoise = Annotated[float, between(0, 90)]
DepthNoise = Annotated[float, between(0, 100)]
Lag = Annotated[float, between(0, 600)]
Degrees = Annotated[float, between(-720, 720)]


class Ballasting(Table):
    """How the vehicle was trimmed before the mission."""

    neutral_depth_m: DepthOrZero | None = None
    """Depth at the start at which it is neutral with no ballast volume; if left out, it is neutral
    in the middle of the densities it meets."""


class Sensing(Table):
    """Errors of the sensors."""

    attitude_noise_deg: AngleNoise = 0.2
    """Of the direction down, by the accelerometers, standard deviation on each axis."""
    heading_noise_deg: AngleNoise = 0.3
    """Standard deviation; 0.3 deg is the accuracy of the compass in section 5.2 of the paper."""
    pressure_noise_m: DepthNoise = 0.05
    """Standard deviation, as depth."""
    pressure_bias_m: Annotated[float, between(-1000, 1000)] = 0.0
    """As depth."""
    gps_noise_m: Annotated[float, between(0, 10000)] = 3.0
    """Standard deviation of a position, each of north and east."""
    first_fix_s: Annotated[float, between(0.1, 3600)] = 40.0
    """Time from surfacing to the first position."""
    attitude_latency_s: Lag = 0.0
    """Time until pitch, roll and heading reach the software."""
    pressure_latency_s: Lag = 0.0
    """The same of depth."""
    altimeter_noise_m: DepthNoise = 0.1
    """Standard deviation of the height above the bottom."""
    altimeter_range_m: DepthOrZero = 50.0
    """Farther away the bottom is not heard."""
    magnetic_declination_deg: Annotated[float, between(-180, 180)] = 0.0
    """Of the Earth's field, east of true north positive."""
    known_declination_deg: Annotated[float, between(-180, 180)] | None = None
    """What the software corrects its headings by; the true declination if left out. The difference is an error."""
    magnetic_inclination_deg: Annotated[float, between(-90, 90)] = 45.0
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
    voltage_noise_v: Annotated[float, between(0, 100)] = 0.02
    """Of the battery's voltage, standard deviation."""
    voltage_bias_v: Annotated[float, between(-100, 100)] = 0.0
    current_noise_a: Annotated[float, between(0, 100)] = 0.005
    """Of the current out of the battery, standard deviation."""
    current_bias_a: Annotated[float, between(-100, 100)] = 0.0
    internal_pressure_noise_pa: Annotated[float, between(0, 1e5)] = 20.0
    """Of the pressure in the hull, standard deviation."""
    internal_pressure_bias_pa: Annotated[float, between(-1e5, 1e5)] = 0.0
    leak_ml: Annotated[float, between(0, 1e5)] = 5.0
    """Water in the hull that the leak detectors notice."""


class Ctd(Table):
    """Errors of the CTD, the glider's payload."""

    temperature_noise_c: Annotated[float, between(0, 10)] = 0.0005
    """Standard deviation."""
    conductivity_noise_s_m: Annotated[float, between(0, 1)] = 0.00003
    """Standard deviation."""
    pressure_noise_dbar: DepthNoise = 0.02
    """Standard deviation."""
    temperature_lag_s: Lag = 0.5
    """Time constant of the thermistor."""
    cell_flow_m_s: Annotated[float, between(0.05, 5)] = 0.58
    """Flow in the conductivity cell, which its thermal mass goes by (Morison et al. 1994): 10 ml/s of a GPCTD's pump
    through the cell in which they had 1.75 m/s at 30 ml/s."""
    cell_lag_s: Annotated[float, between(0.01, 600)] | None = None
    """Time constant of the cell's thermal mass; by its flow if left out."""
    cell_share: Share | None = None
    """Initial magnitude of the cell's error, as a part of a step in temperature; by its flow if left out."""

    @property
    def thermal_lag_s(self) -> float:
        """Time constant of the cell's thermal mass: stated, or tau = 2.7858 V^-1/2 + 7.1499 (Morison et al. 1994)."""
        return 2.7858 / self.cell_flow_m_s**0.5 + 7.1499 if self.cell_lag_s is None else self.cell_lag_s

    @property
    def thermal_share(self) -> float:
        """Share of the cell's error in a step: stated, or alpha = 0.0264 V^-1 + 0.0135 (Morison et al. 1994)."""
        return 0.0264 / self.cell_flow_m_s + 0.0135 if self.cell_share is None else self.cell_share


class Waves(Table):
    """The waves that wash over a floating vehicle's antenna: a JONSWAP sea."""

    significant_height_m: Annotated[float, between(0, 30)] = 0.0
    peak_period_s: Annotated[float, between(1, 30)] = 7.0


class HullAir(Table):
    """The air in the hull when it was closed."""

    pressure_kpa: Annotated[float, between(0.1, 1000)] = 60.0
    """Absolute: a partial vacuum shows whether the hull is tight."""
    temperature_c: Annotated[float, between(-50, 80)] = 20.0
    volume_l: Annotated[float, between(0.05, 5000)] = 15.0
    """With the ballast volume at zero."""
    settle_minutes: Annotated[float, between(0.1, 10000)] = 30.0
    """Time in which it takes on the temperature of the water."""


class Leak(Table):
    """A leak, to see what the vehicle does about it."""

    after_hours: Annotated[float, between(0, 17520)] = 0.0
    rate_ml_min: Annotated[float, between(0, 1e5)] = 0.0
    """Zero for a tight hull."""
    position_m: Point | None = None
    """Where the water stays, in the body frame: a compartment of its own. If left out, it runs to the lowest place."""


Policy = Literal["error", "hold", "climatology"]


class OceanChoice(Table):
    """The water to fly in."""

    name: Name | None = None
    """An analytic ocean; see `stommel ocean`."""
    file: FileNames | None = None
    """A CF NetCDF file instead, several, or a pattern; or a profile (.csv) that stands everywhere."""
    outside: Policy = "error"
    """Beyond the data in space or time: stop, hold the nearest values, or go over to `climatology`."""
    outside_time: Policy | None = None
    """The same for times alone, if different."""
    climatology: str | None = None
    """A second ocean, by name or file; without one the mean of the file is the climatology."""
    blend_km: Annotated[float, between(0, 20000)] = 50.0
    """Way beyond the edge of the data on which its last values give way to the climatology."""
    blend_hours: Annotated[float, between(0, 1e5)] = 24.0
    """Time beyond the data in which they do."""
    bounds_deg: tuple[Degrees, Degrees, Degrees, Degrees] | None = None
    """South, north, west and east of the region to read; all of the file if left out."""
    names: dict[str, str] = Field(default_factory=dict)
    """Names of the file's variables where their standard names do not tell."""
    units: dict[str, str] = Field(default_factory=dict)
    """Units of the file's variables where the file does not tell."""
    at_rest: Flag = False
    """Read no currents."""
    parameters: dict[str, Finite] = Field(default_factory=dict)
    """Numbers of an analytic ocean or of a profile's."""

    @model_validator(mode="after")
    def _one_ocean(self) -> Self:
        if (self.name is None) == (self.file is None):
            raise ValueError("ocean: give either name or file")
        for_files = {"bounds_deg": self.bounds_deg, "names": self.names, "units": self.units, "at_rest": self.at_rest}
        for key, value in for_files.items():
            if self.name is not None and value:
                raise ValueError(f"ocean.{key}: is for an ocean from a file; ocean.name = {self.name!r} is analytic")
        return self


class Integration(Table):
    """How finely time is cut."""

    control_step_s: Annotated[float, between(0.05, 10)] = 1.0
    """Between two decisions of the software."""
    steady_steps: Annotated[int, Field(strict=True, ge=1, le=1000)] = 1
    """Integration steps in a control step while nothing moves; fast flight takes more by itself."""
    moving_steps: Annotated[int, Field(strict=True, ge=1, le=1000)] = 2
    """The same while an actuator moves or the vehicle answers it."""
    settle_s: Seconds = 10.0
    """How long it answers."""
    ocean_s: Annotated[float, between(0.05, 1e6)] = 600.0
    """Between two looks at the ocean around the vehicle."""
