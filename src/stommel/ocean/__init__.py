"""The ocean around a mission: temperature, salinity, currents and bottom depth in space and time.

Compiled code uses `stommel.ocean.grid` and `stommel.ocean.column`.
"""

from stommel.ocean.errors import BelowBottomError, LandError, OutsideOceanError, UnknownOceanError
from stommel.ocean.ocean import Ocean, Sample

__all__ = ["BelowBottomError", "LandError", "Ocean", "OutsideOceanError", "Sample", "UnknownOceanError"]
