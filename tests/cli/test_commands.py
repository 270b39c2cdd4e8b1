"""Every verb through the front door: JSON keys as promised, numbers of the paper, readable at 80 columns."""

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from stommel.dynamics.packing import pack, reference_water
from stommel.vehicle import PAPER, load_vehicle
from tests.support.command import Command

TRIM_KEYS = {
    "speed_m_s",
    "pitch_deg",
    "glide_path_deg",
    "angle_of_attack_deg",
    "moving_mass_position_mm",
    "ballast_volume_ml",
    "residual",
}
TURN_KEYS = TRIM_KEYS | {"roll_deg", "sideslip_deg", "turn_rate_rad_s", "radius_m"}


def test_trim(stommel: Command) -> None:
    found = stommel("trim", "zju", "--speed", 0.4, "--pitch", -35, "--json")
    assert found.status == 0
    assert set(found.json) == TRIM_KEYS
    assert found.json["moving_mass_position_mm"] == pytest.approx(408.2, abs=0.05)
    assert found.json["ballast_volume_ml"] == pytest.approx(-55.8, abs=0.06)
    assert found.json["residual"] < 1e-10
    along = stommel("trim", "zju", "--speed", 0.4, "--glide-path", found.json["glide_path_deg"], "--json")
    assert along.json["pitch_deg"] == pytest.approx(-35.0, abs=1e-9)


@pytest.mark.parametrize(
    ("options", "count"),
    [(("--speed", "0.4", "--pitch", "-5:-60:-5"), 12), (("--speed", "0.1:0.8:0.1", "--pitch", "-35"), 8)],
)
def test_table(stommel: Command, options: tuple[str, ...], count: int) -> None:
    rows = stommel("table", "zju", *options, "--json").json["rows"]
    assert len(rows) == count
    assert all(set(row) >= TRIM_KEYS for row in rows)
    shown = stommel("table", "zju", *options)
    assert shown.status == 0
    assert max(len(line) for line in shown.out.splitlines()) <= 80
    assert "408.2" in shown.out


def test_table_marks_rows_beyond_the_limits(stommel: Command) -> None:
    rows = stommel("table", "zju", "--speed", 0.4, "--pitch", "-50,-55", "--json").json["rows"]
    assert rows[0]["beyond_limits"] == []
    assert "571.8 mm" in rows[1]["beyond_limits"][0]
    assert "571.8*" in stommel("table", "zju", "--speed", 0.4, "--pitch", "-50,-55").out


def test_steady_and_turn_are_inverse(stommel: Command) -> None:
    settings = ("--moving-mass-mm", 421.67, "--ballast-ml", -292.7, "--roll-mass-deg", 45)
    flown = stommel("steady", "seawing", *settings, "--json").json
    assert set(flown) >= TURN_KEYS
    assert flown["radius_m"] == pytest.approx(100.0, rel=0.05)
    wish = ("--speed", flown["speed_m_s"], "--pitch", flown["pitch_deg"], "--turn-rate", flown["turn_rate_rad_s"])
    found = stommel("turn", "seawing", *wish, "--json").json
    assert found["roll_mass_deg"] == pytest.approx(45.0, rel=1e-6)
    assert found["ballast_volume_ml"] == pytest.approx(-292.7, rel=1e-6)
    straight = stommel("steady", "zju", "--moving-mass-mm", 408.2, "--ballast-ml", -55.8, "--json").json
    assert straight["radius_m"] is None
    assert straight["turn_rate_rad_s"] == 0.0
    assert straight["stable"] is True


def test_modes(stommel: Command) -> None:
    found = stommel("modes", "zju", "--speed", 0.4, "--pitch", -35, "--json").json
    for plane in ("longitudinal", "lateral"):
        values = np.array([mode["real"] + 1j * mode["imag"] for mode in found[plane]])
        A = np.array(found["A"][plane])
        assert A.shape == (4, 4)
        assert np.poly(values) == pytest.approx(np.poly(A), rel=1e-9)
        assert all(mode["name"] for mode in found[plane])
    assert np.array(found["B"]["longitudinal"]).shape == (4, 2)
    shown = stommel("modes", "zju", "--speed", 0.4, "--pitch", -35).out
    assert "short period" in shown
    assert max(len(line) for line in shown.splitlines()) <= 80
    assert stommel("modes", "rogue", "--speed", 0.3, "--pitch", -25, "--json").json["lateral"] is None


def test_root_locus_writes_its_plots(stommel: Command, tmp_path: Path) -> None:
    found = stommel(
        "root-locus",
        "zju",
        "--over",
        "wing_position",
        "--from",
        0,
        "--to",
        0.2,
        "--points",
        5,
        "--plot",
        "locus.svg",
        "--json",
    ).json
    assert [point["value"] for point in found["points"]] == pytest.approx([0, 0.05, 0.1, 0.15, 0.2])
    assert found["design_value"] == pytest.approx(0.15)
    design = stommel("modes", "zju", "--speed", 0.4, "--pitch", -35, "--json").json["longitudinal"]
    at_design = found["points"][3]["longitudinal"]
    assert sorted(p["real"] for p in at_design) == pytest.approx(sorted(m["real"] for m in design), rel=1e-9)
    assert found["written"] == ["locus.svg"]
    assert "<svg" in (tmp_path / "locus.svg").read_text()


def test_envelope(stommel: Command) -> None:
    found = stommel("envelope", "zju", "--json").json
    assert found["needs"]["moving_mass_travel_choice_mm"] == 300.0
    assert found["needs"]["ballast_volume_choice_ml"] == 250.0
    speeds = {row["pitch_deg"]: row["maximum_speed_m_s"] for row in found["reach"]}
    assert speeds[-35.0] > 0.8
    assert speeds[-60.0] is None
    region = stommel("envelope", "zju", "--speed", "0.2,0.3", "--pitch", "-20:-30:-5", "--json").json["needs"]
    assert region["most_volume_at"]["speed_m_s"] == pytest.approx(0.3)


