"""The East China Sea in summer, idealised: shelf, slope and trough, a jet along the shelf break, the tide M2.

The sea for which the paper's glider is meant. It is uniform along a line to the north-east; d is the distance across
it, positive offshore. Each number is a parameter; `SOURCES` says where it comes from.
"""

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from stommel.ocean.analytic.everywhere import (
    M2_PERIOD_H,
    Angle,
    Latitude,
    Longitude,
    Parameters,
    Speed,
    Temperature,
    tidal_ellipse,
)
from stommel.ocean.analytic.regional import rectangle
from stommel.ocean.kernel.building import Frame, Slot, ocean_grid
from stommel.ocean.kernel.grid import OceanGrid
from stommel.seawater import properties

Array = NDArray[np.float64]

_ALONG = np.linspace(-300e3, 300e3, 31)
_ACROSS = np.linspace(-250e3, 200e3, 91)
_LEVELS = np.concatenate([np.arange(0.0, 100.0, 5.0), np.arange(100.0, 300.0, 20.0), np.arange(300.0, 1501.0, 100.0)])
_LONGEST_M = 50e3
"""Scale over which the thermocline deepens across the jet [m]."""

_ASSUMED = "assumption, of the usual size in this sea"
SOURCES = {
    "transport_sv": "mean net absolute transport of the Kuroshio north of Okinawa, December 2002 to November 2004: "
    "18.5 +- 0.8 Sv (M. Andres, seminar abstract, Woods Hole Oceanographic Institution)",
    "jet along the shelf break": "Hsueh (2000), The Kuroshio in the East China Sea, J. Marine Systems, 131-139",
    "period of M2": "28.9841042 degrees an hour, from astronomy",
    "M2 the same at all depths": "current meters at 26 deg 30.052' N, 122 deg 35.998' E: the barotropic mode has at "
    "least 90 % of the variance of the tide (published abstract; project 2007CB411807)",
    "jet_width_km, jet_offset_km, jet_depth_m, jet_bearing_deg": _ASSUMED,
    "shelf_depth_m, trough_depth_m, slope_width_km": _ASSUMED,
    "tide_semi_major_m_s and the other numbers of the ellipse": _ASSUMED + "; its transport is the same everywhere",
    "temperatures, salinities, thermocline": _ASSUMED + "; not in thermal-wind balance with the jet",
}
"""Where each number comes from."""


