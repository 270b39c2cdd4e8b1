"""What a mission leaves: an xarray Dataset with CF names and units, and the same as a NetCDF file."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from stommel.files.whole import whole_file
from stommel.simulation.flight import Flown
from stommel.simulation.results import variables
from stommel.simulation.results.ctd import profiles_of, samples_of
from stommel.simulation.results.energy import energy_of
from stommel.simulation.results.events import Events, events_of
from stommel.simulation.results.verdict import verdict
from stommel.simulation.results.waypoints import Waypoints, waypoints_of
from stommel.version import __version__

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
Rows = NDArray[np.void]

_SAMPLED = "sample_time sample_latitude sample_longitude"

_UNBOUNDED = 1e4
"""Deeper than this is an ocean without a bottom [m]."""
_EXACT = (
    "time", "latitude", "longitude", "reckoned_latitude", "reckoned_longitude", "sample_latitude", "sample_longitude",
)  # fmt: skip
"""Stored as doubles, with all surfacings, events and energies; a float's seven digits are enough for the rest."""


def dataset_of(flown: Flown) -> "xr.Dataset":
    """Describe a flown mission as a trajectory after CF 1.10.

    Dimensions are `time`, `sample` (of the CTD), `surfacing` (each stay at the surface that ended with a dive),
    `waypoint` and `event` (each change of phase, and what happened at waypoints). Global attributes hold what the
    mission can be flown again from: its file and the vehicle's numbers as JSON, the seed and the version.
    """
    import xarray as xr  # noqa: PLC0415 - start-up counts

    start, waypoints = flown.mission.scenario.start_seconds, waypoints_of(flown)
    return xr.Dataset(
        _record(flown, waypoints)
        | _samples(flown)
        | _surfacings(flown.surfacings, start)
        | _waypoints(waypoints)
        | _events(events_of(flown, waypoints), start)
        | _trajectory(),
        coords={"time": ("time", _times(flown.record["time"], start), variables.TIME)},
        attrs=_provenance(flown, waypoints),
    )


def _times(seconds: Array, start: float) -> NDArray[np.datetime64]:
    """Seconds of the mission as UTC."""
    return np.round((start + seconds) * 1e9).astype("int64").astype("datetime64[ns]")


def _record(flown: Flown, waypoints: Waypoints) -> dict[str, Any]:
    record = flown.record
    found: dict[str, Any] = {}
    for name, attributes in variables.PLACES.items():
        found[name] = ("time", np.degrees(record[name]), attributes)
    for name, (column, factor, attributes) in variables.RECORD.items():
        values = record[column]
        scaled = values * factor if factor else np.degrees(values)
        found[name] = ("time", scaled if name in _EXACT else scaled.astype(np.float32), dict(attributes))
    for name in ("heading", "measured_heading"):
        found[name] = ("time", np.mod(found[name][1], np.float32(360.0)), found[name][2])
    bottom = found["bottom_depth"][1]
    bottom[bottom > _UNBOUNDED] = np.nan
    for curve, (name, attributes) in zip(energy_of(flown).values(), variables.ENERGY.items(), strict=True):
        found[name] = ("time", curve, dict(attributes))
    found["waypoint_sought"] = ("time", (waypoints.sought + 1).astype(np.int16), dict(variables.SOUGHT))
    found["distance_to_waypoint"] = ("time", waypoints.distance_m.astype(np.float32), dict(variables.TO_WAYPOINT))
    found["phase"] = ("time", record["phase"].astype(np.int8), _flags(variables.PHASE))
    for name, (_, _, attributes) in found.items():
        if name not in ("latitude", "longitude", "depth"):
            attributes["coordinates"] = "time depth latitude longitude"
    return found


def _samples(flown: Flown) -> dict[str, Any]:
    rows = flown.samples
    found = _located("sample", rows, flown.mission.scenario.start_seconds)
    for name in variables.PLACES:
        found[f"sample_{name}"][2]["long_name"] = f"{name} that the vehicle believes"
    measured = samples_of(flown)._asdict()
    for name, attributes in variables.SAMPLES.items():
        found[f"sample_{name}"] = ("sample", measured[name], dict(attributes) | {"coordinates": _SAMPLED})
    phase = rows["phase"].astype(np.int8)
    found["sample_phase"] = ("sample", phase, _flags(variables.PHASE))
    found["sample_profile"] = ("sample", profiles_of(flown), dict(variables.PROFILE))
    return found


def _surfacings(rows: Rows, start: float) -> dict[str, Any]:
    found = _located("surfacing", rows, start)
    for name, (column, attributes) in variables.SURFACINGS.items():
        found[name] = ("surfacing", rows[column].copy(), attributes)
    return found


def _waypoints(waypoints: Waypoints) -> dict[str, Any]:
    """What became of the waypoints, and how the legs to them were flown."""
    nan = float("nan")
    reached = [waypoint.reached_s for waypoint in waypoints.all]
    columns: dict[str, list[float]] = {name: [] for name in variables.WAYPOINTS}
    for waypoint in waypoints.all:
        leg = waypoint.flown
        ways = (nan,) * 6 if leg is None else (leg.length_m, leg.time_s, leg.over_ground_m, leg.made_good_m,
                                               leg.beside_line_rms_m, leg.beside_line_greatest_m)  # fmt: skip
        told = (nan if value is None else value for value in (waypoint.reached_s, waypoint.closest_m))
        for column, value in zip(columns.values(), (*told, waypoint.to_go_m, *ways), strict=True):
            column.append(value)
    found: dict[str, Any] = {
        "acceptance_radius": ((), waypoints.radius_m, variables.ACCEPTANCE_RADIUS),
        "waypoint_reached": (
            "waypoint", np.array([when is not None for when in reached], np.int8), _flags(variables.WAYPOINT_REACHED)
        ),
    }  # fmt: skip
    for name, place in zip(variables.PLACES, ("latitude_deg", "longitude_deg"), strict=True):
        values = np.array([getattr(waypoint.place, place) for waypoint in waypoints.all], float)
        found[f"waypoint_{name}"] = ("waypoint", values, dict(variables.PLACES[name]))
    for name, attributes in variables.WAYPOINTS.items():
        found[name] = ("waypoint", np.array(columns[name], float), dict(attributes))
    return found


