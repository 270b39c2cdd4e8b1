"""The result of a study: one Dataset, in NetCDF or Zarr, whole or not at all."""

import json
import os
import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from stommel.errors import OutputError
from stommel.files.units import unit_of
from stommel.files.whole import require_file, write_whole
from stommel.studies.errors import StudyError
from stommel.studies.sampling import draws_of, sweep_values
from stommel.studies.sensitivity import Sensitivity, sensitivity_of
from stommel.studies.study import Study
from stommel.studies.study_file import SWEEP

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
Records = Mapping[int, Mapping[str, Any]]

ENDINGS = (".nc", ".zarr")
"""Of the names of result files."""


def outputs_of(study: Study, records: Records) -> dict[str, Array]:
    """Values of every output in the order of the runs; nan for runs that failed.

    Raises
    ------
    StudyError
        An output has no such name, or the name of a parameter.
    """
    flown = [record["numbers"] for record in records.values() if "numbers" in record]
    known = list(dict.fromkeys(name for numbers in flown for name in numbers))
    check_outputs(study, known)
    wanted = study.file.outputs or known
    nothing: dict[str, float] = {}
    rows = [records[run].get("numbers", nothing) for run in range(len(study.values))]
    return {name: np.array([row.get(name, _absent(name, row)) for row in rows]) for name in wanted}


def _absent(name: str, row: Mapping[str, float]) -> float:
    """Value of an output that a run does not tell: an event that did not happen, or unknown."""
    return 0.0 if row and name.startswith("events_") else np.nan


def check_outputs(study: Study, known: list[str]) -> None:
    """Refuse outputs that the summary, whose numbers are `known`, does not have; nothing is known of no runs."""
    for name in study.file.outputs if known else ():
        if name not in known:
            raise StudyError(
                f"{study.origin}: outputs: {name!r}: the summary of a mission has no such number; there are: "
                f"{', '.join(known)}"
            )
    taken = {*(study.file.outputs or known)} & {*study.names, "seed", "outcome", "failure"}
    if taken:
        name = sorted(taken)[0]
        raise StudyError(f"{study.origin}: outputs: {name!r} is also the name of a parameter; give that another name")


def sensitivity_in(study: Study, outputs: Mapping[str, Array]) -> Sensitivity | None:
    """Sensitivity of the outputs, see `stommel.studies.sensitivity`."""
    values = np.array(
        [[np.nan if isinstance(v, str | bool) else v for v in row] for row in study.values], dtype=np.float64
    )
    return sensitivity_of(study.file.kind, study.names, values, outputs, study.file.seed)


def dataset_of(
    study: Study, records: Records, outputs: Mapping[str, Array], sensitivity: Sensitivity | None
) -> "xr.Dataset":
    """Put runs and sensitivity into one Dataset.

    A sweep has one dimension for each parameter, named by it, and `repeat`, along which others are drawn; every other
    study has `run`, with the parameters as coordinates.
    """
    import xarray as xr  # noqa: PLC0415 - start-up counts

    dims, shape, coords = _axes(study)
    per_run: dict[str, Any] = {name: (values, _about(name)) for name, values in outputs.items()}
    runs = range(len(study.values))
    per_run["seed"] = (np.array([records[run]["seed"] for run in runs], dtype=np.int64), {"long_name": "seed"})
    for key, meaning in (("outcome", "how the mission ended"), ("failure", "why the run could not be flown")):
        texts = np.array([records[run].get(key, "") for run in runs], dtype=object)
        per_run[key] = (texts, {"long_name": meaning})
    variables = {name: (dims, values.reshape(shape), about) for name, (values, about) in per_run.items()}
    if sensitivity is not None:
        variables |= _sensitivity(sensitivity)
        coords |= {
            "output": ("output", np.array(sensitivity.outputs, dtype=object)),
            "parameter": ("parameter", np.array(sensitivity.parameters, dtype=object)),
        }
    return xr.Dataset(variables, coords=coords, attrs=_provenance(study, sensitivity))


