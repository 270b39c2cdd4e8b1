"""What an ocean answers: the water at one point, or why there is none."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import isinf
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stommel.errors import StommelError
from stommel.ocean import times
from stommel.ocean.errors import BelowBottomError, LandError, OutsideOceanError
from stommel.ocean.kernel.grid import (
    CLIMATOLOGY,
    CT_ROW,
    EAST,
    EAST_ACCELERATION,
    LAND,
    NORTH,
    NORTH_ACCELERATION,
    OUTSIDE_TIME,
    RHO,
    SALINITY,
    TEMPERATURE,
    UNBOUNDED_DEPTH,
    OceanGrid,
    P,
)
from stommel.ocean.kernel.weight import PASCAL_PER_DECIBAR
from stommel.ocean.summary import extent_of
from stommel.seawater import properties

DEEPEST = 11300.0
"""Deepest question that is answered; the pressure there is still within TEOS-10 [m]."""

Source: TypeAlias = str | Path | Sequence[str | Path]
"""A file, a pattern like `sea_2016*.nc`, or several of both."""
Region: TypeAlias = tuple[float, float, float, float]
"""South, north, west, east [deg]."""


def is_profile(source: "Source | None") -> bool:
    """Whether a source is one profile file: its name ends in .csv."""
    return isinstance(source, str | Path) and Path(source).suffix.lower() == ".csv"


@dataclass(frozen=True)
class Sample:
    """The water at one point; SI units unless noted."""

    density: float
    """[kg/m3]"""
    pressure: float
    """Gauge pressure [Pa]."""
    temperature: float
    """In-situ temperature [deg C]."""
    conservative_temperature: float
    """[deg C]"""
    absolute_salinity: float
    """[g/kg]"""
    current_north: float
    """[m/s]"""
    current_east: float
    """[m/s]"""
    acceleration_north: float
    """Of the water, DU/Dt [m/s2]."""
    acceleration_east: float
    """[m/s2]"""
    sound_speed: float
    """[m/s]"""
    freezing_temperature: float
    """In situ, without dissolved air [deg C]."""
    bottom_depth: float
    """[m]; infinite where the ocean has no bottom."""
    held: bool
    """The point lies outside the data, and the ocean's policy answered."""

    def as_row(self) -> dict[str, Any]:
        """The water in words with units; no bottom where the ocean has none."""
        return {
            "density_kg_m3": self.density,
            "pressure_dbar": self.pressure / PASCAL_PER_DECIBAR,
            "temperature_c": self.temperature,
            "conservative_temperature_c": self.conservative_temperature,
            "absolute_salinity_g_kg": self.absolute_salinity,
            "sound_speed_m_s": self.sound_speed,
            "freezing_temperature_c": self.freezing_temperature,
            "current_east_m_s": self.current_east,
            "current_north_m_s": self.current_north,
            "bottom_m": None if isinf(self.bottom_depth) else self.bottom_depth,
            "held": self.held,
        }


def sample_of(row: NDArray[np.float64], bottom: float, *, held: bool) -> Sample:
    """Make the answer of one depth of a column."""
    S_A, CT, p = float(row[SALINITY]), float(row[CT_ROW]), float(row[P]) / PASCAL_PER_DECIBAR
    return Sample(
        density=float(row[RHO]),
        pressure=float(row[P]),
        temperature=float(row[TEMPERATURE]),
        conservative_temperature=CT,
        absolute_salinity=S_A,
        current_north=float(row[NORTH]),
        current_east=float(row[EAST]),
        acceleration_north=float(row[NORTH_ACCELERATION]),
        acceleration_east=float(row[EAST_ACCELERATION]),
        sound_speed=float(properties.sound_speed(S_A, CT, p)),
        freezing_temperature=float(properties.freezing_temperature(S_A, p)),
        bottom_depth=bottom if bottom < UNBOUNDED_DEPTH else float("inf"),
        held=held,
    )


def depth_refusal(name: str, depth: float, place: tuple[float, float], bottom: float) -> BelowBottomError:
    """Say why there is no water at a depth [m]."""
    if depth < 0.0:
        what = "above the surface"
    elif depth > bottom:
        what = f"below the bottom at {bottom:.6g} m"
    else:
        what = f"must be between 0 and {DEEPEST:g} m"
    return BelowBottomError(f"{name}: depth = {depth:g} m at {_place(place)}: {what}")


def refusal(name: str, data: OceanGrid, status: int, time: float, place: tuple[float, float]) -> StommelError:
    """Say why a column could not be filled."""
    if status == LAND:
        return LandError(f"{name}: {_place(place)} is on land")
    first, second = data, data._replace(nodes=data.behind)
    if status == OUTSIDE_TIME:
        policy, key = data.outside_time, "outside_time"
        where, covers = f"time {times.text(time)}", _times(first)
        behind = _times(second)
    else:
        policy, key = data.outside_space, "outside"
        where, covers = _place(place), _extent(first)
        behind = _extent(second)
    if policy == CLIMATOLOGY:
        return OutsideOceanError(
            f"{name}: {where} is outside the ocean, which has {covers}, and outside its climatology, which has {behind}"
        )
    return OutsideOceanError(
        f'{name}: {where} is outside the ocean, which has {covers}; {key} = "hold" or "climatology" allows it'
    )


def _times(data: OceanGrid) -> str:
    first, last = (times.text(float(t)) for t in data.nodes.time_range)
    return f"{first} to {last}"


def _extent(data: OceanGrid) -> str:
    extent: dict[str, Any] = extent_of(data)
    low, high = extent["latitude_deg"], extent["longitude_deg"]
    if low is None:
        return "all places"
    return f"latitude {low[0]:.4g} to {low[1]:.4g}, longitude {high[0]:.4g} to {high[1]:.4g}"


def _place(place: tuple[float, float]) -> str:
    return f"latitude {place[0]:g}, longitude {place[1]:g}"
