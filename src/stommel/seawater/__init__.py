"""Seawater by TEOS-10: density, sound speed, freezing, pressure, stratification, tables for compiled code."""

from stommel.seawater.profile_file import read_stratification
from stommel.seawater.properties import (
    SeawaterRangeError,
    absolute_salinity,
    conservative_from_potential,
    conservative_temperature,
    density,
    depth_from_pressure,
    freezing_temperature,
    in_situ_temperature,
    pressure_from_depth,
    sound_speed,
)
from stommel.seawater.stratification import Stratification, StratificationError
from stommel.seawater.table import (
    DensityTable,
    DensityTableError,
    SeawaterTable,
    density_table,
    freezing_table,
    sound_speed_table,
)

__all__ = [
    "DensityTable",
    "DensityTableError",
    "SeawaterRangeError",
    "SeawaterTable",
    "Stratification",
    "StratificationError",
    "absolute_salinity",
    "conservative_from_potential",
    "conservative_temperature",
    "density",
    "density_table",
    "depth_from_pressure",
    "freezing_table",
    "freezing_temperature",
    "in_situ_temperature",
    "pressure_from_depth",
    "read_stratification",
    "sound_speed",
    "sound_speed_table",
]
