"""Where the energy comes from and where it goes: battery, consumers, and what the vehicle does between dives."""

from itertools import pairwise
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from stommel.files.fields import Name, Table
from stommel.files.ranges import (
    DepthOrZero,
    Efficiency,
    Power,
    Seconds,
    Share,
    SignedVolume,
    Speed,
    Voltage,
    ZeroOr,
    between,
)

PositiveShare = Efficiency


class Battery(Table):
    """Energy store."""

    capacity_ah: Annotated[float, between(0.1, 5000)]
    voltage_v: Voltage
    """Mean voltage over the discharge, by which the charge becomes energy."""
    chemistry: Name
    internal_resistance_ohm: Annotated[float, between(0, 50)] = 0.0
    """Of cells, wires and fuse together: by it the voltage falls under load."""
    usable_fraction: PositiveShare | None = None
    """What may be taken of the rated energy: the reserve that is kept and the end of discharge are left out."""
    self_discharge_per_month: Share | None = None
    """Part of the rated energy that is lost in 30 days without any load."""
    derating_temperature_c: tuple[Annotated[float, between(-100, 100)], ...] = ()
    """Temperatures at which `derating_fraction` is known, rising."""
    derating_fraction: tuple[PositiveShare, ...] = ()
    """Part of the rated capacity that is available at these temperatures; straight lines between them."""

    @model_validator(mode="after")
    def _derating_is_a_function(self) -> Self:
        temperatures, fractions = self.derating_temperature_c, self.derating_fraction
        if len(temperatures) != len(fractions):
            raise ValueError(
                f"derating_temperature_c has {len(temperatures)} numbers and derating_fraction has {len(fractions)}; "
                "they must have the same number"
            )
        if any(b <= a for a, b in pairwise(temperatures)):
            raise ValueError(f"derating_temperature_c = {list(temperatures)}: must rise from number to number")
        return self


class EnergyPlan(Table):
    """What a mission does beside gliding: surfacing, steering, corrections; and how power reaches the consumers."""

    regulator_efficiency: PositiveShare
    """Of the converters between the battery and the consumers whose supply is `regulated`."""
    surface_session_s: Seconds
    """Time at the surface with the antenna out: position fix and radio."""
    dives_per_surfacing: Annotated[int, Field(strict=True, ge=1, le=500)] = 1
    """Dives from one surfacing to the next; between them the vehicle turns at `upper_turn_m`."""
    upper_turn_m: DepthOrZero = 10.0
    """Depth of the upper turn of dives that do not surface."""
    surface_ballast_ml: SignedVolume | None = None
    """Ballast volume that raises the antenna; the greatest of the buoyancy engine if left out."""
    slowest_speed_m_s: Speed
    """Slowest speed along the path at which the vehicle is flown; the search for the best speed begins here."""
    rudder_turns_per_dive: Annotated[float, between(0, 5000)] = 0.0
    """Times that the rudder is put over and back in a dive."""
    rudder_turn_deg: Annotated[float, between(0, 90)] = 0.0
    """Angle to which it is put over."""
    rudder_hold_s: Annotated[float, between(0, 10000)] = 0.0
    """Time that it is held over."""
    pitch_corrections_per_dive: Annotated[float, between(0, 3000)] = 0.0
    """Times that the moving mass is moved and moved back to hold the pitch in a dive."""
    pitch_correction_mm: Annotated[float, ZeroOr(0.01, 1000)] = 0.0
    """Travel of such a correction, one way."""
    pump_efficiency: PositiveShare | None = None
    """Pressure work over electrical energy of motor and pump; used where the file does not describe the engine."""
    pump_idle_power_w: Power = 0.0
    """Electrical power of motor and pump that does no pressure work; used beside `pump_efficiency`."""
    valve_power_w: Power = 0.0
    """Power of the solenoid valve while the bladder empties; used beside `pump_efficiency`."""
    pitch_drive_efficiency: PositiveShare | None = None
    """Work against gravity over electrical energy; used where the file does not describe the drive."""
    pitch_drive_idle_power_w: Power = 0.0
    """Electrical power of the pitch drive that lifts nothing; used beside `pitch_drive_efficiency`."""
    rudder_turn_j: Annotated[float, between(0, 10000)] | None = None
    """Electrical energy of putting the rudder over and back; used where the file does not describe the drive."""


class Consumer(Table):
    """Something that takes electrical power, and when."""

    name: Name
    part: Literal["controller", "sensors", "navigation", "communication", "hotel"]
    """What it is counted with."""
    power_w: Power
    """Power while it is on, at its own terminals."""
    standby_w: Power = 0.0
    """Power while it is off."""
    on: Literal["always", "underwater", "dive", "climb", "surface", "moving"] = "always"
    """When it works; `moving` is while an actuator moves, `surface` while the antenna is out."""
    duty: Share | None = None
    """Part of that time in which it is on; all of it if left out."""
    sample_s: Annotated[float, between(0.001, 86400)] | None = None
    """Sampling plan instead of a duty: seconds on for a sample."""
    sample_every_s: Annotated[float, between(0.001, 864000)] | None = None
    """Seconds from one sample to the next."""
    seconds_per_surfacing: Seconds | None = None
    """Seconds on at each surfacing, instead of a duty; needs `on = "surface"`."""
    supply: Literal["battery", "regulated"] = "regulated"
    """Whether it is fed by the battery itself or through the converters."""

    @property
    def share_on(self) -> float:
        """Part of its time in which it is on; 1 where neither a duty nor a sampling plan is given."""
        if self.sample_s is not None and self.sample_every_s is not None:
            return self.sample_s / self.sample_every_s
        return 1.0 if self.duty is None else self.duty

    @model_validator(mode="after")
    def _one_plan(self) -> Self:
        if (self.sample_s is None) != (self.sample_every_s is None):
            raise ValueError(f"{self.name!r}: sample_s and sample_every_s go together")
        plans = [self.duty is not None, self.sample_s is not None, self.seconds_per_surfacing is not None]
        if sum(plans) > 1:
            raise ValueError(
                f"{self.name!r}: give one of duty, sample_s with sample_every_s, and seconds_per_surfacing"
            )
        if self.share_on > 1.0:
            raise ValueError(
                f"{self.name!r}: sample_s = {self.sample_s:g} every sample_every_s = {self.sample_every_s:g} is a duty "
                f"of {self.share_on:g}; must be at most 1"
            )
        if self.seconds_per_surfacing is not None and self.on != "surface":
            raise ValueError(f'{self.name!r}: seconds_per_surfacing needs on = "surface", not "{self.on}"')
        return self
