"""`stommel vehicle config`: the configuration of a vehicle's software, begun from the vehicle's file."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.options import ForceOption, JsonOption, VehicleArgument, load
from stommel.cli.paths import folder_parser, refuse_existing

if TYPE_CHECKING:
    from stommel.onboard.coordination.config.configuration_file import ConfigurationFile
    from stommel.simulation.setup import Setup
    from stommel.vehicle import Vehicle

NAME = "CONFIG.toml"
_UNRATED_M = 100.0
"""Depth of the dive that the numbers are taken of, where the vehicle's file states no rating."""
_PORTS = {"compass": "/dev/ttyUSB0", "gnss": "/dev/ttyUSB1", "radio": "/dev/ttyUSB2"}


def vehicle_config(
    vehicle: VehicleArgument,
    output: Annotated[
        Path,
        typer.Option(
            "--output", metavar="FOLDER", parser=folder_parser("--output"), help=f"Folder to write {NAME} in."
        ),
    ],
    force: ForceOption = False,
    as_json: JsonOption = False,
) -> None:
    """Begin the configuration of a vehicle's software: commented, its limits from the vehicle's file.

    Example: stommel vehicle config zju --output build/zju
    """
    from stommel.files.whole import write_whole
    from stommel.onboard.coordination.config.text import configuration_text

    path = output / NAME
    refuse_existing(path, force)
    glider = load(vehicle)
    file = _begun(glider, _setup(vehicle, glider))
    write_whole(path, configuration_text(file))
    finish(file.model_dump(mode="json"), [path], as_json, lambda _: _show(path, glider))


def _show(path: Path, vehicle: "Vehicle") -> None:
    typer.echo(f"begun for {vehicle.name}: name its ports and the calibration of its compass in {path}")


def _setup(name: str, vehicle: "Vehicle") -> "Setup":
    """The vehicle on a dive to its rating: limits and positions are those that the loop would fly it with."""
    from stommel.simulation.scenario.loading import mission_from
    from stommel.simulation.setup import prepare

    return prepare(mission_from(_dive(name, vehicle), f"configuration of {name}", Path(), vehicle=vehicle))


def _dive(name: str, vehicle: "Vehicle") -> dict[str, Any]:
    from stommel.planning.vehicle_limits import depth_rating

    description = vehicle.description
    buoyancy, specification = description.actuators.buoyancy, description.specification
    depth = depth_rating(vehicle) or _UNRATED_M
    dives: dict[str, Any] = {"depth_m": depth, "speed_m_s": 0.3}
    if buoyancy is not None:
        low, high = buoyancy.range_ml
        dives = {"depth_m": depth, "ballast_ml": 0.8 * min(-low, high)}
    dives["pitch_deg"] = min(30.0, specification.pitch_deg) if specification else 30.0
    return {
        "name": "configuration",
        "vehicle": name,
        "start_time": "2026-01-01T00:00:00Z",
        "duration_days": 1.0,
        "start": {"latitude_deg": 0.0, "longitude_deg": 0.0},
        "waypoints": [{"latitude_deg": 1.0, "longitude_deg": 0.0}],
        "dives": dives,
        "ocean": {"name": "still"},
    }


def _begun(vehicle: "Vehicle", setup: "Setup") -> "ConfigurationFile":
    """The tables of the configuration."""
    from stommel.files.sentences import validated
    from stommel.onboard.coordination.config.configuration_file import ConfigurationFile
    from stommel.planning.vehicle_limits import vehicle_limits
    from stommel.sitl.equipment import actuator_limits, safety_limits

    actuators, safety = actuator_limits(setup), safety_limits(setup)
    battery = vehicle.description.battery
    usable = None if battery is None else battery.usable_fraction
    document: dict[str, Any] = {
        "format": 1,
        "kind": "vehicle configuration",
        "vehicle": vehicle.name,
        "vehicle_id": 1,
        "limits": vehicle_limits(vehicle),
        "positions": {
            "nose_up_mm": _rounded(1e3 * actuators.r_px_nose_up),
            "surface_mm": _rounded(1e3 * actuators.r_px_surface),
            "calling_mm": _rounded(1e3 * actuators.r_px_calling),
            "tolerance_mm": _rounded(1e3 * actuators.hold_mass),
            "drop_weight": setup.equipment.plant.drop_weight > 0.0,
        },
        **{table: {"port": port} for table, port in _PORTS.items()},
        "safety": {
            "submerged_depth_m": _rounded(safety.submerged_depth),
            "longest_submerged_hours": _rounded(safety.longest_submerged / 3600.0),
            "turning_time_s": _rounded(safety.turning_time),
            "least_voltage_v": _rounded(safety.least_voltage),
            "lowest_voltage_v": _rounded(safety.lowest_voltage),
            "greatest_voltage_v": _rounded(safety.greatest_voltage),
            "greatest_current_a": _rounded(safety.greatest_current),
            "vacuum_lost_kpa": _rounded(safety.vacuum_lost / 1e3),
            "hull_flooding_kpa": _rounded(safety.hull_flooding / 1e3),
        },
        "power": {} if usable is None else {"reserve": _rounded(1.0 - usable)},
    }
    return validated(document, ConfigurationFile, f"configuration of {vehicle.name}")


def _rounded(value: float) -> float:
    return float(round(value, 3))
