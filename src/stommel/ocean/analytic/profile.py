"""An ocean from one measured or assumed profile: the same layers everywhere, in a steady current."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from stommel.ocean.analytic.everywhere import Parameters, Speed, made, single_node
from stommel.ocean.kernel.grid import OceanGrid
from stommel.seawater.profile_file import read_stratification


class ProfileOcean(Parameters):
    """The layers of a profile file, the same everywhere, in a steady current."""

    current_east_m_s: Speed = 0.0
    current_north_m_s: Speed = 0.0


def read_profile_ocean(
    path: Path, columns: Mapping[str, str], parameters: Mapping[str, Any]
) -> tuple[OceanGrid, dict[str, str]]:
    """Grid and notes of the ocean of a profile file; `Ocean.open` describes the arguments."""
    choice: ProfileOcean = made(ProfileOcean, str(path), parameters)
    layers = read_stratification(path, columns, latitude=choice.latitude_deg, longitude=choice.longitude_deg)
    still = np.ones(layers.depths.size)
    current = still * choice.current_east_m_s, still * choice.current_north_m_s
    grid = single_node(layers, choice, current, (np.zeros(0), np.zeros((0, 4))))
    notes = {
        "kind": "the profile of the file, the same everywhere and always",
        "current": "uniform and steady, as given",
        "below": f"the values at {layers.depths[-1]:g} m are carried on",
    }
    if layers.depths[0] > 0.0:
        notes["above"] = f"the values at {layers.depths[0]:g} m are carried up to the surface"
    if "latitude_deg" not in parameters or "longitude_deg" not in parameters:
        notes["place"] = (
            f"assumption: latitude {choice.latitude_deg:g}, longitude {choice.longitude_deg:g}, for gravity"
        )
    return grid, notes
