"""The flight table as a file: what a vehicle's software needs of the model, without the model.

TOML, so that a person can read what the vehicle believes of its own flight. It names the vehicle that it was computed
for by a hash; software refuses the table of another.
"""

from dataclasses import dataclass
from math import degrees, radians
from pathlib import Path
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from stommel.control.flight_table import FlightTable
from stommel.errors import FileError, Problem
from stommel.files.fields import Table
from stommel.files.ranges import between
from stommel.files.toml_reader import read_table
from stommel.files.whole import write_whole

_MOST = 200
"""Longest side of a table."""

Grid = Annotated[tuple[Annotated[float, between(0.001, 1e5)], ...], Field(min_length=2, max_length=_MOST)]
Cells = Annotated[tuple[tuple[Annotated[float, between(-1e6, 1e6)], ...], ...], Field(min_length=2, max_length=_MOST)]


@dataclass(frozen=True)
class FlightTableHeader:
    """What a flight table was computed of."""

    vehicle: str
    """Name."""
    vehicle_sha256: str
    """`stommel.vehicle.fingerprint` of the vehicle."""
    physics: str
    """Which model: paper or full."""
    density_kg_m3: float
    """Of the water."""
    stommel: str
    """Version that computed it."""


class _Way(Table):
    """Dives, or climbs: rows over pitch, columns over ballast volume."""

    moving_mass_mm: Cells
    angle_of_attack_deg: Cells
    speed_m_s: Cells
    turn_pole_per_s: Cells
    turn_drive_per_s2: Cells


class _FlightTableFile(Table):
    """A flight table, as its file describes it."""

    format: Literal[1]
    kind: Literal["flight table"]
    vehicle: Annotated[str, Field(min_length=1)]
    vehicle_sha256: Annotated[str, Field(pattern="^[0-9a-f]{64}$")]
    physics: Literal["paper", "full"]
    stommel: str
    density_kg_m3: Annotated[float, between(900, 1200)]
    drag_per_mass_per_m: Annotated[float, between(1e-6, 10)]
    pitch_deg: Grid
    ballast_ml: Grid
    dive: _Way
    climb: _Way

    @model_validator(mode="after")
    def _is_even_and_whole(self) -> Self:
        for key in ("pitch_deg", "ballast_ml"):
            steps = np.diff(getattr(self, key))
            if steps.min() <= 0.0 or np.ptp(steps) > 1e-6 * steps.max():
                raise ValueError(f"{key}: must rise in even steps")
        for way in ("dive", "climb"):
            for name, rows in getattr(self, way):
                if len(rows) != len(self.pitch_deg) or any(len(row) != len(self.ballast_ml) for row in rows):
                    wanted = f"{len(self.pitch_deg)} rows of {len(self.ballast_ml)} numbers"
                    raise ValueError(f"{way}.{name}: must be {wanted}, for pitch_deg and ballast_ml")
        return self


def flight_table_text(table: FlightTable, header: FlightTableHeader) -> str:
    """Text of a flight-table file."""
    import tomlkit  # noqa: PLC0415 - only who writes a table needs it

    document = tomlkit.document()
    document.add(tomlkit.comment("Flight table: what the vehicle's software knows of its own flight."))
    document.add(tomlkit.comment("Rows are pitches, columns are ballast volumes; a dive's are negative, both."))
    document.update({"format": 1, "kind": "flight table", **vars(header)})
    document["drag_per_mass_per_m"] = table.drag_per_mass
    document["pitch_deg"] = [degrees(theta) for theta in table.theta]
    document["ballast_ml"] = [1e6 * float(V_b) for V_b in table.V_b]
    for way, name in enumerate(("dive", "climb")):
        cells = tomlkit.table()
        for key, values in _cells(table, way).items():
            rows = tomlkit.array()
            rows.extend(values.tolist())
            cells[key] = rows.multiline(True)
        document[name] = cells
    return tomlkit.dumps(document)


def _cells(table: FlightTable, way: int) -> dict[str, Any]:
    return {
        "moving_mass_mm": 1e3 * table.r_px[way],
        "angle_of_attack_deg": np.degrees(table.alpha[way]),
        "speed_m_s": table.speed[way],
        "turn_pole_per_s": table.turn_pole[way],
        "turn_drive_per_s2": table.turn_drive[way],
    }


def write_flight_table(path: Path, table: FlightTable, header: FlightTableHeader) -> None:
    """Write a flight table, whole or not at all.

    Raises
    ------
    OutputError
        The file cannot be written; what stood there before still does.
    """
    write_whole(path, flight_table_text(table, header))


def read_flight_table(path: str | Path, vehicle_sha256: str | None = None) -> tuple[FlightTable, FlightTableHeader]:
    """Read a flight table, of the vehicle with this hash if one is given.

    Raises
    ------
    FileError
        The file cannot be read, is no flight table, or is one of another vehicle.
    """
    file = read_table(path, _FlightTableFile)
    if vehicle_sha256 is not None and file.vehicle_sha256 != vehicle_sha256:
        text = (
            f"vehicle_sha256 = {file.vehicle_sha256[:12]}...: the table is of another vehicle than "
            f"{vehicle_sha256[:12]}...; write it anew with `stommel flight-table`"
        )
        raise FileError([Problem(str(path), "vehicle_sha256", text)])
    ways = (file.dive, file.climb)
    table = FlightTable(
        theta=np.radians(file.pitch_deg),
        V_b=np.array(file.ballast_ml) / 1e6,
        r_px=np.array([way.moving_mass_mm for way in ways]) / 1e3,
        alpha=np.array([[[radians(cell) for cell in row] for row in way.angle_of_attack_deg] for way in ways]),
        speed=np.array([way.speed_m_s for way in ways]),
        turn_pole=np.array([way.turn_pole_per_s for way in ways]),
        turn_drive=np.array([way.turn_drive_per_s2 for way in ways]),
        drag_per_mass=file.drag_per_mass_per_m,
    )
    return table, FlightTableHeader(file.vehicle, file.vehicle_sha256, file.physics, file.density_kg_m3, file.stommel)
