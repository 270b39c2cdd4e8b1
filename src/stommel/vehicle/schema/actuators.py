"""What the vehicle can do: travel, volume and speed of its actuators."""

from math import inf, radians
from typing import Annotated, Self

from pydantic import PrivateAttr, model_validator

from stommel.files.fields import Point, Table, ordered
from stommel.files.ranges import AngularSpeed, Liquid, Position, SignedVolume, between


class MovingMassDrive(Table):
    """Travel and speed of the moving mass along the hull."""

    travel_mm: tuple[Position, Position]
    """Positions of the mass forward of the centre of buoyancy, aft end first."""
    speed_mm_s: Annotated[float, between(0.01, 500)] | None = None

    @property
    def travel_m(self) -> tuple[float, float]:
        """Travel in metres."""
        return self.travel_mm[0] / 1e3, self.travel_mm[1] / 1e3

    @model_validator(mode="after")
    def _travel_is_an_interval(self) -> Self:
        ordered("travel_mm", self.travel_mm)
        return self


class BuoyancyEngine(Table):
    """Volume and flow of the buoyancy engine; zero is neutral."""

    volume_ml: tuple[SignedVolume, SignedVolume]
    flow_ml_s: Annotated[float, between(0.01, 1000)] | None = None
    bladder_position_m: Point | None = None
    reservoir_position_m: Point | None = None
    oil_density_kg_m3: Liquid | None = None

    _stroke_ml: float = PrivateAttr(inf)

    def limit_to_stroke(self, stroke_ml: float) -> None:
        """Let the machinery that the file describes bound the volume: no more than its stroke moves."""
        self._stroke_ml = stroke_ml

    @property
    def range_ml(self) -> tuple[float, float]:
        """Range of the ballast volume in millilitres: as stated, or about its middle what the stroke moves."""
        low, high = self.volume_ml
        if high - low <= self._stroke_ml:
            return low, high
        middle = 0.5 * (low + high)
        return middle - 0.5 * self._stroke_ml, middle + 0.5 * self._stroke_ml

    @property
    def volume_m3(self) -> tuple[float, float]:
        """`range_ml` in cubic metres."""
        low, high = self.range_ml
        return low / 1e6, high / 1e6

    @model_validator(mode="after")
    def _volume_is_an_interval(self) -> Self:
        ordered("volume_ml", self.volume_ml)
        return self


class RudderDrive(Table):
    """Travel and speed of the rudder."""

    travel_deg: Annotated[float, between(0.1, 90)]
    """To either side."""
    speed_deg_s: AngularSpeed | None = None

    @property
    def travel_rad(self) -> float:
        """Travel to either side in radians."""
        return radians(self.travel_deg)


class RollDrive(Table):
    """Travel and speed of the moving mass about the longitudinal axis."""

    travel_deg: Annotated[float, between(0.1, 180)]
    """To either side."""
    speed_deg_s: AngularSpeed | None = None

    @property
    def travel_rad(self) -> float:
        """Travel to either side in radians."""
        return radians(self.travel_deg)


class Actuators(Table):
    """What the vehicle can do; an actuator without limits may be left out."""

    moving_mass: MovingMassDrive | None = None
    buoyancy: BuoyancyEngine | None = None
    rudder: RudderDrive | None = None
    roll: RollDrive | None = None
