"""Oracles: means that a loop over the samples makes; properties of cells."""

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st

from stommel.data.gridding import section
from stommel.data.summaries import profile_summaries

BEGIN = 1_782_864_000.0


def made(rows: list[tuple[int, float, float]]) -> xr.Dataset:
    """Samples of (profile, depth, temperature), one a second."""
    number, depth, value = (np.array(column) for column in zip(*rows, strict=True))
    direction = np.where(number == 0, 0, np.where(number % 2, 1, -1)).astype(np.int8)
    return xr.Dataset(
        {
            "time": ("obs", BEGIN + np.arange(float(len(rows)))),
            "depth": ("obs", depth.astype(np.float64)),
            "temperature": ("obs", value.astype(np.float64)),
            "profile_number": ("obs", number.astype(np.int32)),
            "profile_direction": ("obs", direction),
            "latitude": ("obs", np.full(len(rows), 28.0)),
            "longitude": ("obs", np.linspace(126.0, 127.0, len(rows))),
        }
    )


samples = st.lists(
    st.tuples(st.integers(0, 5), st.floats(-1.0, 50.0), st.one_of(st.just(float("nan")), st.floats(-2.0, 30.0))),
    min_size=1,
    max_size=60,
)


@given(samples, st.sampled_from([0.5, 1.0, 7.0]))
def test_each_cell_is_the_mean_of_its_samples(rows: list[tuple[int, float, float]], cell: float) -> None:
    grid = section(made(rows), "temperature", cell_m=cell)
    profiles = sorted({number for number, _, _ in rows if number})
    assert grid["profile_number"].values.tolist() == profiles
    for i, number in enumerate(profiles):
        for j in range(grid.sizes["depth"]):
            inside = [v for n, z, v in rows if n == number and np.floor(z / cell) == j and not np.isnan(v)]
            assert grid["samples_in_cell"].values[i, j] == len(inside)
            if inside:
                assert grid["temperature"].values[i, j] == pytest.approx(np.mean(inside))
            else:
                assert np.isnan(grid["temperature"].values[i, j])


@given(samples)
def test_no_sample_is_lost_or_counted_twice(rows: list[tuple[int, float, float]]) -> None:
    grid = section(made(rows), "temperature", cell_m=0.5, deepest_m=51.0)
    used = [v for n, z, v in rows if n and z >= 0.0 and not np.isnan(v)]
    assert grid["samples_in_cell"].values.sum() == len(used)
    assert np.nansum(grid["temperature"].values * grid["samples_in_cell"].values) == pytest.approx(sum(used), abs=1e-6)


@pytest.mark.parametrize("cell", [0.0, 0.05, 101.0, float("nan")])
def test_an_impossible_cell_is_refused(cell: float) -> None:
    with pytest.raises(ValueError, match="cell"):
        section(made([(1, 1.0, 2.0)]), "temperature", cell_m=cell)


def test_too_many_cells_are_refused() -> None:
    with pytest.raises(ValueError, match="larger cells"):
        section(made([(n, 1.0, 2.0) for n in range(1, 50)]), "temperature", cell_m=0.1, deepest_m=11_000.0)


def test_a_profile_over_the_date_line_lies_upon_it() -> None:
    samples = made([(1, 1.0, 20.0), (1, 2.0, 20.0), (2, 3.0, 20.0), (2, 2.0, 20.0)])
    samples["longitude"] = ("obs", np.array([179.99, -179.98, -179.98, np.nan]))
    assert section(samples, "temperature")["longitude"].values == pytest.approx([-179.995, -179.98])
    assert [row.longitude for row in profile_summaries(samples)] == pytest.approx([-179.995, -179.98])


def test_summaries_tell_when_where_and_how_deep() -> None:
    rows = [(0, 0.0, 20.0), (1, 1.0, 20.0), (1, 30.0, 12.0), (0, 31.0, 11.0), (2, 29.0, 12.0), (2, 2.0, 19.0)]
    first, second = profile_summaries(made(rows))
    assert (first.number, first.direction, first.begin, first.end) == (1, 1, BEGIN + 1, BEGIN + 2)
    assert (first.least_depth_m, first.greatest_depth_m, first.samples) == (1.0, 30.0, 2)
    assert (second.direction, second.latitude) == (-1, 28.0)
    assert second.longitude == pytest.approx(126.9)
