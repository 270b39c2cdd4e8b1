"""A quantity over time, in one file or several: which file has it when, and where its levels and nodes lie there."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import TypeAlias

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stommel.ocean import times as clock
from stommel.ocean.reading.axes import depth_dimension, read_depths, read_times, time_dimension
from stommel.ocean.reading.horizontal import Nodes, read_nodes
from stommel.ocean.reading.variables import File

Array = NDArray[np.float64]
Indices = NDArray[np.intp]

_NODE_TOLERANCE = 2e-6
"""Nodes of two files closer than this are the same: 13 m, more than single precision loses [rad]."""
_DEPTH_TOLERANCE = 1e-3
"""The same of levels [m]."""


@dataclass(frozen=True)
class Layout:
    """Where the numbers of one variable of one file lie."""

    file: File
    variable: str
    time: str | None
    depth: str
    depths: Array
    """[m], positive down, increasing."""
    order: Indices
    """Of the file's levels that makes them so."""
    nodes: Nodes

    @property
    def label(self) -> str:
        """Variable and file, for messages."""
        return f"{self.variable} of {self.file.name}"


Layouts: TypeAlias = dict[tuple[str, frozenset[str], bool], Layout]
"""Layouts by file, dimensions, and whether the angle is known."""


def layout_of(file: File, variable: str, known: Layouts, *, turned: bool) -> Layout:
    """Read times' dimension, levels and nodes of a variable; with `turned`, also the angle of its axes.

    Variables of one file with the same dimensions share them: they are read once and kept in `known`.
    """
    key = file.name, frozenset(map(str, file.data[variable].dims)), turned
    if key not in known:
        known[key] = _read_layout(file, variable, turned=turned)
    return replace(known[key], variable=variable)


def _read_layout(file: File, variable: str, *, turned: bool) -> Layout:
    time, depth = time_dimension(file, variable), depth_dimension(file, variable)
    depths, order = read_depths(file, depth)
    nodes = read_nodes(file, variable, tuple(d for d in (time, depth) if d), turned=turned)
    return Layout(file, variable, time, depth, depths, order, nodes)


def check_same_places(first: Layout, other: Layout) -> None:
    """Refuse a variable whose levels or nodes are not those of another."""
    if first.depths.shape != other.depths.shape or not np.allclose(
        first.depths, other.depths, rtol=1e-5, atol=_DEPTH_TOLERANCE
    ):
        other.file.refuse(
            other.variable,
            f"{other.variable} has {len(other.depths)} levels to {other.depths[-1]:g} m, {first.label} has "
            f"{len(first.depths)} to {first.depths[-1]:g} m; all must lie on the same levels",
        )
    if not same_nodes(first.nodes, other.nodes):
        here, there = (" x ".join(map(str, layout.nodes.latitude.shape)) for layout in (other, first))
        other.file.refuse(
            other.variable,
            f"{other.variable} does not lie on the nodes of {first.label} ({here} and {there}); interpolate a "
            "staggered grid to one set of nodes first",
        )


def same_nodes(first: Nodes, other: Nodes) -> bool:
    """Whether two grids are the same; longitudes may differ by whole turns."""
    if first is other:
        return True
    if first.latitude.shape != other.latitude.shape:
        return False
    holes = np.isnan(first.latitude) | np.isnan(first.longitude)
    if not np.array_equal(holes, np.isnan(other.latitude) | np.isnan(other.longitude)):
        return False
    around = (first.longitude - other.longitude + np.pi) % (2.0 * np.pi) - np.pi
    apart = np.maximum(np.abs(first.latitude - other.latitude), np.abs(around) * np.cos(first.latitude))
    return bool(np.all(apart[~holes] < _NODE_TOLERANCE))


