"""One self-contained web page with linked, zoomable curves of a mission; it loads nothing from a network."""

import base64
import json
from collections.abc import Sequence
from html import escape
from importlib.resources import files
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stommel.control.dive_cycle import PHASES
from stommel.figures.style import CYCLE, INK
from stommel.simulation.pictures.energy_figure import COLOURS
from stommel.simulation.pictures.extracts import dive_times, positions, seconds, unbroken, values
from stommel.simulation.pictures.page_facts import facts_table, waypoint_table
from stommel.simulation.pictures.phases import SHADES
from stommel.simulation.results.energy import DRAINS
from stommel.simulation.results.verdict import length

Array = NDArray[np.float64]

MOST_ROWS = 40_000
"""Rows in the page; of a longer record every so many."""

_MILLI, _WATT_HOUR, _KILO = 1e3, 1.0 / 3600.0, 1e-3


def interactive_page(dataset: xr.Dataset) -> str:
    """Make the page: drag or turn the wheel to zoom, double click for all, point to read values off every curve."""
    every = -(-dataset.sizes["time"] // MOST_ROWS)
    part = dataset.isel(time=slice(None, None, every))
    data = {
        "start_ms": float(dataset["time"].values[0].astype("datetime64[ms]").astype(float)),
        "time": _encoded((part["time"].values - part["time"].values[0]) / np.timedelta64(1, "ns") / 1e9),
        "phase": _encoded(part["phase"].values),
        "phases": list(PHASES),
        "shades": [SHADES[name] for name in PHASES],
        "dives": _encoded(dive_times(dataset)),
        "panels": _panels(part, dataset),
        "track": dict(zip(("east", "north"), map(_encoded, positions(part)), strict=True)),
        "surfacings": _places(dataset, "surfacing"),
        "waypoints": _waypoints(dataset),
        "radius": float(dataset["acceptance_radius"]) / 1e3,
    }
    note = "all rows" if every == 1 else f"every {every}th row; the NetCDF file has them all"
    template = files("stommel.simulation.pictures").joinpath("page.html").read_text(encoding="utf-8")
    # "</" inside a script would end it
    filled = {
        "TITLE": escape(str(dataset.attrs["title"])),
        "VERDICT": escape(str(dataset.attrs["verdict"])),
        "SUBTITLE": escape(f"{dataset.attrs['summary']}. Shown: {note}."),
        "FACTS": facts_table(dataset) + waypoint_table(dataset),
        "DATA": json.dumps(data, allow_nan=False).replace("</", "<\\/"),
    }
    for key, text in filled.items():
        template = template.replace(f"@@{key}@@", text)
    return template


def _encoded(curve: Any) -> str:
    """Little-endian floats in base64."""
    return base64.b64encode(np.asarray(curve, dtype="<f4").tobytes()).decode("ascii")


def _panels(part: xr.Dataset, dataset: xr.Dataset) -> list[dict[str, Any]]:
    """First what became of the mission, then how it was flown."""
    depth = [("vehicle", values(part, "depth")), ("bottom", values(part, "bottom_depth"))]
    battery, voltage, hull = _energy(part)
    goal = [("distance", _KILO * values(part, "distance_to_waypoint"))]
    found = [
        _panel("Depth", "m", depth, down=True),
        battery,
        _panel("Distance to the waypoint", "km", goal),
        *_flight(part),
        *_sampled(dataset),
        voltage,
        hull,
    ]
    return [panel for panel in found if panel["curves"]]


def _flight(part: xr.Dataset) -> list[dict[str, Any]]:
    speed = np.sqrt(sum(values(part, name) ** 2 for name in ("surge", "sway", "heave")))
    true = unbroken(values(part, "heading"))
    measured = true + (values(part, "measured_heading") - true + 180.0) % 360.0 - 180.0
    return [
        _panel("Pitch and roll", "deg", [("pitch", values(part, "pitch")), ("roll", values(part, "roll"))]),
        _panel("Heading", "deg", [("true", true), ("measured", measured)]),
        _panel("Ballast volume", "ml", [("ballast", values(part, "ballast_volume"))]),
        _panel("Moving mass", "mm", [("position", _MILLI * values(part, "moving_mass_position"))]),
        _panel(
            "Steering",
            "deg",
            [("rudder", values(part, "rudder_angle")), ("rolling mass", values(part, "roll_mass_angle"))],
        ),
        _panel("Speed through the water", "m/s", [("speed", speed)]),
        _panel("Current", "m/s", [("east", values(part, "current_east")), ("north", values(part, "current_north"))]),
        _panel("Density", "kg/m³", [("in situ", values(part, "density"))]),
    ]


def _sampled(dataset: xr.Dataset) -> list[dict[str, Any]]:
    """What the CTD measured, at its own times, broken where it was off; nothing where it never was on."""
    if not dataset.sizes["sample"]:
        return []
    part = dataset.isel(sample=slice(None, None, -(-dataset.sizes["sample"] // MOST_ROWS)))
    time = seconds(part, "sample_time", dataset["time"].values[0])
    steps = np.diff(time)
    off = np.flatnonzero(steps > 3.0 * np.median(steps)) + 1 if len(steps) else np.empty(0, dtype=int)
    found = [
        _panel(f"{title} by the CTD", unit, [("measured", np.insert(values(part, name), off, np.nan))])
        for title, unit, name in (
            ("Temperature", "°C", "sample_temperature"),
            ("Practical salinity", "1", "sample_practical_salinity"),
        )
    ]
    return [panel | {"time": _encoded(np.insert(time, off, time[off]))} for panel in found]


def _energy(part: xr.Dataset) -> tuple[dict[str, Any], dict[str, Any], dict[str, Any]]:
    """Energy, voltage, pressure in the hull; without curves where the vehicle file tells nothing of them."""
    energies = {name: _WATT_HOUR * values(part, f"energy_{name}") for name in DRAINS}
    total = np.sum(list(energies.values()), axis=0)
    known = bool(np.isfinite(float(part.attrs["battery_energy_j"])))
    curves = (
        [("in all", total), *((name.replace("_", " "), curve) for name, curve in energies.items())] if known else []
    )
    return (
        _panel("Energy from the battery", "Wh", curves, colours=(INK, *COLOURS)),
        _panel("Voltage of the battery", "V", [("measured", values(part, "battery_voltage"))] if known else []),
        _panel("Pressure in the hull", "kPa", [("measured", _KILO * values(part, "internal_pressure"))]),
    )


def _panel(
    title: str, unit: str, curves: list[tuple[str, Array]], *, down: bool = False, colours: Sequence[str] = CYCLE
) -> dict[str, Any]:
    """One panel; curves without any number are left out, and second curves that are zero throughout."""
    kept = [
        (name, curve, colours[k])
        for k, (name, curve) in enumerate(curves)
        if np.isfinite(curve).any() and (k == 0 or np.any(curve[np.isfinite(curve)] != 0.0))
    ]
    return {
        "title": title,
        "unit": unit,
        "down": down,
        "curves": [{"name": name, "values": _encoded(curve), "colour": colour} for name, curve, colour in kept],
    }


def _places(dataset: xr.Dataset, dimension: str) -> dict[str, str]:
    """Places along a dimension on the plane of the track [km]."""
    if not dataset.sizes[dimension]:
        return {"east": "", "north": ""}
    places = xr.Dataset(
        {
            name: ("p", np.concatenate([dataset[name].values[:1], dataset[f"{dimension}_{name}"].values]))
            for name in ("latitude", "longitude")
        }
    )
    east, north = positions(places)
    return {"east": _encoded(east[1:]), "north": _encoded(north[1:])}


def _waypoints(dataset: xr.Dataset) -> dict[str, Any]:
    """Places of the waypoints, whether they were reached, and how far they are in words."""
    reached = dataset["waypoint_reached"].values.tolist()
    away = [length(metres) for metres in values(dataset, "waypoint_distance")]
    return _places(dataset, "waypoint") | {"reached": reached, "away": away}
