"""The sign of the sea floor: by `positive`, by the standard name, by most of the nodes with water; never in silence."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import xarray as xr

from stommel.ocean import Ocean
from tests.ocean.conftest import Writer
from tests.ocean.test_damaged_files import refused


def floor(values: Callable[[Any], Any], **attributes: str | None) -> Callable[[xr.Dataset], None]:
    """Change the numbers and the attributes of the sea floor; None takes one away."""

    def change(data: xr.Dataset) -> None:
        attrs = {key: value for key, value in (data.deptho.attrs | attributes).items() if value is not None}
        data["deptho"] = (data.deptho.dims, values(data.deptho.values), attrs)

    return change


def depth(values: Any) -> Any:
    return values


def elevation(values: Any) -> Any:
    """Negative in the sea, and land above it, as GEBCO and ETOPO have it."""
    return np.where(np.isnan(values), 250.0, -values)


@pytest.mark.parametrize(
    ("change", "names"),
    [
        (floor(depth), {}),
        (floor(depth, positive="down"), {}),
        (floor(elevation, positive="up"), {}),
        (floor(elevation, positive="up", standard_name=None), {"bottom": "deptho"}),
        (floor(elevation, standard_name="height_above_mean_sea_level"), {"bottom": "deptho"}),
        (floor(elevation, standard_name="bedrock_altitude"), {"bottom": "deptho"}),
        (floor(elevation, standard_name=None), {"bottom": "deptho"}),
        (floor(elevation), {}),
    ],
)
def test_every_way_to_write_the_same_floor(sea_file: Writer, change: Any, names: dict[str, str]) -> None:
    ocean = Ocean.open(sea_file(change), names=names)
    assert ocean.bottom_depth(12.0, 179.0) == pytest.approx(400.0)
    assert ocean.bottom_depth(14.0, -178.0) == pytest.approx(120.0)
    assert ocean.is_land(10.0, 177.0)


def test_a_floor_turned_against_its_standard_name_is_told(sea_file: Writer) -> None:
    note = Ocean.open(sea_file(floor(elevation))).notes["numbers of deptho"]
    assert "all were turned" in note
    assert "sea_floor_depth_below_geoid" in note


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (floor(depth, positive="up"), "positive = 'up'"),
        (floor(elevation, positive="down"), "positive = 'down'"),
        (floor(depth, standard_name="bedrock_altitude"), "the standard_name bedrock_altitude"),
    ],
)
def test_a_sign_that_most_nodes_deny_is_refused(sea_file: Writer, change: Any, said: str) -> None:
    refused(sea_file(change), f"deptho with {said} puts 1e+02 % of the nodes with water", names={"bottom": "deptho"})


def test_where_the_floor_is_not_known_is_told(sea_file: Writer) -> None:
    def change(data: xr.Dataset) -> None:
        data.deptho.values[3, 3:5] = [-2.0, np.nan]

    ocean = Ocean.open(sea_file(change))
    assert ocean.notes["bottom"].startswith("deptho; unknown at 2 of 26 nodes with water (7.7 %)")
    assert ocean.bottom_depth(13.0, -180.0) == pytest.approx(200.0)


def test_a_floor_without_a_standard_name_is_not_overlooked(sea_file: Writer) -> None:
    note = Ocean.open(sea_file(floor(depth, standard_name=None))).notes["bottom"]
    assert note == (
        "the deepest level with water; deptho looks like the sea floor and has no standard_name: names, "
        "bottom = 'deptho'"
    )
