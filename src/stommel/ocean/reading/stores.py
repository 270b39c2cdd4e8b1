"""Stores that xarray reads as it reads a file: Zarr in a folder or a zip file, references into other files in JSON."""

import json
import os
import warnings
from collections.abc import Iterable
from pathlib import Path
from typing import Any
from zipfile import is_zipfile

import xarray as xr

from stommel.errors import FileError, Problem
from stommel.files.opening import TABLE_MIB, exists, read_text, require_regular

_MARKS = ("zarr.json", ".zgroup", ".zmetadata")
"""Files that a Zarr store begins with, of format 3 and of format 2."""
_NAMES = (*_MARKS, ".zarray", ".zattrs")
REASONS = (OSError, ValueError, RuntimeError, KeyError, TypeError, AttributeError, IndexError, EOFError)
"""What the libraries below xarray raise where a file or store is not what it should be."""


def open_store(path: Path) -> xr.Dataset | None:
    """Open a store without decoding anything; None where a path is none.

    Raises
    ------
    FileError
        It is one and cannot be read.
    """
    if os.path.isdir(path):  # noqa: PTH112 - Path.is_dir raises for a name that is too long
        return _open_folder(path) if any(exists(path / mark) for mark in _MARKS) else None
    if path.suffix.lower() == ".zip" and exists(path):
        require_regular(path)
        if not is_zipfile(path):
            raise _unusable(path, "cannot be read as Zarr: it is no zip file")
        return _opened(path, str(path))
    return _open_references(path) if path.suffix.lower() == ".json" else None


def files_of(path: Path) -> list[Path]:
    """The files of a store in a folder, in order; a file is its own."""
    if not os.path.isdir(path):  # noqa: PTH112 - likewise
        return [path]
    return sorted(inside for inside in path.rglob("*") if inside.is_file())


def _open_folder(path: Path) -> xr.Dataset:
    for folder in (path, *(inside for inside in path.iterdir() if inside.is_dir())):
        for name in _NAMES:
            if exists(folder / name):
                require_regular(folder / name)
    return _opened(path, str(path))


def _open_references(path: Path) -> xr.Dataset:
    """Open references as kerchunk writes them; files that they name lie beside the file, or where they say."""
    text = read_text(path, TABLE_MIB)
    try:
        document = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise _unusable(path, f"cannot be read as references: {first_line(error)}") from None
    entries = document.get("refs", document) if isinstance(document, dict) else None
    if not isinstance(entries, dict) or not any(str(key).endswith((".zgroup", "zarr.json")) for key in entries):
        raise _unusable(path, "cannot be read as references: it has none to a Zarr store")
    if isinstance(document, dict) and {"templates", "gen"} & set(document):
        raise _unusable(path, "cannot be read as references: it has templates; write them out")
    refs = {key: _resolved(path, entry) for key, entry in entries.items()}
    for name in dict.fromkeys(entry[0] for entry in refs.values() if isinstance(entry, list)):
        require_regular(name)
    try:
        import fsspec  # noqa: F401, PLC0415 - an extra
    except ImportError:
        raise _unusable(path, "references need fsspec: pip install 'stommel[references]'") from None
    storage = {"fo": {"version": 1, "refs": refs}, "remote_protocol": "file"}
    return _opened(path, "reference://", storage_options=storage, consolidated=False)


def _resolved(path: Path, entry: Any) -> Any:
    if not isinstance(entry, list) or not entry or not isinstance(entry[0], str):
        return entry
    name = entry[0].removeprefix("file://")
    if "://" in name:
        raise _unusable(path, f"refers to {name[:80]}: addresses on the network are not read; fetch the file first")
    beside = path.parent / name
    return [str(beside if exists(beside) else name), *entry[1:]]


def _opened(path: Path, store: str, **options: Any) -> xr.Dataset:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # that its metadata are not in one place
            return xr.open_dataset(
                store, engine="zarr", decode_cf=False, cache=False, chunks=None, create_default_indexes=False,
                backend_kwargs=options or None,
            )  # fmt: skip
    except REASONS as error:
        raise _unusable(path, f"cannot be read as Zarr: {first_line(error)}") from None


def first_line(error: BaseException) -> str:
    """First line of what a library says."""
    said: Iterable[str] = (getattr(error, "strerror", None) or str(error)).splitlines()
    return next((line.strip()[:200] for line in said if line.strip()), type(error).__name__)


def _unusable(path: Path, message: str) -> FileError:
    return FileError([Problem(str(path), "", message)])
