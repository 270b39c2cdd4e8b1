"""Analytic oceans that are the same at every place: a grid of one node, exact but for the depth levels' spacing."""

from collections.abc import Mapping
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from stommel.files.nearest import did_you_mean
from stommel.files.sentences import sentence
from stommel.ocean.errors import UnknownOceanError
from stommel.ocean.kernel.building import Frame, Slot, ocean_grid
from stommel.ocean.kernel.grid import UNBOUNDED_DEPTH, OceanGrid
from stommel.seawater import properties
from stommel.seawater.stratification import Stratification, south_china_sea, two_layer

M2_PERIOD_H = 12.4206012
"""Period of the principal lunar tide, 360 degrees by 28.9841042 degrees an hour."""

Temperature = Annotated[float, Field(ge=-2.0, le=40.0)]
Salinity = Annotated[float, Field(ge=0.0, le=42.0)]
Latitude = Annotated[float, Field(ge=-90.0, le=90.0)]
Longitude = Annotated[float, Field(ge=-360.0, le=360.0)]
Speed = Annotated[float, Field(ge=-5.0, le=5.0)]
Depth = Annotated[float, Field(gt=0.0, le=11000.0)]
Angle = Annotated[float, Field(ge=-360.0, le=360.0)]

_DEEPEST_LEVEL = 6000.0
"""Levels reach this deep where an ocean has no bottom [m]."""

Array = NDArray[np.float64]


class Parameters(BaseModel):
    """What all oceans have in common."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)

    bottom_m: Depth | None = None
    """Depth of a flat bottom; none if left out."""
    latitude_deg: Latitude = 30.0
    """For gravity, pressure and the composition of the salt; the middle of oceans that vary from place to place."""
    longitude_deg: Longitude = 125.0

    def notes(self) -> dict[str, str]:
        """What was assumed."""
        return {"kind": (type(self).__doc__ or "").strip().splitlines()[0]}

    def _depth(self) -> float:
        return self.bottom_m if self.bottom_m is not None else _DEEPEST_LEVEL


def made(kind: type[Any], label: str, values: Mapping[str, Any]) -> Any:
    """Make an ocean of a kind from its parameters.

    Raises
    ------
    UnknownOceanError
        A parameter is unknown, or a value is not allowed; `label` begins the sentence.
    """
    try:
        return kind(**values)
    except ValidationError as error:
        # unknown keys first: they often explain the missing ones
        detail = min(error.errors(include_url=False), key=lambda detail: detail["type"] != "extra_forbidden")
        if detail["type"] == "extra_forbidden":
            known, name = list(kind.model_fields), str(detail["loc"][0])
            near = next((key for key in known if key.startswith(f"{name}_")), name)
            text = f"{label}: unknown parameter {name}{did_you_mean(near, known)} parameters: {', '.join(known)}"
            raise UnknownOceanError(text) from None
        raise UnknownOceanError(f"{label}: {sentence(detail, kind)}") from None


class _Everywhere(Parameters):
    def _layers(self) -> Stratification:
        raise NotImplementedError

    def _current(self, z: Array) -> tuple[Array, Array]:
        """Steady current to east and north at depths [m/s]."""
        return np.zeros_like(z), np.zeros_like(z)

    def _tide(self) -> tuple[Array, Array]:
        """Angular speeds, and east cos, east sin, north cos, north sin of each."""
        return np.zeros(0), np.zeros((0, 4))

    def grid(self) -> OceanGrid:
        """Grid of one node."""
        layers = self._layers()
        return single_node(layers, self, self._current(layers.depths), self._tide())


def single_node(
    layers: Stratification, place: Parameters, current: tuple[Array, Array], tide: tuple[Array, Array]
) -> OceanGrid:
    """Grid of one node: the same layers, current to east and north [m/s] and tides everywhere, always.

    `place` has the latitude and longitude for pressure, and the bottom; `tide` the angular speeds [rad/s], and east
    cos, east sin, north cos, north sin of each [m/s].
    """
    p = properties.pressure_from_depth(layers.depths, place.latitude_deg)
    fields = (properties.in_situ_temperature(layers.CT, layers.S_A, p), layers.S_A, layers.CT, *current)
    bottom = place.bottom_m if place.bottom_m is not None else UNBOUNDED_DEPTH
    omega, ellipses = tide
    node = np.radians([[place.latitude_deg]]), np.radians([[place.longitude_deg]])
    frame = Frame(
        np.zeros(1), (-np.inf, np.inf), layers.depths, *node, np.full((1, 1), bottom), omega,
        ellipses[:, None, None, :], layers.rho_depths, layers.rho,
    )  # fmt: skip
    return ocean_grid(frame, [Slot(*(f[:, None, None] for f in fields))])


class _OneWater(_Everywhere):
    temperature_c: Temperature = 15.0
    """In situ at the surface; the Conservative Temperature is the same at all depths."""
    salinity_psu: Salinity = 35.0
    """Practical salinity."""
    density_kg_m3: Annotated[float, Field(ge=900.0, le=1100.0)] | None = None
    """Constant density instead of TEOS-10's, as the paper has it."""

    def _layers(self) -> Stratification:
        where = (self.longitude_deg, self.latitude_deg)
        S_A = float(properties.absolute_salinity(self.salinity_psu, 0.0, *where))
        CT = float(properties.conservative_temperature(self.temperature_c, S_A, 0.0))
        given = np.zeros(0) if self.density_kg_m3 is None else np.full(1, self.density_kg_m3)
        depths = self._levels()
        return Stratification(
            depths, np.full(depths.size, S_A), np.full(depths.size, CT), self.latitude_deg, np.zeros(given.size), given,
            "uniform",
        )  # fmt: skip

    def _levels(self) -> Array:
        """So close that the in-situ temperature, which compression raises, is linear between to 0.001 deg C."""
        return np.linspace(0.0, self._depth(), 2 + int(self._depth() / 250.0))


