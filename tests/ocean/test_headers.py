"""What a header promises is looked at before it is believed: flipped bits, and sizes that no memory holds.

Oracle: the same file whole. A flipped bit either changes nothing that is read, or the file is refused; only where a
header holds plain numbers and dates, which nothing else in the file repeats, can it do harm in silence.
"""

import time
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest

from stommel.errors import FileError, StommelError
from stommel.ocean import Ocean
from stommel.ocean.reading.classic import HeaderDamageError, expected_length
from tests.ocean.conftest import regular_sea
from tests.ocean.test_damaged_files import refused

PACKED: dict[str, Any] = {"to": {"dtype": "i2", "scale_factor": 0.001, "add_offset": 15.0, "_FillValue": -32767}}
NUMBERS_AND_DATES = (b"scale_factor", b"add_offset", b"hours since 2020-03-01 00:00:00")
"""After these a header holds what cannot be checked."""


def state(path: Path) -> list[bytes]:
    nodes = Ocean.open(path).data.nodes
    return [np.ascontiguousarray(part).tobytes() for part in nodes if isinstance(part, np.ndarray)]


def unchecked(whole: bytes) -> set[int]:
    """Bytes of numbers and dates: the words themselves are checked."""
    found: set[int] = set()
    for words in NUMBERS_AND_DATES:
        at = whole.index(words)
        found |= set(range(at + 12, at + len(words))) if words[:1] == b"h" else set(range(at, at + len(words) + 24))
    return found


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("unlimited", [False, True])
def test_a_flipped_bit_of_a_header_is_refused_or_changes_nothing(tmp_path: Path, unlimited: bool) -> None:
    """Every 29th bit; all of them were tried once."""
    path = tmp_path / "sea.nc"
    regular_sea().to_netcdf(
        path, engine="netcdf4", format="NETCDF3_CLASSIC", encoding=PACKED, unlimited_dims=["time"] * unlimited
    )
    whole, before = path.read_bytes(), state(path)
    end = whole.index(regular_sea().lat.values.astype(">f8").tobytes())
    spared, refusals = unchecked(whole), 0
    for bit in range(8 * 4, 8 * min(end, 1500), 29):
        if bit // 8 in spared:
            continue
        damaged = bytearray(whole)
        damaged[bit // 8] ^= 1 << bit % 8
        path.write_bytes(damaged)
        try:
            assert state(path) == before, f"bit {bit % 8} of byte {bit // 8}: {whole[bit // 8 - 20 : bit // 8 + 5]!r}"
        except StommelError:
            refusals += 1
    assert refusals > 200


@pytest.mark.parametrize(
    ("after", "offset", "value", "said"),
    [
        (b"\x00\x00\x00\x05depth\x00\x00\x00", 3, 2, "bytes, and"),
        (b"\x00\x00\x00\x03lat\x00", 3, 4, "bytes, and"),
    ],
)
def test_a_shorter_dimension_is_refused(tmp_path: Path, after: bytes, offset: int, value: int, said: str) -> None:
    path = tmp_path / "sea.nc"
    regular_sea().to_netcdf(path, engine="netcdf4", format="NETCDF3_CLASSIC")
    content = bytearray(path.read_bytes())
    content[content.index(after) + len(after) + offset] = value
    path.write_bytes(content)
    refused(path, "is damaged: by its header", said)


def test_records_that_are_not_counted_are_refused(tmp_path: Path) -> None:
    """Times would be missing in silence."""
    path = tmp_path / "sea.nc"
    regular_sea().to_netcdf(path, engine="netcdf4", format="NETCDF3_CLASSIC", unlimited_dims=["time"])
    content = bytearray(path.read_bytes())
    assert content[7] == 3
    content[7] = 1
    path.write_bytes(content)
    refused(path, "is damaged: by its header it counts 1 records, and the file has 3")


def test_headers_of_other_writers_are_sound(tmp_path: Path) -> None:
    """SciPy writes the format by itself."""
    regular_sea().to_netcdf(tmp_path / "sea.nc", engine="scipy")
    assert Ocean.open(tmp_path / "sea.nc").is_land(10.0, 177.0)
    for path in (tmp_path / "sea.nc",):
        try:
            assert (expected_length(path) or 0) <= path.stat().st_size
        except HeaderDamageError as error:
            pytest.fail(str(error))


@pytest.mark.parametrize("large", ["time", "depth", "lat"])
@pytest.mark.parametrize("curvilinear", [False, True])
def test_a_header_that_asks_for_too_much_is_refused_at_once(tmp_path: Path, large: str, curvilinear: bool) -> None:
    """19 GB of nodes or times, of which nothing is written: the file has a few kilobytes."""
    path, sizes = tmp_path / "huge.nc", {"time": 3, "depth": 3, "lat": 40, "lon": 60}
    sizes[large] = 2_400_000_000 if large != "lat" or not curvilinear else 40_000_000
    with netCDF4.Dataset(path, "w") as file:
        for name, size in sizes.items():
            file.createDimension(name, size)
        for name, units in (("time", "days since 2020-01-01"), ("depth", "m")):
            variable = file.createVariable(name, "f8", (name,), contiguous=True)
            variable.units = units
            if name != large:
                variable[:] = np.arange(3.0)
        for name, units in (("lat", "degrees_north"), ("lon", "degrees_east")):
            dims = ("lat", "lon") if curvilinear else (name,)
            file.createVariable(f"{name}2" if curvilinear else name, "f8", dims, contiguous=True).units = units
        for name, standard, units in (
            ("t", "sea_water_temperature", "degC"), ("s", "sea_water_salinity", "1e-3"),
            ("u", "eastward_sea_water_velocity", "m s-1"), ("v", "northward_sea_water_velocity", "m s-1"),
        ):  # fmt: skip
            variable = file.createVariable(name, "f4", tuple(sizes), contiguous=True)
            variable.setncatts({"standard_name": standard, "units": units})
    assert path.stat().st_size < 100_000
    start = time.process_time()
    with pytest.raises(FileError, match=r"cut the file to the mission's region|needs .* GB of memory"):
        Ocean.open(path)
    assert time.process_time() - start < 5.0
