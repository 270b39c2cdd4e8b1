"""Bad input on purpose: exit status 2, one clear line, nothing on standard output, nothing half-written."""

import json
from pathlib import Path

import pytest

from tests.support.command import Command, Outcome


def refused(found: Outcome, *words: str) -> None:
    assert found.status == 2, found
    assert found.out == ""
    assert len(found.err.splitlines()) == 1, found.err
    assert found.err.startswith("error: ")
    for word in words:
        assert word in found.err


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("trim", "zju", "--speed", 5, "--pitch", -35), ["not reachable", "nearest reachable"]),
        (("trim", "zju", "--speed", 0.4, "--pitch", -90), ["pitch = -90 deg", "between -90 and 90"]),
        (("trim", "zju", "--speed", -1, "--pitch", -35), ["--speed = -1: must be between 0.005 and 5 m/s"]),
        (("trim", "zju", "--speed", "fast", "--pitch", -35), ["--speed"]),
        (("trim", "slocum", "--speed", 0.4), ["give --pitch", "specification.design_pitch_deg"]),
        (("trim", "zju", "--speed", 0.4, "--pitch", -35, "--glide-path", -30), ["not both"]),
        (("trim", "zjoo", "--speed", 0.4, "--pitch", -35), ["zjoo", "built-in: rogue, seawing, slocum, zju"]),
        (("trim", "zju", "--sped", 0.4), ["No such option", "--speed"]),
        (("trmi", "zju"), ["trmi"]),
        (("table", "zju", "--speed", "0.1:0.8:-0.1", "--pitch", -35), ["--speed", "never lead"]),
        (("table", "zju", "--speed", "a", "--pitch", -35), ["--speed", "range like first:last:step"]),
        (("table", "zju", "--speed", "0:1:1e-9", "--pitch", -35), ["at most 20000"]),
        (
            ("steady", "rogue", "--moving-mass-mm", 4, "--ballast-ml", -350, "--rudder-deg", 3),
            ["lateral plane", "sway_kg"],
        ),
        (("steady", "zju", "--moving-mass-mm", 408, "--ballast-ml", -55, "--roll-mass-deg", 3), ["offset_m is 0"]),
        (("steady", "zju", "--moving-mass-mm", 700, "--ballast-ml", -55), ["limits are -50 to 550"]),
        (("turn", "zju", "--speed", 0.4, "--pitch", -35), ["turn rate or a radius"]),
        (("turn", "zju", "--speed", 0.4, "--pitch", -35, "--turn-rate", 0), ["other than zero"]),
        (("turn", "slocum", "--speed", 0.3, "--pitch", -23, "--turn-rate", 0.01), ["rudder nor by rolling"]),
        (("root-locus", "zju", "--over", "wing.colour", "--from", 0, "--to", 1), ["wing.colour", "no number"]),
        (("root-locus", "zju", "--over", "wing_position", "--from", 0, "--to", 0), ["two different"]),
        (("root-locus", "zju", "--over", "moving_mass.mass_kg", "--from", -5, "--to", 5), ["between 0.02 and 1000 kg"]),
        (("envelope", "rogue"), ["[actuators.buoyancy]"]),
        (("envelope", "zju", "--speed", 0.4), ["go together"]),
        (("derivative", "zju", "--states", "nowhere.json"), ["nowhere.json", "No such file"]),
        (("vehicle", "new", "no.toml", "--from", "sub"), ["--from sub"]),
        (("vehicle", "new", "x" * 400), ["FILE xxx", "cannot be written: File name too long"]),
    ],
)
def test_refused(stommel: Command, arguments: tuple[object, ...], words: list[str]) -> None:
    refused(stommel(*arguments), *words)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("[", ["not valid JSON"]),
        ("{}", ["must be a list of states"]),
        ('[{"velocity_m_s": [0.4, 0, 0]}]', ["angular_velocity_rad_s"]),
        ('[{"velocity_m_s": [0.4, 0, NaN]}]', ["states.json"]),
    ],
)
def test_bad_state_files(stommel: Command, tmp_path: Path, content: str, words: list[str]) -> None:
    path = tmp_path / "states.json"
    path.write_text(content)
    found = stommel("derivative", "zju", "--states", path)
    assert found.status == 2
    assert found.out == ""
    for word in words:
        assert word in found.err


def test_unknown_key_in_a_state(stommel: Command, tmp_path: Path) -> None:
    state = {
        "velocity_m_s": [0.4, 0, 0],
        "angular_velocity_rad_s": [0, 0, 0],
        "attitude_deg": [0, 0, 0],
        "moving_mass_position_m": 0.25,
        "ruder_deg": 3,
    }
    path = tmp_path / "states.json"
    path.write_text(json.dumps([state]))
    refused(stommel("derivative", "zju", "--states", path), "0.ruder_deg", "did you mean rudder_deg")


def test_sideways_state_of_a_vehicle_without_a_lateral_plane(stommel: Command, tmp_path: Path) -> None:
    state = {
        "velocity_m_s": [0.4, 0.1, 0],
        "angular_velocity_rad_s": [0, 0, 0],
        "attitude_deg": [0, 0, 0],
        "moving_mass_position_m": 0.0,
    }
    path = tmp_path / "states.json"
    path.write_text(json.dumps([state]))
    refused(stommel("derivative", "rogue", "--states", path), "lateral plane")


def test_bad_vehicle_file_names_every_problem(stommel: Command, tmp_path: Path) -> None:
    text = stommel("vehicle", "show", "zju", "--toml").out
    (tmp_path / "bad.toml").write_text(
        text.replace("mass_kg = 45", "mass = 45").replace("heave_kg = 70", "heave_kg = -7")
    )
    found = stommel("vehicle", "check", "bad.toml")
    assert found.status == 2
    assert found.out == ""
    lines = found.err.splitlines()
    assert len(lines) == 3
    assert all(line.startswith("error: bad.toml: ") for line in lines)


def test_unwritable_output_leaves_nothing(stommel: Command, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    for arguments in (
        ("design", "rogue", "--output", "file/report.html"),
        (
            "root-locus",
            "zju",
            "--over",
            "wing_position",
            "--from",
            0,
            "--to",
            0.2,
            "--points",
            2,
            "--plot",
            "file/locus.png",
        ),
        ("vehicle", "new", "file/mine.toml"),
    ):
        refused(stommel(*arguments), "cannot be written")
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_output_that_is_a_folder(stommel: Command, tmp_path: Path) -> None:
    (tmp_path / "folder").mkdir()
    refused(stommel("design", "rogue", "--output", "folder"), "is a folder")
    assert list((tmp_path / "folder").iterdir()) == []
