"""The ocean around a mission: temperature, salinity, currents and bottom depth in space and time.

Compiled code uses `stommel.ocean.kernel.grid` and `stommel.ocean.kernel.column`.
"""

from stommel.ocean.answers import Sample
from stommel.ocean.errors import BelowBottomError, LandError, OutsideOceanError, UnknownOceanError
from stommel.ocean.ocean import Ocean

__all__ = ["BelowBottomError", "LandError", "Ocean", "OutsideOceanError", "Sample", "UnknownOceanError"]
