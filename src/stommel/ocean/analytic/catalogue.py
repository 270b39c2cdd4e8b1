"""Oceans in closed form, by name: for tests, for first missions, and for sea areas without a file."""

from collections.abc import Mapping
from typing import Any

from stommel.files.sentences import shown
from stommel.ocean.analytic.east_china_sea import EastChinaSea
from stommel.ocean.analytic.everywhere import (
    Pool,
    Shear,
    SouthChinaSea,
    Still,
    Tide,
    TwoLayer,
    Uniform,
    made,
)
from stommel.ocean.analytic.gyre import Gyre
from stommel.ocean.errors import UnknownOceanError
from stommel.ocean.kernel.grid import OceanGrid

ANALYTIC: dict[str, type[Any]] = {
    "still": Still,
    "uniform": Uniform,
    "shear": Shear,
    "tide": Tide,
    "gyre": Gyre,
    "two_layer": TwoLayer,
    "south_china_sea": SouthChinaSea,
    "east_china_sea": EastChinaSea,
    "pool": Pool,
}
"""Analytic oceans by name; the fields of each are its parameters, with the unit at the end of the name."""


def build_analytic(name: str, parameters: Mapping[str, Any]) -> tuple[OceanGrid, dict[str, str]]:
    """Grid and notes of an analytic ocean.

    Raises
    ------
    UnknownOceanError
        The name or a parameter is unknown, or a value is not allowed.
    """
    if name not in ANALYTIC:
        raise UnknownOceanError(f"ocean {shown(name)}: unknown analytic ocean; there are: {', '.join(ANALYTIC)}")
    ocean = made(ANALYTIC[name], f"ocean {name!r}", parameters)
    grid: OceanGrid = ocean.grid()
    return grid, dict(ocean.notes())