def test_derivative_vanishes_in_steady_flight(stommel: Command, tmp_path: Path) -> None:
    trim = stommel("trim", "zju", "--speed", 0.4, "--pitch", -35, "--json").json
    alpha = np.radians(trim["angle_of_attack_deg"])
    state = {
        "velocity_m_s": [0.4 * np.cos(alpha), 0.0, 0.4 * np.sin(alpha)],
        "angular_velocity_rad_s": [0.0, 0.0, 0.0],
        "attitude_deg": [0.0, -35.0, 90.0],
        "moving_mass_position_m": trim["moving_mass_position_mm"] / 1e3,
        "moving_mass_rate_m_s": 0.0,
        "moving_mass_force_n": 10 * 9.81 * np.sin(np.radians(-35.0)),
        "ballast_volume_m3": trim["ballast_volume_ml"] / 1e6,
        "rudder_deg": 0.0,
    }
    path = tmp_path / "states.json"
    path.write_text(json.dumps([state, state | {"rudder_deg": 10.0}]))
    for mode in ("locked", "free"):
        still, turning = stommel("derivative", "zju", "--states", path, "--actuators", mode).json
        assert np.abs(still["acceleration_m_s2"]).max() < 1e-12
        assert np.abs(still["angular_acceleration_rad_s2"]).max() < 1e-12
        assert abs(still["moving_mass_acceleration_m_s2"]) < 1e-12
        assert still["attitude_rate_deg_s"] == [0.0, 0.0, 0.0]
        # heading 90 deg: east, and down
        north, east, down = still["inertial_velocity_m_s"]
        assert north == pytest.approx(0.0, abs=1e-12)
        assert np.degrees(np.arctan2(-down, east)) == pytest.approx(trim["glide_path_deg"], abs=1e-9)
        assert turning["angular_acceleration_rad_s2"][2] > 0.0


def test_derivative_of_a_turn_rate_at_the_zenith(stommel: Command, tmp_path: Path) -> None:
    """Straight up the Euler rates do not exist; the accelerations do."""
    path = tmp_path / "states.json"
    state = {
        "velocity_m_s": [0.4, 0, 0],
        "angular_velocity_rad_s": [0, 0.1, 0],
        "attitude_deg": [0, 90, 0],
        "moving_mass_position_m": 0.25,
    }
    path.write_text(json.dumps([state]))
    (found,) = stommel("derivative", "zju", "--states", path).json
    assert found["attitude_rate_deg_s"] is None
    assert np.isfinite(found["acceleration_m_s2"]).all()


def test_design(stommel: Command, stommel_process: Command, report_of: Callable[[str], str], tmp_path: Path) -> None:
    found = stommel_process("design", "zju", "--output", "out/report.html", "--json").json
    assert found["ranges"]["moving_mass_travel_choice_mm"] == 300.0
    # everything of Table 3 but the endurance, whose gap `stommel endurance` explains
    assert [row["name"] for row in found["specification"] if row["met"] is not True] == ["Endurance"]
    assert len(found["tables"][0]["rows"]) == 12
    # the same bytes in another process
    assert (tmp_path / "out" / "report.html").read_text(encoding="utf-8") == report_of("zju")
    shown = stommel("design", "zju", "--no-report")
    assert shown.status == 0
    assert max(len(line) for line in shown.out.splitlines()) <= 80


@pytest.mark.parametrize("name", ["rogue", "slocum", "seawing"])
def test_design_of_every_builtin_vehicle(stommel: Command, name: str) -> None:
    """What the terminal shows; tests/report reads the pages."""
    assert stommel("design", name, "--no-report").status == 0


def test_vehicles_and_new_file(stommel: Command, tmp_path: Path) -> None:
    assert [row["name"] for row in stommel("vehicles", "--json").json] == ["rogue", "seawing", "slocum", "zju"]
    assert stommel("vehicle", "new", "mine.toml").status == 0
    assert stommel("vehicle", "check", "mine.toml").status == 0
    assert stommel("vehicle", "new", "mine.toml").status == 2
    assert stommel("vehicle", "new", "mine.toml", "--from", "slocum", "--force").status == 0
    shown = stommel("vehicle", "show", "mine.toml", "--json").json
    assert shown["name"] == "mine"
    assert shown["description"]["rigid_body"] == load_vehicle("slocum").description.rigid_body.model_dump(mode="json")
    path = tmp_path / "mine.toml"
    path.write_text(path.read_text().replace("mass_kg = 40", "mass_kg = 41"))
    assert stommel("trim", "mine.toml", "--speed", 0.3, "--pitch", -23).status == 0
    assert stommel("vehicle", "show", "zju", "--toml").out.startswith("# The coastal 200 m glider")


def test_json_is_all_there_is_on_standard_output(stommel: Command) -> None:
    for arguments in (
        ("trim", "zju", "--speed", 0.4, "--pitch", -35),
        ("envelope", "slocum"),
        ("vehicle", "check", "rogue"),
    ):
        json.loads(stommel(*arguments, "--json").out)


def test_same_answer_from_library_and_command(stommel: Command) -> None:
    from stommel import trim

    ours = trim(load_vehicle("slocum"), speed_m_s=0.3, glide_path_deg=-25.0)
    found = stommel("trim", "slocum", "--speed", 0.3, "--glide-path", -25, "--json").json
    assert found["ballast_volume_ml"] == ours.V_b * 1e6
    assert pack(load_vehicle("slocum"), PAPER).g == 9.81
    assert reference_water(load_vehicle("slocum")).rho == 1000.0
