"""What the field itself shows to be no water: zeros that nothing marks. A single faulty node does not refuse a file."""

from collections.abc import Callable

import numpy as np
import pytest
import xarray as xr

from stommel.ocean import Ocean
from tests.ocean.conftest import Writer
from tests.ocean.test_damaged_files import refused

START = "2020-03-01T00:00:00Z"


def zeros_for_nothing(*names: str) -> Callable[[xr.Dataset], None]:
    def change(data: xr.Dataset) -> None:
        for name in names:
            data[name] = data[name].fillna(0.0).assign_attrs(data[name].attrs)

    return change


def test_land_of_zeros_is_refused(sea_file: Writer) -> None:
    """4 of 30 columns are land, and one has no water at the lowest level."""
    path = sea_file(zeros_for_nothing("to", "so", "uo", "vo"))
    refused(path, "so is 0 ", "% of its numbers", "_FillValue")


def test_land_of_zeros_in_salt_alone_stays_land(sea_file: Writer) -> None:
    """Where one field marks it, the others need not."""
    assert Ocean.open(sea_file(zeros_for_nothing("so"))).is_land(10.0, 177.0)
    assert Ocean.open(sea_file(zeros_for_nothing("uo", "vo"))).is_land(10.0, 177.0)


def test_fresh_water_below_the_bottom_is_refused(sea_file: Writer) -> None:
    def change(data: xr.Dataset) -> None:
        for name in ("to", "so", "uo", "vo"):
            data[name][:, 2, 3:, 2:] = 0.0

    refused(sea_file(change), "so is 0 below salt water in ", " %")


def test_temperature_zero_below_warm_water_is_refused(sea_file: Writer) -> None:
    def change(data: xr.Dataset) -> None:
        data["to"][:, 2, 3:, 2:] = 0.0

    refused(sea_file(change), "to is exactly 0 below water warmer than 5 deg C in ", " %")


@pytest.mark.parametrize("value", [-1e-9, -0.2, 0.0])
def test_one_node_of_a_model_s_overshoot_refuses_nothing(sea_file: Writer, value: float) -> None:
    """At the surface it is fresh water; there all other places are as before."""

    def change(data: xr.Dataset) -> None:
        data.so[1, 0, 3, 3] = value

    ocean, whole = Ocean.open(sea_file(change)), Ocean.open(sea_file())
    assert ocean.at("2020-03-01T06:00:00Z", 13.0, -180.0, 0.0).absolute_salinity == pytest.approx(0.0, abs=1e-3)
    place = (START, 12.0, 179.0, 20.0)
    assert ocean.at(*place).density == pytest.approx(whole.at(*place).density, abs=1e-4)
    assert ("numbers of so" in ocean.notes) == (value < 0.0)


def test_one_fresh_node_below_salt_water_is_left_out(sea_file: Writer) -> None:
    """The column ends above it, and the notes say so."""

    def change(data: xr.Dataset) -> xr.Dataset:
        data = data.interp(lat=np.linspace(10.0, 14.0, 15), method="nearest")
        for name, original in (("to", "degC"), ("so", "1e-3")):
            assert data[name].attrs["units"] == original
        data.so[:, 2, 8, 4] = -1e-9
        return data

    ocean = Ocean.open(sea_file(change))
    assert "1 of" in ocean.notes["numbers of so"] or "3 of" in ocean.notes["numbers of so"]
    assert "below salt water" in ocean.notes["numbers of so"]
    assert int(ocean.data.nodes.levels[8, 4]) == 2


def test_a_river_and_a_lake_are_water(sea_file: Writer) -> None:
    """No salt from top to bottom, and temperatures that differ; no salt anywhere."""

    def river(data: xr.Dataset) -> None:
        data.so[:, :, 4, 4:] = 0.0

    def lake(data: xr.Dataset) -> None:
        data["so"] = (data.so * 0.0).assign_attrs(data.so.attrs)

    assert not Ocean.open(sea_file(river)).is_land(14.0, -178.5)
    assert Ocean.open(sea_file(lake)).at(START, 13.0, 179.0, 0.0).absolute_salinity == pytest.approx(0.0, abs=1e-9)


def test_water_at_exactly_zero_degrees_is_water(sea_file: Writer) -> None:
    def cold(data: xr.Dataset) -> None:
        data["to"] = (data.to * 0.0 + xr.DataArray([3.0, 0.0, 0.0], dims="depth")).assign_attrs(data.to.attrs)

    assert Ocean.open(sea_file(cold)).at(START, 13.0, 179.0, 50.0).temperature == pytest.approx(0.0, abs=0.01)