def _events(events: Events, start: float) -> dict[str, Any]:
    rows = events.rows
    found = _located("event", rows, start)
    depth = dict(variables.RECORD["depth"][2])
    del depth["axis"]
    found["event_depth"] = ("event", rows["depth"].copy(), depth)
    for name, attributes in (("phase", variables.PHASE), ("reason", variables.REASON)):
        values = rows[name].astype(np.int8)
        found[f"event_{name}"] = ("event", values, _flags(attributes))
    found["event_waypoint"] = ("event", events.waypoint.astype(np.int16), variables.EVENT_WAYPOINT)
    return found


def _located(dimension: str, rows: Rows, start: float) -> dict[str, Any]:
    """Time and place of surfacings or events."""
    time = {"standard_name": "time", "long_name": f"time of the {dimension}"}
    found: dict[str, Any] = {f"{dimension}_time": (dimension, _times(rows["time"], start), time)}
    for name, attributes in variables.PLACES.items():
        found[f"{dimension}_{name}"] = (dimension, np.degrees(rows[name]), dict(attributes))
    return found


def _flags(attributes: dict[str, Any]) -> dict[str, Any]:
    return attributes | {"flag_values": np.array(attributes["flag_values"], dtype=np.int8)}


def _trajectory() -> dict[str, Any]:
    return {"trajectory": ((), "mission", {"cf_role": "trajectory_id", "long_name": "name of the trajectory"})}


def _provenance(flown: Flown, waypoints: Waypoints) -> dict[str, Any]:
    mission, plan = flown.mission, flown.mission.scenario
    stored = flown.plant.battery.energy
    return {
        "Conventions": "CF-1.10",
        "featureType": "trajectory",
        "title": plan.name,
        "summary": f"Simulated mission of {mission.vehicle.name} in {mission.ocean.name}",
        "source": f"stommel {__version__}: eight degrees of freedom, actuators, sensors and control",
        "outcome": flown.outcome,
        "verdict": verdict(waypoints, plan.start_seconds, flown.outcome),
        "seed": str(plan.seed),
        "stommel_version": __version__,
        "mission_file": mission.origin,
        "mission": json.dumps(mission.document, default=str, sort_keys=True),
        "vehicle": mission.vehicle.description.model_dump_json(),
        "vehicle_neutral_density_kg_m3": mission.vehicle.neutral_density_kg_m3,
        "ocean": mission.ocean.name,
        "ocean_notes": json.dumps(dict(mission.ocean.notes), sort_keys=True),
        "distance_through_water_m": flown.distance_through_water,
        "battery_energy_j": stored if np.isfinite(stored) else np.nan,
        "battery_self_discharge_w": flown.plant.battery.self_discharge,
    }


def write_netcdf(dataset: "xr.Dataset", path: str | Path) -> None:
    """Write a mission's Dataset as NetCDF, whole or not at all; the same Dataset gives the same bytes.

    Raises
    ------
    OutputError
        The file cannot be written; what stood there before still does.
    """
    with whole_file(Path(path)) as temporary:
        _to_netcdf(dataset, temporary)


def netcdf_bytes(dataset: "xr.Dataset") -> bytes:
    """Return the NetCDF file of a mission's Dataset, as `write_netcdf` writes it."""
    return bytes(_to_netcdf(dataset, None))


def _to_netcdf(dataset: "xr.Dataset", path: Path | None) -> memoryview:
    """NetCDF in the 64-bit classic form, times as seconds since 1970-01-01 UTC.

    Dimensions without any entry are left out. NetCDF 4 would be smaller, but the HDF5 below it stamps the root group
    with the time of writing: no two files alike.
    """
    # a length of zero means "unlimited" in the classic form, which knows one such dimension; others cannot read two
    dataset = dataset.drop_dims([name for name, length in dataset.sizes.items() if length == 0])
    encoding = {str(name): _encoding(dataset, str(name)) for name in dataset.variables}
    written: Any = dataset.to_netcdf(path, engine="scipy", format="NETCDF3_64BIT", encoding=encoding)
    return memoryview(b"" if written is None else written)


def _encoding(dataset: "xr.Dataset", name: str) -> dict[str, Any]:
    variable = dataset[name].variable
    if variable.ndim == 0:
        return {}
    packing: dict[str, Any] = {"_FillValue": None}
    if np.issubdtype(variable.dtype, np.datetime64):
        return packing | {"units": "seconds since 1970-01-01T00:00:00Z", "calendar": "standard", "dtype": "f8"}
    if np.issubdtype(variable.dtype, np.floating):
        exact = variable.dims[0] not in ("time", "sample") or name in _EXACT or name.startswith("energy_")
        return packing | {"dtype": "f8" if exact else "f4", "_FillValue": np.nan if exact else np.float32(np.nan)}
    return packing
