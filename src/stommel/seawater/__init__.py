"""Seawater by TEOS-10: density, sound speed, freezing, pressure, stratification, tables for compiled code.

Names are imported when they are first used: the equations of motion need none of what is slow to import (gsw).
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

_WHERE = {
    "DensityTable": "table",
    "DensityTableError": "table",
    "SeawaterRangeError": "properties",
    "SeawaterTable": "table",
    "Stratification": "stratification",
    "StratificationError": "stratification",
    "absolute_salinity": "properties",
    "conservative_from_potential": "properties",
    "conservative_temperature": "properties",
    "density": "properties",
    "density_table": "table",
    "depth_from_pressure": "properties",
    "freezing_table": "table",
    "freezing_temperature": "properties",
    "in_situ_temperature": "properties",
    "pressure_from_depth": "properties",
    "read_stratification": "profile_file",
    "sound_speed": "properties",
    "sound_speed_table": "table",
}

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

if TYPE_CHECKING:
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


def __getattr__(name: str) -> Any:
    if name not in _WHERE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_WHERE[name]}"), name)