def _axes(study: Study) -> tuple[tuple[str, ...], tuple[int, ...], dict[str, Any]]:
    parameters = study.file.parameters
    about = [_about(parameter.key) | {"long_name": parameter.key} for parameter in parameters]
    if study.file.kind != SWEEP:
        columns = zip(*study.values, strict=True)
        coords: dict[str, Any] = {
            name: ("run", np.array(column), words)
            for name, column, words in zip(study.names, columns, about, strict=True)
        }
        count = len(study.values)
        return ("run",), (count,), coords | {"run": ("run", np.arange(count), {"long_name": "run"})}
    coords = {}
    dims: tuple[str, ...] = ()
    shape: tuple[int, ...] = ()
    draws = iter(draws_of(study.file).T)
    for name, parameter, words in zip(study.names, parameters, about, strict=True):
        if parameter.drawn:
            coords[name] = ("repeat", next(draws), words)
            continue
        axis = _column(list(sweep_values(parameter)))
        coords[name] = (name, axis, words)
        dims, shape = (*dims, name), (*shape, len(axis))
    repeats = study.file.runs or 1
    if repeats > 1 or any(parameter.drawn for parameter in parameters):
        dims, shape = (*dims, "repeat"), (*shape, repeats)
        coords["repeat"] = ("repeat", np.arange(repeats), {"long_name": "repetition with another seed"})
    return dims, shape, coords


def _column(values: list[Any]) -> NDArray[Any]:
    """One axis; true and false as 1 and 0, which every reader of NetCDF knows."""
    if isinstance(values[0], bool):
        return np.array(values, dtype=np.int8)
    return np.array(values, dtype=object if isinstance(values[0], str) else np.float64)


_CF_UNITS = {"degrees": "degree", "deg C": "degree_C", "r/min": "rpm", "psu": "1"}
"""As the units library of NetCDF spells what people write otherwise."""


def _about(name: str) -> dict[str, str]:
    """Unit of a parameter or output; of a number in a table of the summary, as energy_wh_pump, the table says it."""
    parts = name.split("_")
    tables = ["_".join(parts[:count]) for count in range(len(parts), 0, -1)]
    unit = next((unit for table in tables if (unit := unit_of(table)) is not None), None)
    return {"units": _CF_UNITS.get(unit, unit)} if unit is not None else {}


def _sensitivity(found: Sensitivity) -> dict[str, Any]:
    variables: dict[str, Any] = {
        f"{found.method}_{measure}": (("output", "parameter"), values) for measure, values in found.measures.items()
    }
    variables[f"{found.method}_explained"] = ("output", found.explained)
    return variables


def _provenance(study: Study, sensitivity: Sensitivity | None) -> dict[str, Any]:
    kit = study.kit
    return {
        "Conventions": "CF-1.10",
        "title": study.file.name,
        "source": f"stommel {kit.version}: {study.file.kind} study of {len(study.values)} missions",
        "study": study.file.model_dump_json(exclude_none=True, by_alias=True),
        "mission": json.dumps(kit.document, sort_keys=True, default=str),
        "vehicle": "" if kit.vehicle is None else json.dumps(kit.vehicle.document, sort_keys=True, default=str),
        "sensitivity_runs": np.int64(0 if sensitivity is None else sensitivity.runs),
        "stommel_version": kit.version,
        "seed": np.int64(study.file.seed),
    }


def check_output(path: Path) -> None:
    """Refuse a name that tells no format, before anything is flown.

    Raises
    ------
    OutputError
        The ending is unknown, or something else than a result stands there.
    """
    if not (_is_zarr(path) and os.path.isdir(path)):  # noqa: PTH112 - Path.is_dir raises for a name that is too long
        require_file(path, ENDINGS)
    if _is_zarr(path) and path.exists() and not (path / ".zgroup").is_file():
        raise OutputError(f"{path}: cannot be written: something else than a Zarr store stands there")


def _is_zarr(path: Path) -> bool:
    return path.suffix.lower() == ".zarr"


def write_result(dataset: "xr.Dataset", path: Path) -> None:
    """Write the Dataset as its name ends, whole or not at all; the same Dataset gives the same bytes.

    Raises
    ------
    OutputError
        The file cannot be written; what stood there before still does.
    """
    check_output(path)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=path.parent, prefix=".") as folder:
            made = Path(folder) / "result"
            if _is_zarr(path):
                # format 2: format 3 has no settled form of texts yet
                dataset.to_zarr(made, mode="w", zarr_format=2, consolidated=True)
                _replace_folder(made, path, Path(folder) / "before")
            else:
                dataset.to_netcdf(made, format="NETCDF4", engine="netcdf4")
                write_whole(path, made.read_bytes())
    except OSError as error:
        raise OutputError(f"{path}: cannot be written: {error.strerror or error}") from error
    except RuntimeError as error:  # the NetCDF library does not say why
        free = shutil.disk_usage(path.parent).free / 1e6
        raise OutputError(f"{path}: cannot be written: {error}; the disk has {free:.3g} MB left") from error


def _replace_folder(made: Path, path: Path, before: Path) -> None:
    """Put a folder in the place of another, which stays if that fails."""
    if not path.exists():
        made.rename(path)
        return
    path.rename(before)
    try:
        made.rename(path)
    except OSError:
        before.rename(path)
        raise
    shutil.rmtree(before)
