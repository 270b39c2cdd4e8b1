"""Zarr in a folder or a zip file, and references into other files: the same sea as from NetCDF."""

import json
import os
from pathlib import Path
from typing import Any

import pytest

from stommel.errors import FileError
from stommel.ocean import Ocean
from tests.ocean.conftest import regular_sea
from tests.ocean.test_damaged_files import refused
from tests.support.command import Command

PLACE = ("2020-03-01T03:00:00Z", 13.0, 179.0, 20.0)


def temperature(path: Path) -> float:
    return Ocean.open(path).at(*PLACE).temperature


@pytest.fixture
def netcdf(tmp_path: Path) -> Path:
    regular_sea().to_netcdf(tmp_path / "sea.nc")
    return tmp_path / "sea.nc"


def references(folder: Path, store: Path, *, relative: bool = False) -> Path:
    """References to the pieces of a store, as kerchunk writes them; small things are written into the file."""
    refs: dict[str, Any] = {}
    for file in sorted(store.rglob("*")):
        if file.is_file() and file.name != ".zmetadata":
            key = file.relative_to(store).as_posix()
            name = file.relative_to(folder) if relative else file
            refs[key] = file.read_text() if file.name.startswith(".z") else [str(name), 0, file.stat().st_size]
    path = folder / "sea.json"
    path.write_text(json.dumps({"version": 1, "refs": refs}))
    return path


@pytest.mark.parametrize(
    ("name", "options"),
    [
        ("sea.zarr", {"zarr_format": 2}),
        ("sea.zarr", {"zarr_format": 3, "consolidated": False}),
        ("any_name", {"zarr_format": 2, "consolidated": False}),
        ("sea.zip", {"zarr_format": 2}),
        ("sea.zarr", {"zarr_format": 2, "encoding": {"to": {"dtype": "i2", "scale_factor": 1e-3, "add_offset": 10.0,
                                                            "_FillValue": -32768}}}),
    ],
)  # fmt: skip
def test_a_zarr_store_is_the_same_sea(tmp_path: Path, netcdf: Path, name: str, options: dict[str, Any]) -> None:
    path = tmp_path / name
    regular_sea().to_zarr(str(path), **options)
    assert temperature(path) == pytest.approx(temperature(netcdf), abs=5e-4 if "encoding" in options else 1e-12)
    assert Ocean.open(path).is_land(10.0, 177.0)


@pytest.mark.parametrize("relative", [False, True])
def test_references_are_the_same_sea(tmp_path: Path, netcdf: Path, relative: bool) -> None:
    pytest.importorskip("fsspec", reason="references need the extra stommel[references]")
    regular_sea().to_zarr(tmp_path / "store", zarr_format=2)
    assert temperature(references(tmp_path, tmp_path / "store", relative=relative)) == temperature(netcdf)


def test_references_that_cannot_be_followed(tmp_path: Path) -> None:
    regular_sea().to_zarr(tmp_path / "store", zarr_format=2)
    path = references(tmp_path, tmp_path / "store")
    whole = json.loads(path.read_text())

    def changed(entry: Any) -> None:
        refs = whole["refs"] | {"to/0.0.0.0": entry}
        path.write_text(json.dumps({"version": 1, "refs": refs}))

    changed(["https://example.org/sea.nc", 0, 100])
    refused(path, "refers to https://example.org/sea.nc", "fetch the file first")
    changed([str(tmp_path / "nowhere.nc"), 0, 100])
    with pytest.raises(FileError, match=r"nowhere\.nc: cannot be read: No such file or directory"):
        Ocean.open(path)
    os.mkfifo(tmp_path / "pipe")
    changed([str(tmp_path / "pipe"), 0, 100])
    with pytest.raises(FileError, match="it is a pipe"):
        Ocean.open(path)
    for text, said in (("{", "Expecting"), ("[1]", "it has none to a Zarr store"), ('{"refs": {}}', "it has none")):
        path.write_text(text)
        refused(path, "cannot be read as references", said)


@pytest.mark.parametrize("name", ["to/.zarray", "to/0.0.0.0", ".zgroup", "lat/.zattrs"])
def test_a_damaged_store_is_refused(tmp_path: Path, name: str) -> None:
    store = tmp_path / "sea.zarr"
    regular_sea().to_zarr(store, zarr_format=2, consolidated=False)
    (store / name).write_bytes(b"\x07damage")
    refused(store, "cannot be read")


def test_a_pipe_in_a_store_is_refused(tmp_path: Path) -> None:
    store = tmp_path / "sea.zarr"
    regular_sea().to_zarr(store, zarr_format=2, consolidated=False)
    (store / "to" / ".zarray").unlink()
    os.mkfifo(store / "to" / ".zarray")
    with pytest.raises(FileError, match="it is a pipe"):
        Ocean.open(store)


def test_a_zip_file_of_other_things(tmp_path: Path) -> None:
    (tmp_path / "x.zip").write_bytes(b"PK no")
    refused(tmp_path / "x.zip", "it is no zip file")


@pytest.mark.parametrize(
    "address", ["https://example.org/sea.nc", "http://x.org/dodsC/a?temp[0]", "s3://bucket/sea.zarr", "gs://b/c.json"]
)
def test_an_address_is_said_to_be_one(stommel: Command, address: str) -> None:
    for arguments in (("ocean", "show", address), ("simulate", address), ("trim", address, "--speed=1", "--pitch=-3")):
        found = stommel(*arguments)
        assert (found.status, found.out) == (2, "")
        assert found.err.startswith(f"error: {address}: cannot be read: it is an address on the network")


def test_an_address_of_a_file_asks_for_its_path(tmp_path: Path) -> None:
    with pytest.raises(FileError, match=r"file:///x/sea\.nc: cannot be read: it is an address; give the path alone"):
        Ocean.open("file:///x/sea.nc")