class Still(_OneWater):
    """Uniform water at rest."""


class Uniform(_OneWater):
    """Uniform water in a uniform steady current."""

    current_east_m_s: Speed = 0.2
    current_north_m_s: Speed = 0.0

    def _current(self, z: Array) -> tuple[Array, Array]:
        return np.full_like(z, self.current_east_m_s), np.full_like(z, self.current_north_m_s)


class Shear(_OneWater):
    """Uniform water in a current that changes linearly with depth, down to a depth of its own."""

    surface_east_m_s: Speed = 0.4
    surface_north_m_s: Speed = 0.0
    deep_east_m_s: Speed = 0.0
    deep_north_m_s: Speed = 0.0
    sheared_depth_m: Depth = 200.0
    """From the surface to here the current changes; below it is constant."""

    @model_validator(mode="after")
    def _above_bottom(self) -> "Shear":
        if self.sheared_depth_m >= self._depth():
            raise ValueError(f"sheared_depth_m = {self.sheared_depth_m:g}: must be above {self._depth():g} m")
        return self

    def _levels(self) -> Array:
        return np.unique([self.sheared_depth_m, *super()._levels()])

    def _current(self, z: Array) -> tuple[Array, Array]:
        share = np.minimum(z / self.sheared_depth_m, 1.0)
        return (
            self.surface_east_m_s + share * (self.deep_east_m_s - self.surface_east_m_s),
            self.surface_north_m_s + share * (self.deep_north_m_s - self.surface_north_m_s),
        )


class Tide(_OneWater):
    """Uniform water in a current that runs around an ellipse, the same at all depths."""

    semi_major_m_s: Annotated[float, Field(ge=0.0, le=5.0)] = 0.3
    semi_minor_m_s: Speed = 0.1
    """Positive: the current turns counterclockwise, seen from above."""
    inclination_deg: Angle = 30.0
    """Of the major axis, counterclockwise from east."""
    phase_deg: Angle = 0.0
    """The current is greatest this long, in degrees of the period, after 1970-01-01T00:00 UTC."""
    period_hours: Annotated[float, Field(gt=0.1, le=10000.0)] = M2_PERIOD_H
    mean_east_m_s: Speed = 0.0
    mean_north_m_s: Speed = 0.0

    def _current(self, z: Array) -> tuple[Array, Array]:
        return np.full_like(z, self.mean_east_m_s), np.full_like(z, self.mean_north_m_s)

    def _tide(self) -> tuple[Array, Array]:
        ellipse = tidal_ellipse(self.semi_major_m_s, self.semi_minor_m_s, self.inclination_deg, self.phase_deg)
        return np.array([2.0 * np.pi / (3600.0 * self.period_hours)]), ellipse[None, :]