@dataclass(frozen=True)
class Series:
    """One quantity at all of its times."""

    what: str
    times: Array
    """[s since 1970-01-01 UTC]; zero where nothing depends on time."""
    spoken_for: tuple[float, float]
    """First and last time that the values speak for [s]."""
    of_every_year: bool
    """A file says that it is a climatology."""
    places: Sequence[tuple[Layout, int]] = field(repr=False)
    """Layout and index in its file's time, for each time."""

    @property
    def first(self) -> Layout:
        """Layout at the first time."""
        return self.places[0][0]

    def read(self, n: int, quantity: str, j: Indices, i: Indices) -> Array:
        """Values at time `n` at rows `j` and columns `i` (level, j, i), in SI units; nan where there is no water."""
        layout, slot = self.places[n]
        found = numbers_at(layout, quantity, slot, j, i)
        if not np.isfinite(found).any():
            when = f" at {clock.text(float(self.times[n]))}" if layout.time is not None else ""
            said = layout.file.tally.told().get(layout.variable)
            why = "all values are missing" if said is None else f"all values are missing, {said}"
            layout.file.refuse(layout.variable, f"{layout.variable} has no number{when}: {why}")
        return found


def series_of(what: str, layouts: Sequence[Layout]) -> Series:
    """Join the files of one quantity in the order of their times."""
    if layouts[0].time is None:
        if len(layouts) > 1:
            layouts[1].file.refuse(what, f"{what} has no time in {layouts[0].file.name}, and is in this file too")
        return Series(what, np.zeros(1), (-np.inf, np.inf), False, [(layouts[0], 0)])
    entries: list[tuple[float, Layout, int]] = []
    spans, every_year = [], False
    for layout in layouts:
        if layout.time is None:
            layout.file.refuse(what, f"{layout.variable} has no time, and {layouts[0].label} has")
        found = read_times(layout.file, layout.time)
        entries += [(float(t), layout, slot) for slot, t in enumerate(found.seconds)]
        spans.append(found.spoken_for)
        every_year = every_year or found.of_every_year
    entries.sort(key=lambda entry: entry[0])
    for (a, before, _), (b, after, _) in pairwise(entries):
        if b - a <= 0.0:
            after.file.refuse(what, f"{after.variable} at {clock.text(b)} is in {before.file.name} too")
    times = np.array([entry[0] for entry in entries])
    spoken_for = min(span[0] for span in spans), max(span[1] for span in spans)
    return Series(what, times, spoken_for, every_year, [(layout, slot) for _, layout, slot in entries])


def check_same_times(first: Series, other: Series) -> None:
    """Refuse a quantity whose times are not those of another."""
    if len(first.times) == len(other.times) and np.allclose(first.times, other.times, rtol=0.0, atol=0.5):
        return
    lonely = set(np.round(first.times)) ^ set(np.round(other.times))
    example = clock.text(min(lonely)) if lonely else ""
    other.first.file.refuse(
        other.what,
        f"{other.what} and {first.what} must have the same times; only one of them has {example}",
    )


def numbers_at(layout: Layout, quantity: str, slot: int, j: Indices, i: Indices, *, top: bool = False) -> Array:
    """Read one time of a variable at rows and columns (level, j, i), or its top level; no more of the file is read."""
    nodes = layout.nodes
    array = layout.file.data[layout.variable]
    if layout.time is not None:
        array = array.isel({layout.time: slot})
    if top:
        array = array.isel({layout.depth: [int(layout.order[0])]})
    found = read_box(layout.file, layout.variable, quantity, array, (nodes.rows, nodes.columns), (j, i), layout.depth)
    return found if top else found[layout.order]


def read_box(
    file: File,
    variable: str,
    quantity: str,
    array: xr.DataArray,
    dims: tuple[str, str],
    box: tuple[Indices, Indices],
    level: str = "",
) -> Array:
    """Numbers of an array at rows and columns, with the dimensions (level, j, i) or (j, i); others are of size 1."""
    kept = [d for d in (level, *dims) if d]
    array = array.isel({str(d): 0 for d in array.dims if str(d) not in kept})
    parts = {d: _slice(index) for d, index in zip(dims, box, strict=True) if d}
    # stored order first: a transposed lazy array would be read element by element
    found = file.numbers(variable, quantity, array.isel(parts))
    stored = [str(d) for d in array.dims]
    found = np.transpose(found, [stored.index(d) for d in kept])
    lengths = [len(index) for index in box]
    return found.reshape(*([found.shape[0]] if level else []), *lengths)


def _slice(index: Indices) -> slice | Indices:
    """Return an index without gaps as a slice, which a file reads in one piece."""
    steady = index.size > 0 and np.array_equal(index, np.arange(index[0], index[0] + index.size))
    return slice(int(index[0]), int(index[0]) + index.size) if steady else index
