"""How numbers are stored: signs, packing, fill values, valid ranges, units. Oracle: the sea before it was packed."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray as xr

from stommel.errors import FileError, StommelError
from stommel.ocean import Ocean
from stommel.simulation.scenario.loading import mission_from
from tests.ocean.conftest import Writer, regular_sea
from tests.ocean.test_damaged_files import refused
from tests.simulation.conftest import mission_document
from tests.support.command import Command

START = "2020-03-01T00:00:00Z"
SCALE, OFFSET = 0.0005, 10.0


def temperature(path: Path, **options: Any) -> float:
    return Ocean.open(path, **options).at(START, 13.0, 179.0, 0.0).temperature


def stored(folder: Path, dtype: str, fill: Any, attributes: dict[str, Any], kind: str = "NETCDF4") -> Path:
    """The regular sea with its temperature packed by hand, as the library of NetCDF writes bytes."""
    path = folder / "sea.nc"
    data = regular_sea()
    data.drop_vars("to").to_netcdf(path, engine="netcdf4", format=kind)  # type: ignore[call-overload]
    with netCDF4.Dataset(path, "a") as file:
        variable = file.createVariable("to", dtype, ("time", "depth", "lat", "lon"), fill_value=False)
        variable.set_auto_maskandscale(False)
        variable.setncatts({"standard_name": "sea_water_temperature", "units": "degC", **attributes})
        packed = np.rint((data.to.values - OFFSET) / SCALE)
        variable[:] = np.where(np.isnan(packed), fill, packed).astype(np.int64).astype(dtype)
    return path


TRUE = float(regular_sea().to.sel(lat=13.0, lon=179.0)[0, 0])
PACKING = {"scale_factor": SCALE, "add_offset": OFFSET}


@pytest.mark.parametrize("kind", ["NETCDF4", "NETCDF3_CLASSIC"])
@pytest.mark.parametrize("said", ["true", "True"])
def test_unsigned_numbers_in_a_signed_type(tmp_path: Path, kind: str, said: str) -> None:
    """CF 2.2: a type of bytes that is to be read without its sign. The fill value is stored as the type has it."""
    data = regular_sea()
    path = tmp_path / "sea.nc"
    data.drop_vars("to").to_netcdf(path, engine="netcdf4", format=kind)  # type: ignore[call-overload]
    with netCDF4.Dataset(path, "a") as file:
        variable = file.createVariable("to", "i2", ("time", "depth", "lat", "lon"), fill_value=False)
        variable.set_auto_maskandscale(False)
        variable.setncatts(
            {"standard_name": "sea_water_temperature", "units": "degC", "_Unsigned": said, "_FillValue": np.int16(-1),
             "scale_factor": 0.0004, "add_offset": 0.0, "valid_range": np.array([0, -2], dtype="i2")}
        )  # fmt: skip
        packed = np.nan_to_num(np.rint(data.to.values / 0.0004), nan=65535.0)
        assert packed.max() > 32767
        variable[:] = packed.astype(np.uint16).view(np.int16)
    ocean = Ocean.open(path)
    assert ocean.at(START, 13.0, 179.0, 0.0).temperature == pytest.approx(TRUE, abs=2e-4)
    assert ocean.is_land(10.0, 177.0)
    assert not [key for key in ocean.notes if key.startswith("numbers")]


@pytest.mark.parametrize(
    "attributes",
    [
        {"_FillValue": np.int16(-32768)},
        {"missing_value": np.int16(-32768)},
        {"missing_value": np.array([-32768, -32767], dtype="i2")},
        {"missing_value": np.float64(-32768.0)},
        {"missing_value": "-32768"},
        {"_FillValue": np.int16(-32767), "missing_value": np.int32(-32768)},
        {"valid_min": np.int16(-32000)},
        {"valid_range": np.array([-32000, 32000], dtype="i2")},
        {"valid_range": np.array([-5.0, 40.0])},
        {"valid_min": np.float32(-5.0), "valid_max": np.float32(40.0)},
        {"valid_range": np.array([-32000.0, 32000.0])},
        {"valid_range": np.array([-5, 40], dtype="i2")},
    ],
    ids=str,
)
def test_whatever_marks_nothing(tmp_path: Path, attributes: dict[str, Any]) -> None:
    """Fill values of any type, valid ranges in the units of the packed or of the unpacked numbers."""
    ocean = Ocean.open(stored(tmp_path, "i2", -32768, {**PACKING, **attributes}))
    assert ocean.at(START, 13.0, 179.0, 0.0).temperature == pytest.approx(TRUE, abs=3e-4)
    assert ocean.is_land(10.0, 177.0)


def test_a_valid_range_of_packed_numbers_masks_what_it_says(tmp_path: Path) -> None:
    """Read as unpacked it would mask nothing."""
    highest = int(np.rint((16.05 - OFFSET) / SCALE))
    attributes = {**PACKING, "_FillValue": np.int16(-32768), "valid_range": np.array([-32000, highest], dtype="i2")}
    ocean = Ocean.open(stored(tmp_path, "i2", -32768, attributes))
    masked = int((regular_sea().to > 16.05 + SCALE / 2).sum())
    assert ocean.notes["numbers of to"].startswith(f"{masked} of ")
    assert "(as stored)" in ocean.notes["numbers of to"]


def test_what_was_never_written_is_nothing(tmp_path: Path) -> None:
    """The library's own fill value of the type counts where the file names none (NetCDF User's Guide, appendix A)."""
    assert Ocean.open(stored(tmp_path, "i2", netCDF4.default_fillvals["i2"], PACKING)).is_land(10.0, 177.0)


def test_a_valid_range_that_masks_is_named(sea_file: Writer) -> None:
    def narrow(data: xr.Dataset) -> None:
        data.to.attrs["valid_range"] = np.array([13.9, 40.0])

    masked = int((regular_sea().to < 13.9).sum())
    note = Ocean.open(sea_file(narrow)).notes["numbers of to"]
    assert f"{masked} of " in note
    assert "outside valid_range 13.9 to 40" in note

    def impossible(data: xr.Dataset) -> None:
        data.to.attrs |= {"valid_min": 300.0}

    refused(sea_file(impossible), "to has no number", "valid_min 300")


@pytest.mark.parametrize(
    ("attributes", "words"),
    [
        ({"valid_range": [40.0, -5.0]}, ["valid_range 40 to -5 does not increase"]),
        ({"valid_range": [1.0, 2.0, 3.0]}, ["valid_range must be two numbers"]),
        ({"valid_min": "low"}, ["valid_min = 'low' is no number"]),
        ({"scale_factor": 0.0}, ["scale_factor = 0.0"]),
        ({"scale_factor": float("nan")}, ["scale_factor = nan"]),
        ({"add_offset": [1.0, 2.0]}, ["add_offset = [1. 2.]"]),
    ],
)
def test_packing_that_is_none(sea_file: Writer, attributes: dict[str, Any], words: list[str]) -> None:
    refused(sea_file(lambda data: data.to.attrs.update(attributes)), "to cannot be unpacked", *words)


@pytest.mark.parametrize(
    "name", ["scale_factnr", "add_ofgset", "_FilmValue", "missing_valte", "_fillValue", "standard_naqe"]
)
def test_an_attribute_one_letter_off_is_refused(sea_file: Writer, name: str) -> None:
    """One flipped bit of a header: without the attribute all numbers mean something else."""
    refused(sea_file(lambda data: data.so.attrs.update({name: 2.0})), f"so has an attribute '{name}', nearly ")


@pytest.mark.parametrize(
    ("north", "east"),
    [("degreeN", "degreeE"), ("degreesN", "degreesE"), ("degree_N", "degree_E"), ("degrees_N", "degrees_E"),
     ("degree_north", "degree_east"), ("Degrees_North", "DEGREES_EAST")],
)  # fmt: skip
def test_degrees_in_every_spelling_of_udunits(sea_file: Writer, north: str, east: str) -> None:
    def change(data: xr.Dataset) -> xr.Dataset:
        data = data.rename(lat="y", lon="x")
        data.y.attrs, data.x.attrs = {"units": north}, {"units": east}
        return data

    assert temperature(sea_file(change)) == pytest.approx(temperature(sea_file()))


def test_a_unit_that_the_file_leaves_out_is_said(sea_file: Writer) -> None:
    """ROMS writes no units of salinity."""
    path = sea_file(lambda data: data.so.attrs.pop("units") and None)
    refused(path, "so has no units", "units says")
    told = Ocean.open(path, units={"salinity": "psu"})
    whole = Ocean.open(sea_file())
    place = (START, 13.0, 179.0, 0.0)
    assert told.at(*place).absolute_salinity == whole.at(*place).absolute_salinity
    with pytest.raises(StommelError, match="salinity = 'promille': must be one of 1, 1e-3"):
        Ocean.open(path, units={"salinity": "promille"})
    with pytest.raises(StommelError, match=r"unknown key salt.*known: temperature, salinity"):
        Ocean.open(path, units={"salt": "psu"})


def scaled(factor: float, units: str) -> Callable[[xr.Dataset], None]:
    def change(data: xr.Dataset) -> None:
        data["so"] = (data.so * factor).assign_attrs(data.so.attrs | {"units": units})

    return change


@pytest.mark.parametrize("units", ["1", "1e-3", "psu", "g kg-1"])
def test_a_salinity_that_is_kg_kg_is_asked_for(sea_file: Writer, units: str) -> None:
    path = sea_file(scaled(1e-3, units))
    refused(path, "so is 0.034 g/kg", "is it kg kg-1?", "units, salinity = 'kg kg-1'")
    salt = Ocean.open(path, units={"salinity": "kg kg-1"}).at(START, 13.0, 179.0, 0.0).absolute_salinity
    assert salt == pytest.approx(Ocean.open(sea_file()).at(START, 13.0, 179.0, 0.0).absolute_salinity, rel=1e-6)
    assert Ocean.open(sea_file(scaled(1e-3, units)), units={"salinity": "g kg-1"}).at(
        START, 13.0, 179.0, 0.0
    ).absolute_salinity == pytest.approx(0.0341, abs=1e-3)


def test_currents_in_centimetres_that_say_metres(sea_file: Writer) -> None:
    def change(data: xr.Dataset) -> None:
        for name in ("uo", "vo"):
            data[name] = (data[name] * 30.0).assign_attrs(data[name].attrs)

    refused(sea_file(change), "half of the currents are faster", "cm s-1?")


def test_a_fill_value_that_nothing_names_is_told_with_its_share(sea_file: Writer) -> None:
    def change(data: xr.Dataset) -> None:
        data["so"] = data.so.fillna(-999.0).assign_attrs(data.so.attrs)

    holes = int(regular_sea().so[0].isnull().sum())
    refused(sea_file(change), "so has the value -999", f"{100 * holes / regular_sea().so[0].size:.2g} % of its numbers")


def test_an_error_names_its_file(sea_file: Writer) -> None:
    with pytest.raises(FileError) as error:
        Ocean.open(sea_file(lambda data: data.to.attrs.update(scale_factor=0.0)))
    assert error.value.problems[0].key == "to"


def test_the_command_and_a_mission_say_units_too(sea_file: Writer, stommel: Command) -> None:
    path = sea_file(lambda data: data.so.attrs.pop("units") and None)
    assert stommel("ocean", "show", path).status == 2
    found = stommel("ocean", "show", path, "--unit", "salinity=psu", "--json")
    assert found.json["absolute_salinity_g_kg"][0] > 30.0
    place = {"latitude_deg": 13.0, "longitude_deg": 179.0}
    document = mission_document(
        ocean={"file": path.name, "units": {"salinity": "psu"}}, start=place, waypoints=[place],
        start_time="2020-03-01T00:00:00Z", duration_days=0.1,
    )  # fmt: skip
    assert mission_from(document, "test.toml", path.parent).ocean.notes["salinity"].startswith("so")
