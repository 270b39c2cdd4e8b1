"""The flight table as a file: what is written is read back, and only for its own vehicle."""

import json
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from stommel.analysis.flight_table import flight_table
from stommel.cli.app import app
from stommel.control.flight_table_file import FlightTableHeader, flight_table_text, read_flight_table
from stommel.errors import FileError
from stommel.vehicle import load_vehicle
from stommel.vehicle.fingerprint import fingerprint

ZJU = load_vehicle("zju")
HEADER = FlightTableHeader("zju", fingerprint(ZJU), "full", 1000.0, "0")


@pytest.fixture(scope="module")
def text() -> str:
    return flight_table_text(flight_table(ZJU), HEADER)


def test_round_trip(text: str, tmp_path: Path) -> None:
    path = tmp_path / "table.toml"
    path.write_text(text)
    found, header = read_flight_table(path, fingerprint(ZJU))
    assert header == HEADER
    for name, values in flight_table(ZJU)._asdict().items():
        np.testing.assert_allclose(getattr(found, name), values, rtol=1e-14, err_msg=name)


def test_command_writes_what_software_reads(tmp_path: Path) -> None:
    path = tmp_path / "zju-flight.toml"
    done = CliRunner().invoke(app, ["flight-table", "zju", "--output", str(path), "--json"])
    assert done.exit_code == 0, done.output
    answer = json.loads(done.stdout)
    table, header = read_flight_table(path, answer["vehicle_sha256"])
    assert (header.vehicle, header.physics) == (ZJU.name, "full")
    flights = {(round(row["pitch_deg"]), round(row["ballast_ml"], 3)): row for row in answer["flights"]}
    i, j = 3, 5
    row = flights[-round(np.degrees(table.theta[i])), round(-1e6 * table.V_b[j], 3)]
    assert row["moving_mass_mm"] == pytest.approx(1e3 * table.r_px[0, i, j], rel=1e-12)
    assert row["speed_m_s"] == pytest.approx(table.speed[0, i, j], rel=1e-12)


def test_fingerprint_tells_vehicles_apart() -> None:
    assert fingerprint(ZJU) == fingerprint(load_vehicle("zju"))
    assert fingerprint(ZJU) != fingerprint(ZJU.with_value("moving_mass.mass_kg", 10.9))


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("format = 1", "format = 2", "format = 2: must be 1"),
        ('kind = "flight table"', 'kind = "vehicle"', "kind"),
        ("[dive]", "[dive]\nspeed_knots = [[1.0]]", "speed_knots"),
        ("[climb]", "[descent]", "descent"),
        ("pitch_deg = [", "pitch_deg = [1.0, ", "pitch_deg"),
        ("ballast_ml = [", "ballast_ml = [-5.0, ", "ballast_ml"),
        ("drag_per_mass_per_m = ", "drag_per_mass_per_m = 1e9 #", "drag_per_mass_per_m"),
    ],
)
def test_damaged_tables_are_refused(text: str, tmp_path: Path, old: str, new: str, words: str) -> None:
    path = tmp_path / "table.toml"
    assert old in text
    path.write_text(text.replace(old, new, 1))
    with pytest.raises(FileError, match=r"table\.toml: ") as refused:
        read_flight_table(path)
    assert words in str(refused.value)


def test_table_of_another_vehicle_is_refused(text: str, tmp_path: Path) -> None:
    path = tmp_path / "table.toml"
    path.write_text(text)
    with pytest.raises(FileError, match="the table is of another vehicle"):
        read_flight_table(path, "0" * 64)