class EastChinaSea(Parameters):
    """East China Sea in summer: a jet along the shelf break, the tide M2, a sharp thermocline, a shelf and a trough."""

    latitude_deg: Latitude = 28.2
    """Middle of the shelf break."""
    longitude_deg: Longitude = 126.6
    jet_bearing_deg: Angle = 45.0
    transport_sv: Annotated[float, Field(ge=0.0, le=60.0)] = 18.5
    jet_width_km: Annotated[float, Field(ge=10.0, le=100.0)] = 45.0
    """Scale of exp(-(d - d0)^2 / width^2)."""
    jet_offset_km: Annotated[float, Field(ge=-50.0, le=100.0)] = 25.0
    """Its axis, offshore of the shelf break."""
    jet_depth_m: Annotated[float, Field(ge=50.0, le=2000.0)] = 300.0
    """Scale of exp(-z / depth)."""
    shelf_depth_m: Annotated[float, Field(ge=20.0, le=400.0)] = 100.0
    trough_depth_m: Annotated[float, Field(ge=500.0, le=1500.0)] = 1200.0
    slope_width_km: Annotated[float, Field(ge=10.0, le=100.0)] = 25.0
    tide_semi_major_m_s: Annotated[float, Field(ge=0.0, le=2.0)] = 0.35
    """On the shelf."""
    tide_semi_minor_m_s: Speed = -0.20
    """Negative: clockwise, seen from above."""
    tide_inclination_deg: Angle = 135.0
    tide_phase_deg: Angle = 0.0
    surface_temperature_c: Temperature = 28.0
    shelf_bottom_temperature_c: Temperature = 17.0
    """Below the thermocline on the shelf."""
    deep_temperature_c: Temperature = 4.5
    surface_salinity_psu: Annotated[float, Field(ge=25.0, le=36.0)] = 33.8
    deep_salinity_psu: Annotated[float, Field(ge=33.0, le=36.0)] = 34.4
    thermocline_m: Annotated[float, Field(ge=5.0, le=100.0)] = 30.0
    """Depth of the seasonal thermocline on the shelf."""

    def notes(self) -> dict[str, str]:
        """Where each number comes from."""
        return super().notes() | SOURCES

    def bottom(self, d: Array) -> Array:
        """Depth of the bottom at distance `d` from the shelf break [m]."""
        rise = 0.5 * (1.0 + np.tanh((d - 25e3) / (self.slope_width_km * 1e3)))
        shelf = self.shelf_depth_m * np.clip(1.0 + 0.5 * d / 250e3, 0.5, 1.0)
        return np.asarray(shelf + (self.trough_depth_m - self.shelf_depth_m) * rise)

    def jet_speed(self, d: Array, z: Array) -> Array:
        """Speed of the jet [m/s]: its product with area, summed over the section, is the transport."""
        fine = np.linspace(_ACROSS[0], _ACROSS[-1], 9001)
        depth = self.jet_depth_m
        section = self._jet_shape(fine) * depth * (1.0 - np.exp(-self.bottom(fine) / depth))
        surface = self.transport_sv * 1e6 / np.trapezoid(section, fine)
        return np.asarray(surface * self._jet_shape(d) * np.exp(-z / depth))

    def _jet_shape(self, d: Array) -> Array:
        return np.asarray(np.exp(-(((d - self.jet_offset_km * 1e3) / (self.jet_width_km * 1e3)) ** 2)))

    def water(self, d: Array, z: Array) -> tuple[Array, Array]:
        """Potential temperature [deg C] and practical salinity.

        A seasonal thermocline over a main one that deepens offshore across the jet.
        """
        seasonal = 0.5 * (1.0 + np.tanh((z - self.thermocline_m) / 12.0))
        main_depth = 200.0 + 120.0 * np.tanh((d - self.jet_offset_km * 1e3) / _LONGEST_M)
        main = 1.0 - np.exp(-np.maximum(z - self.thermocline_m, 0.0) / (2.0 * main_depth))
        below = self.shelf_bottom_temperature_c + 4.0 * 0.5 * (1.0 + np.tanh(d / _LONGEST_M))
        theta = self.surface_temperature_c + seasonal * (below - self.surface_temperature_c)
        theta = theta + main * (self.deep_temperature_c - below)
        # the salinity maximum of the Kuroshio's subsurface water, about 34.8 at 150 m
        salt = self.surface_salinity_psu + seasonal * (self.deep_salinity_psu - self.surface_salinity_psu)
        return theta, salt + 0.4 * np.exp(-(((z - 150.0) / 100.0) ** 2)) * 0.5 * (1.0 + np.tanh(d / _LONGEST_M))

    def grid(self) -> OceanGrid:
        """Grid of 5 km across and 20 km along, 43 levels."""
        latitude, longitude, _ = rectangle(self.latitude_deg, self.longitude_deg, self.jet_bearing_deg, _ACROSS, _ALONG)
        bottom = self.bottom(_ACROSS) if self.bottom_m is None else np.full(_ACROSS.shape, self.bottom_m)
        z, d = np.meshgrid(_LEVELS, _ACROSS, indexing="ij")
        theta, salt = self.water(d, z)
        p = properties.pressure_from_depth(z, self.latitude_deg)
        S_A = properties.absolute_salinity(salt, p, self.longitude_deg, self.latitude_deg)
        CT = properties.conservative_from_potential(theta, S_A)
        speed, course = self.jet_speed(d, z), np.radians(self.jet_bearing_deg)
        fields = (properties.in_situ_temperature(CT, S_A, p), S_A, CT, speed * np.sin(course), speed * np.cos(course))
        # a level beyond the bottom keeps the water of the first one below it, so that the bottom is within the levels
        wet = np.concatenate([np.ones((1, d.shape[1]), dtype=bool), _LEVELS[:-1, None] < bottom[None, :]])
        alike = (len(_LEVELS), len(_ALONG), len(_ACROSS))
        slot = Slot(*(np.broadcast_to(np.where(wet, f, np.nan)[:, None, :], alike) for f in fields))
        tide = self.tide(bottom)[None, None] * np.ones((1, len(_ALONG), 1, 1))
        frame = Frame(
            np.zeros(1), (-np.inf, np.inf), _LEVELS, latitude, longitude,
            np.broadcast_to(bottom, latitude.shape).copy(), np.array([2.0 * np.pi / (3600.0 * M2_PERIOD_H)]), tide,
        )  # fmt: skip
        return ocean_grid(frame, [slot])

    def tide(self, bottom: Array) -> Array:
        """East cos, east sin, north cos, north sin where the bottom is so deep (nodes, 4) [m/s]."""
        ellipse = tidal_ellipse(
            self.tide_semi_major_m_s, self.tide_semi_minor_m_s, self.tide_inclination_deg, self.tide_phase_deg
        )
        return np.asarray((self.shelf_depth_m / bottom)[:, None] * ellipse)
