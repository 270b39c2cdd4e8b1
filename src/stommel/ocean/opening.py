"""Opening an ocean: which kind of file it is, and whether the options fit it."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from stommel.ocean.analytic.profile import read_profile_ocean
from stommel.ocean.answers import Region, Source, is_profile
from stommel.ocean.errors import UnknownOceanError
from stommel.ocean.kernel.grid import OceanGrid
from stommel.ocean.reading.netcdf import Reading, read_ocean
from stommel.ocean.reading.sources import paths_of
from stommel.ocean.times import Time


def open_ocean(
    source: Source,
    folder: Path | None,
    names: dict[str, str],
    units: dict[str, str],
    bounds: Region | None,
    between: tuple[Time, Time] | None,
    yearly: bool | None,
    parameters: Mapping[str, Any],
    *,
    at_rest: bool,
    mean_slot: bool,
    beyond: bool,
) -> tuple[str, OceanGrid, dict[str, str]]:
    """Name, grid and notes of an ocean; `Ocean.open` describes the arguments."""
    paths = paths_of(source, folder)
    if any(is_profile(path) for path in paths):
        if len(paths) > 1 or bounds or between or yearly or at_rest or units:
            raise UnknownOceanError(
                f"{paths[0]}: a profile is one file, without bounds, between, yearly, at_rest or units"
            )
        return str(paths[0]), *read_profile_ocean(paths[0], names, parameters)
    if parameters:
        raise UnknownOceanError(
            f"{paths[0]}: parameter {next(iter(parameters))}: only a profile or an analytic ocean has parameters"
        )
    data, notes = read_ocean(paths, Reading(names, units, bounds, between, yearly, at_rest, mean_slot, beyond))
    name = str(paths[0]) if len(paths) == 1 else f"{paths[0]} and {len(paths) - 1} more"
    return name, data, notes
