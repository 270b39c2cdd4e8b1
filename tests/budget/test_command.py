"""`stommel budget` as its users run it; bad parts are named; the example of the guide runs."""

from pathlib import Path

import pytest

from tests.support.command import Command
from tests.support.pages import commands, guide

GUIDE = guide("budget")


def test_json_sums_to_60_kg(stommel: Command) -> None:
    found = stommel("budget", "zju", "--json", "--plot", "plots/budget.png")
    assert found.status == 0
    assert found.json["total_mass_kg"] == pytest.approx(60.0)
    assert found.json["displaced_volume_ml"] == pytest.approx(60000.0)
    assert [bay["flooded"] for bay in found.json["bays"]] == [True, False, False, False, True]
    assert found.json["rigid_body"]["mass_kg"] == pytest.approx(45.0)
    assert found.json["written"] == ["plots/budget.png"]


def test_terminal_fits_80_columns(stommel: Command) -> None:
    for density in ("1000", "1025", "990", "1010:1027"):
        found = stommel("budget", "zju", "--density", density)
        assert found.status == 0
        assert max(map(len, found.out.splitlines())) <= 80


def test_apply_writes_a_sound_vehicle_and_overwrites_only_by_force(stommel: Command, tmp_path: Path) -> None:
    assert stommel("budget", "zju", "--apply", "mine.toml").status == 0
    assert stommel("vehicle", "check", "mine.toml").status == 0
    written = (tmp_path / "mine.toml").read_bytes()
    (tmp_path / "mine.toml").write_bytes(b"mine")
    refused = stommel("budget", "zju", "--apply", "mine.toml")
    assert refused.status == 2
    assert refused.out == ""
    assert "already exists; --force replaces it" in refused.err
    assert (tmp_path / "mine.toml").read_bytes() == b"mine"
    assert stommel("budget", "zju", "--apply", "mine.toml", "--force").status == 0
    assert (tmp_path / "mine.toml").read_bytes() == written
    assert [path.name for path in tmp_path.iterdir()] == ["mine.toml"]


def test_a_heavy_budget_is_reported_but_not_applied(stommel: Command, tmp_path: Path) -> None:
    text = stommel("vehicle", "show", "zju", "--toml").out
    (tmp_path / "heavy.toml").write_text(text.replace("mass_kg = 8.6", "mass_kg = 9.6", 1))
    found = stommel("budget", "heavy.toml")
    assert found.status == 0
    assert "does_not_float" in found.out
    refused = stommel("budget", "heavy.toml", "--apply", "out.toml")
    assert refused.status == 2
    assert refused.out == ""
    assert not (tmp_path / "out.toml").exists()


BATTERY = 'name = "battery package"\nbay = "pitch control bay (front)"'


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (BATTERY, BATTERY.replace("pitch control bay (front)", "attic"), ["'attic'", "unknown bay", "'wet nose'"]),
        (
            "position_m = [0.25, 0, 0]",
            "position_m = [0.05, 0, 0]",
            ["-0.03 to 0.13 m", "outside its bay", "0 to 0.75 m"],
        ),
        ("position_m = [0.25, 0, 0]", "position_m = [0.25, 0, 0.05]", ["outside the hull", "0.105 m"]),
        ("mass_kg = 8.6", "mass_kg = -8.6", ["mass_kg = -8.6: must be 0, or between 0.001 and 1000 kg"]),
        ("mass_kg = 8.6", "mass_kg = 8.6\nballast = true", ["either moving or ballast"]),
        ("diameter_mm = 172\n", "", ["length_mm and diameter_mm go together"]),
        ('name = "carriage with nut"', 'name = "battery package"', ["another part has this name"]),
        ("mass_kg = 8.6", "mass = 8.6", ["unknown key", "did you mean mass_kg"]),
        ("mass_kg = 8.6", "mass_kg = 8.6\nbox_mm = [1, 2, 3]", ["either a box"]),
        ("inner_diameter_mm = 172", "inner_diameter_mm = 190", ["must be less than diameter_mm"]),
    ],
)
def test_bad_parts_are_refused(stommel: Command, tmp_path: Path, old: str, new: str, words: list[str]) -> None:
    text = stommel("vehicle", "show", "zju", "--toml").out
    assert old in text
    (tmp_path / "bad.toml").write_text(text.replace(old, new, 1))
    found = stommel("budget", "bad.toml")
    assert found.status == 2
    assert found.out == ""
    assert all(line.startswith("error: bad.toml: ") for line in found.err.splitlines())
    for word in words:
        assert word in found.err


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("budget", "rogue"), ["rogue.toml", "[[parts]]"]),
        (("budget", "zju", "--density", "salty"), ["--density = 'salty'", "1010:1027"]),
        (("budget", "zju", "--density", "1:2:3"), ["--density = '1:2:3'"]),
        (("budget", "zju", "--density", "1027:1010"), ["1027:1010"]),
        (("budget", "zju", "--density", "5"), ["at least 900"]),
        (("budget", "zju", "--foam-density", "0"), ["--foam-density = 0: must be between 10 and 950 kg/m3"]),
    ],
)
def test_refused(stommel: Command, arguments: tuple[object, ...], words: list[str]) -> None:
    found = stommel(*arguments)
    assert found.status == 2
    assert found.out == ""
    assert len(found.err.splitlines()) == 1
    for word in words:
        assert word in found.err


def test_the_guide_runs(stommel: Command) -> None:
    calls = commands(GUIDE, "budget")
    assert calls
    for arguments in calls:
        assert stommel(*arguments).status == 0, arguments