def tidal_ellipse(semi_major: float, semi_minor: float, inclination_deg: float, phase_deg: float) -> Array:
    """East cos, east sin, north cos, north sin of a current ellipse."""
    i, g = np.radians(inclination_deg), np.radians(phase_deg)
    # along the axes: major cos(wt - g), minor sin(wt - g)
    major, minor = semi_major * np.array([np.cos(g), np.sin(g)]), semi_minor * np.array([-np.sin(g), np.cos(g)])
    return np.concatenate([np.cos(i) * major - np.sin(i) * minor, np.sin(i) * major + np.cos(i) * minor])


class TwoLayer(_Everywhere):
    """A warm layer over a cold one, each with its current, and a thin interface between."""

    upper_temperature_c: Temperature = 25.0
    lower_temperature_c: Temperature = 10.0
    upper_salinity_psu: Salinity = 33.5
    lower_salinity_psu: Salinity = 34.5
    interface_m: Depth = 40.0
    thickness_m: Annotated[float, Field(gt=0.1, le=1000.0)] = 5.0
    """Scale of the hyperbolic tangent from layer to layer."""
    upper_east_m_s: Speed = 0.0
    lower_east_m_s: Speed = 0.0
    upper_north_m_s: Speed = 0.0
    lower_north_m_s: Speed = 0.0

    def _layers(self) -> Stratification:
        where = (self.longitude_deg, self.latitude_deg)
        salt = [float(properties.absolute_salinity(s, 0.0, *where)) for s in self._salinities()]
        heat = [
            float(properties.conservative_temperature(t, s, 0.0))
            for t, s in zip((self.upper_temperature_c, self.lower_temperature_c), salt, strict=True)
        ]
        return two_layer((salt[0], salt[1]), (heat[0], heat[1]), self.interface_m, self.thickness_m, self._depth())

    def _salinities(self) -> tuple[float, float]:
        return self.upper_salinity_psu, self.lower_salinity_psu

    def _current(self, z: Array) -> tuple[Array, Array]:
        share = 0.5 * (1.0 + np.tanh((z - self.interface_m) / self.thickness_m))
        return (
            self.upper_east_m_s + share * (self.lower_east_m_s - self.upper_east_m_s),
            self.upper_north_m_s + share * (self.lower_north_m_s - self.upper_north_m_s),
        )


class SouthChinaSea(_Everywhere):
    """Water at rest whose density is the South China Sea polynomial; temperature and salinity are assumed."""

    latitude_deg: Latitude = 18.0
    longitude_deg: Longitude = 115.0
    conservative_temperature_c: Temperature = 15.0
    absolute_salinity_g_kg: Salinity = 35.0

    def _layers(self) -> Stratification:
        return south_china_sea(min(self._depth(), 3000.0), self.conservative_temperature_c, self.absolute_salinity_g_kg)

    def notes(self) -> dict[str, str]:
        """What was assumed."""
        return super().notes() | {"temperature, salinity": "assumption: the source gives the density alone"}


class Pool(_OneWater):
    """Fresh water at rest, 3.5 m deep, as in the pool trials of section 5.2 of the paper."""

    bottom_m: Depth | None = 3.5
    temperature_c: Temperature = 20.0
    salinity_psu: Salinity = 0.0
    latitude_deg: Latitude = 30.26
    longitude_deg: Longitude = 120.12

    def notes(self) -> dict[str, str]:
        """What was assumed."""
        return super().notes() | {
            "depth": "Fan et al. (2013), section 5.2",
            "temperature": "assumption",
            "place": "assumption: Hangzhou, where the paper's laboratory is",
        }
