"""The orders as a file: everything that a vehicle's software is told of one mission, its flight table included.

TOML in SI units and radians, as the software holds them: a number comes back to the last bit, and a mission flown from
the file is the mission flown from memory. Beside angles and volumes a comment says what people call them. It names the
vehicle that it was made for by a hash; software refuses the orders of another.
"""

from dataclasses import asdict, dataclass
from math import degrees, inf, isfinite, nan
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from stommel.control.dive_cycle import PHASES, DivePlan
from stommel.control.flight_table import FlightTable
from stommel.control.laws import DriftLaw, HeadingLaw, PitchLaw
from stommel.control.orders import Alarms, Laws, Orders
from stommel.control.orders_tables import OrdersFile
from stommel.errors import FileError, Problem
from stommel.files.opening import TOML_MIB, read_text
from stommel.files.sentences import validated
from stommel.files.toml_reader import parse_toml
from stommel.files.units import unit_of
from stommel.files.whole import write_whole

if TYPE_CHECKING:
    from tomlkit.items import Table as WrittenTable

DIVES = {
    "depth_m": "depth",
    "turns_early_m": "turns_early",
    "pitch_rad": "theta",
    "ballast_dive_m3": "V_b_dive",
    "ballast_climb_m3": "V_b_climb",
    "ballast_surface_m3": "V_b_surface",
    "ballast_drift_m3": "V_b_drift",
    "moving_mass_drift_m": "r_px_drift",
    "moving_mass_surface_m": "r_px_surface",
    "surface_s": "surface_time",
    "longest_surface_s": "longest_surface_time",
    "drift_s": "drift_time",
    "surfacing_interval_s": "surfacing_interval",
    "least_altitude_m": "least_altitude",
    "surfaced_depth_m": "shallow_depth",
    "per_surfacing": "dives_per_surfacing",
    "turn_depth_m": "turn_depth",
    "abort_depth_m": "abort_depth",
    "abort_time_s": "abort_time",
}
PITCH = {"gain_m_per_rad": "gain", "dead_band_rad": "dead_band", "period_s": "period", "tolerance_m": "tolerance"}
HEADING = {"response_s": "response", "dead_band_rad": "dead_band", "limit_rad": "limit"}
DRIFT = {
    "gain_m3_s_m": "gain",
    "return_time_s": "return_time",
    "fastest_m_s": "fastest",
    "dead_band_m": "dead_band",
    "period_s": "period",
}
ALARMS = {"energy_j": "energy", "leak": "leak", "internal_pressure_pa": "internal_pressure"}
WAYS = {
    "moving_mass_m": "r_px",
    "angle_of_attack_rad": "alpha",
    "speed_m_s": "speed",
    "turn_pole_per_s": "turn_pole",
    "turn_drive_per_s2": "turn_drive",
}
"""What the file calls the fields of the orders, table by table. What is infinite or no number is left out."""


@dataclass(frozen=True)
class OrdersHeader:
    """What orders were made of."""

    mission: str
    """Name."""
    created_from: str
    """Name of the mission's file."""
    vehicle: str
    """Name."""
    vehicle_sha256: str
    """`stommel.vehicle.fingerprint` of the vehicle."""
    physics: str
    """Which model: paper or full."""
    density_kg_m3: float
    """Of the water that the flight table is for."""
    stommel: str
    """Version that made them."""
    expires_hours: float | None = None
    """The mission expires so long after its start; None: never."""
    sample_every_s: float | None = None
    """Between two samples of the CTD; None: as the vehicle's configuration says."""


def orders_text(orders: Orders, header: OrdersHeader, origin: str = "orders") -> str:
    """Text of an orders file; `origin` names it in messages.

    Raises
    ------
    FileError
        The orders hold what no orders file may: one problem for each number that is out of its range.
    """
    import tomlkit  # noqa: PLC0415 - only who writes orders needs it

    described = _described(orders, header)
    validated(described, OrdersFile, origin)
    document = tomlkit.document()
    document.add(tomlkit.comment("Orders: what the vehicle's software is told of one mission. SI units and radians."))
    for key, value in described.items():
        document[key] = _table(value) if isinstance(value, dict) else _item(key, value)
    return tomlkit.dumps(document)


def _described(orders: Orders, header: OrdersHeader) -> dict[str, Any]:
    """Plain values of an orders file."""
    table = orders.table
    told = {
        "format": 1,
        "kind": "orders",
        **{key: value for key, value in asdict(header).items() if value is not None},
        "step_s": float(orders.step),
        "guidance_every": int(orders.guidance_every),
        "sampled_phases": [name for name, on in zip(PHASES, orders.sampled, strict=True) if on],
        "waypoints_rad": orders.waypoints.tolist(),
        "acceptance_radius_m": float(orders.radius),
        "lookahead_m": float(orders.lookahead),
        "dives": _named(orders.dives, DIVES),
        "pitch_control": _named(orders.laws.pitch, PITCH),
        "heading_control": _named(orders.laws.heading, HEADING),
        "drift_control": _named(orders.laws.drift, DRIFT),
        "alarms": _named(orders.alarms, ALARMS),
        "flight_table": {
            "drag_per_mass_per_m": float(table.drag_per_mass),
            "pitch_rad": table.theta.tolist(),
            "ballast_m3": table.V_b.tolist(),
        },
    }
    told["dives"]["per_surfacing"] = int(orders.dives.dives_per_surfacing)
    for way, name in enumerate(("dive", "climb")):
        told["flight_table"][name] = {key: getattr(table, field)[way].tolist() for key, field in WAYS.items()}
    return told


