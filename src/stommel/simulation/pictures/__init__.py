"""Pictures of a flown mission, from its Dataset: each function returns a matplotlib `Figure`; one makes a web page."""

from pathlib import Path
from typing import TYPE_CHECKING

from stommel.simulation.pictures.actuators_figure import actuators_figure
from stommel.simulation.pictures.ctd_figure import ctd_figure
from stommel.simulation.pictures.energy_figure import energy_figure
from stommel.simulation.pictures.map_figure import map_figure
from stommel.simulation.pictures.page import interactive_page
from stommel.simulation.pictures.sawtooth_figure import sawtooth_figure
from stommel.simulation.pictures.trial_figure import trial_figure

if TYPE_CHECKING:
    import xarray as xr

    from stommel.ocean import Ocean

__all__ = [
    "actuators_figure",
    "ctd_figure",
    "energy_figure",
    "interactive_page",
    "map_figure",
    "save_pictures",
    "sawtooth_figure",
    "trial_figure",
]


def save_pictures(dataset: "xr.Dataset", folder: Path, ocean: "Ocean | None" = None) -> list[Path]:
    """Write all pictures of a mission into a folder, as PNG and SVG, and the interactive page; return their paths.

    Raises
    ------
    OutputError
        A file cannot be written; none is left half-written.
    """
    from stommel.figures.saving import save_figure  # noqa: PLC0415 - start-up counts
    from stommel.files.whole import write_whole  # noqa: PLC0415

    figures = {
        "trial": trial_figure(dataset),
        "sawtooth": sawtooth_figure(dataset),
        "map": map_figure(dataset, ocean),
        "energy": energy_figure(dataset),
        "actuators": actuators_figure(dataset),
        "ctd": ctd_figure(dataset),
    }
    written = [path for name, figure in figures.items() for path in save_figure(figure, folder / name)]
    page = folder / "mission.html"
    write_whole(page, interactive_page(dataset))
    return [*written, page]
