"""Depth of the sea floor: found, its sign settled, and told where it is not known."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from stommel.ocean.reading.axes import time_dimension
from stommel.ocean.reading.horizontal import read_nodes
from stommel.ocean.reading.series import Layout, read_box, same_nodes
from stommel.ocean.reading.tally import share
from stommel.ocean.reading.variables import File

Array = NDArray[np.float64]
Indices = NDArray[np.intp]

NOT_GIVEN = "the deepest level with water"
_UPWARD = ("altitude", "height", "elevation")
"""Words of standard names that count upward."""
_LIKELY = ("bathy", "deptho", "elevation", "topo", "seafloor", "sea_floor", "bottom_depth", "mbathy", "h")
"""How variables are often called that hold it, without a standard name."""


def read_sea_floor(
    files: Sequence[File], first: Layout, wet: NDArray[np.bool_], box: tuple[Indices, Indices]
) -> tuple[Array | None, str]:
    """Depth of the sea floor at the chosen nodes [m, positive down], if a file has it, and what there is to say of it.

    Raises
    ------
    FileError
        It does not lie on the nodes of `first`, or its sign puts most nodes with water (`wet`) above the surface.
    """
    for file in files:
        name = file.find("bottom", needed=False)
        if name is not None:
            depth = _depth(file, name, _values(file, name, first, box), wet)
            return depth, name + _unknown_at(depth, wet)
    return None, NOT_GIVEN + _overlooked(files)


def _values(file: File, name: str, first: Layout, box: tuple[Indices, Indices]) -> Array:
    nodes = read_nodes(file, name, (), turned=False) if file is not first.file else first.nodes
    dims = {str(d) for d in file.data[name].dims if file.data.sizes[d] > 1 or d in (nodes.rows, nodes.columns)}
    wanted = {nodes.rows, nodes.columns} - {""}
    if dims - {time_dimension(file, name)} != wanted or not same_nodes(first.nodes, nodes):
        there = ", ".join(map(str, file.data[name].dims)) or "none"
        file.refuse(name, f"{name} has the dimensions {there}; must lie on the nodes of {first.label}")
    found = read_box(file, name, "length", file.data[name], (nodes.rows, nodes.columns), box)
    if not np.isfinite(found).any():
        file.refuse(name, f"{name} has no number at any of the nodes")
    return found


def _depth(file: File, name: str, values: Array, wet: NDArray[np.bool_]) -> Array:
    """Turn values downward: as the attribute `positive` or an upward standard name says, else as most nodes lie."""
    positive = str(file.data[name].attrs.get("positive", "")).strip().lower()
    standard = file.standard_name(name)
    upward = positive == "up" or (positive != "down" and any(word in standard for word in _UPWARD))
    at_sea = values[wet & np.isfinite(values) & (values != 0.0)]
    above = int((at_sea > 0.0).sum() if upward else (at_sea < 0.0).sum())
    most = above > 0.5 * at_sea.size
    if most and (upward or positive == "down"):
        said = f"positive = {positive!r}" if positive else f"the standard_name {standard}"
        file.refuse(
            name,
            f"{name} with {said} puts {share(above, at_sea.size)} of the nodes with water above the surface; "
            "its sign is wrong",
        )
    if most and standard:
        file.tally.add(name, f"above the surface by the standard_name {standard}: all were turned", above, at_sea.size)
    return -values if upward != most else values


def _unknown_at(depth: Array, wet: NDArray[np.bool_]) -> str:
    """Say where there is water and no depth below the surface."""
    unknown = int((wet & ~(depth > 0.0)).sum())
    where = f"at {unknown} of {int(wet.sum())} nodes with water ({share(unknown, int(wet.sum()))})"
    return f"; unknown {where}, and there {NOT_GIVEN}" if unknown else ""


def _overlooked(files: Sequence[File]) -> str:
    """Name a variable that looks like the sea floor and does not say so."""
    for file in files:
        for variable in map(str, file.data.data_vars):
            name = variable.lower()
            if file.data[variable].ndim >= 2 and any(
                (name.startswith(word) and len(word) > 1) or name == word for word in _LIKELY
            ):
                return f"; {variable} looks like the sea floor and has no standard_name: names, bottom = {variable!r}"
    return ""