def _named(fields: Any, names: dict[str, str]) -> dict[str, Any]:
    """Values of a named tuple under the names of the file, those that are finite."""
    values = {key: getattr(fields, field) for key, field in names.items()}
    return {key: value if isinstance(value, bool) else float(value) for key, value in values.items() if isfinite(value)}


def _table(values: dict[str, Any]) -> "WrittenTable":
    import tomlkit  # noqa: PLC0415

    table = tomlkit.table()
    for key, value in values.items():
        table[key] = _table(value) if isinstance(value, dict) else _item(key, value)
    return table


def _item(key: str, value: Any) -> Any:
    """A value as TOML; one row of a list of lists a line, and words behind an angle or a volume."""
    import tomlkit  # noqa: PLC0415

    item = tomlkit.item(value)
    if isinstance(value, list) and value and isinstance(value[0], list):
        return item.multiline(True)
    unit = unit_of(key) if isinstance(value, float) else None
    if unit == "rad":
        item.comment(f"{degrees(value):.6g} deg")
    elif unit == "m3":
        item.comment(f"{1e6 * value:.6g} ml")
    return item


def write_orders(path: Path, orders: Orders, header: OrdersHeader) -> None:
    """Write orders, whole or not at all.

    Raises
    ------
    FileError
        The orders hold what no orders file may.
    OutputError
        The file cannot be written; what stood there before still does.
    """
    write_whole(path, orders_text(orders, header, str(path)))


def read_orders(path: str | Path, vehicle_sha256: str | None = None) -> tuple[Orders, OrdersHeader]:
    """Read orders, for the vehicle with this hash if one is given.

    Raises
    ------
    FileError
        The file cannot be read, is no orders file, or is one for another vehicle.
    """
    return parse_orders(read_text(path, TOML_MIB), str(path), vehicle_sha256)


def parse_orders(text: str, origin: str, vehicle_sha256: str | None = None) -> tuple[Orders, OrdersHeader]:
    """Return the orders of a text; `origin` names it in messages.

    Raises
    ------
    FileError
        The text is no orders file, or is one for another vehicle.
    """
    file = validated(parse_toml(text, origin), OrdersFile, origin)
    if vehicle_sha256 is not None and file.vehicle_sha256 != vehicle_sha256:
        words = (
            f"vehicle_sha256 = {file.vehicle_sha256[:12]}...: the orders are for another vehicle than "
            f"{vehicle_sha256[:12]}...; make them anew with `stommel orders`"
        )
        raise FileError([Problem(origin, "vehicle_sha256", words)])
    header = OrdersHeader(
        file.mission, file.created_from, file.vehicle, file.vehicle_sha256, file.physics, file.density_kg_m3,
        file.stommel, file.expires_hours, file.sample_every_s,
    )  # fmt: skip
    return _orders_of(file), header


def _orders_of(file: OrdersFile) -> Orders:
    return Orders(
        step=file.step_s,
        guidance_every=file.guidance_every,
        dives=DivePlan(**_fields(file.dives, DIVES, surfacing_interval=inf, r_px_surface=nan)),
        laws=Laws(
            PitchLaw(**_fields(file.pitch_control, PITCH)),
            HeadingLaw(**_fields(file.heading_control, HEADING)),
            DriftLaw(**_fields(file.drift_control, DRIFT)),
        ),
        table=_flight_table(file),
        waypoints=np.array(file.waypoints_rad, dtype=float).reshape(-1, 2),
        radius=file.acceptance_radius_m,
        lookahead=file.lookahead_m,
        alarms=Alarms(**_fields(file.alarms, ALARMS, energy=inf, internal_pressure=inf)),
        sampled=np.array([float(phase in file.sampled_phases) for phase in PHASES]),
    )


def _fields(table: Any, names: dict[str, str], **left_out: float) -> dict[str, Any]:
    """Fields of a named tuple from a table of the file; `left_out` are those that it may leave out."""
    values = {field: getattr(table, key) for key, field in names.items()}
    filled = {field: left_out.get(field) if value is None else value for field, value in values.items()}
    if "dives_per_surfacing" in filled:
        filled["dives_per_surfacing"] = float(table.per_surfacing)
    return filled


def _flight_table(file: OrdersFile) -> FlightTable:
    table = file.flight_table
    ways = (table.dive, table.climb)
    return FlightTable(
        theta=np.array(table.pitch_rad),
        V_b=np.array(table.ballast_m3),
        drag_per_mass=table.drag_per_mass_per_m,
        **{field: np.array([getattr(way, key) for way in ways]) for key, field in WAYS.items()},
    )
