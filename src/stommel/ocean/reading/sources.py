"""Opening the files of an ocean: one, several, or a pattern; what is missing or damaged is said by name."""

import errno
import glob
import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import NoReturn

import xarray as xr

from stommel.errors import FileError, Problem
from stommel.files.opening import exists, refuse_address, require_regular
from stommel.ocean.answers import Source
from stommel.ocean.reading.classic import HeaderDamageError, expected_length
from stommel.ocean.reading.spelling import require_spelling
from stommel.ocean.reading.stores import REASONS, first_line, open_store
from stommel.ocean.reading.variables import File


def paths_of(source: Source, folder: Path | None) -> list[Path]:
    """Return the files of a source; relative names are sought in `folder` first.

    Raises
    ------
    FileError
        A pattern matches nothing, a file is named twice, or none is named.
    """
    given = [source] if isinstance(source, str | Path) else list(source)
    found: list[Path] = []
    for entry in map(str, given):
        refuse_address(entry)
        found += _matching(entry, folder)
    if not found:
        raise FileError([Problem("ocean", "", "no file is named")])
    twice = sorted({str(path) for path in found if found.count(path) > 1})
    if twice:
        raise FileError([Problem(twice[0], "", "is named twice")])
    return found


def _matching(entry: str, folder: Path | None) -> list[Path]:
    beside = str(folder / entry) if folder is not None else entry
    for name in (beside, entry):
        # a file may have a bracket in its name
        if exists(name):
            return [Path(name)]
        matched = sorted(glob.glob(name))  # noqa: PTH207 - a pattern may be an absolute path
        if matched:
            return [Path(path) for path in matched]
    if glob.has_magic(entry):
        raise FileError([Problem(entry, "", "no file matches this pattern")])
    return [Path(entry)]


@contextmanager
def opened(paths: Sequence[Path], names: Mapping[str, str], units: Mapping[str, str]) -> Iterator[list[File]]:
    """Open files with the names and units that the user gave their variables, and close them at the end."""
    with ExitStack() as stack:
        files = [File(str(path), stack.enter_context(_open(path)), names, units) for path in paths]
        for file in files:
            require_spelling(file)
        yield files


def _open(path: Path) -> xr.Dataset:
    store = open_store(path)
    if store is not None:
        return store
    if os.path.isdir(path):  # noqa: PTH112 - Path.is_dir raises for a name that is too long
        _refuse(path, f"cannot be read: it is a folder; name its files, as {path / '*.nc'}")
    length = require_regular(path)
    if not os.access(path, os.R_OK):
        _refuse(path, f"cannot be read: {os.strerror(errno.EACCES)}")
    try:
        expected = expected_length(path)
    except HeaderDamageError as error:
        _refuse(path, f"is damaged: by its header {error}")
    if expected is not None and length < expected:
        _refuse(path, f"is damaged or was cut short: it has {length} bytes and should have {expected}")
    try:
        # indexes would read coordinates before their size has been looked at
        return xr.open_dataset(path, engine="netcdf4", decode_cf=False, cache=False, create_default_indexes=False)
    except REASONS as error:
        _refuse(path, f"cannot be read as NetCDF: {first_line(error)}")


def _refuse(path: Path, message: str) -> NoReturn:
    raise FileError([Problem(str(path), "", message)])
