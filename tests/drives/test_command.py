"""`stommel drives` as its users run it; the example of the guide runs."""

from pathlib import Path

import pytest

from tests.support.command import Command
from tests.support.pages import commands, guide

GUIDE = guide("drives")


def test_json_answers_the_issue(stommel: Command) -> None:
    found = stommel("drives", "zju", "--json", "--plot", "plots/drives.svg")
    assert found.status == 0
    pitch, rudder = found.json["pitch"], found.json["rudder"]
    assert pitch["self_locking"] is True
    assert pitch["hardest_start"]["starts"] is True
    assert abs(pitch["hardest_start"]["pitch_deg"]) == 50.0
    assert pitch["dive_to_climb"]["travel_mm"] == pytest.approx(316.3, abs=0.1)
    assert {point["pitch_deg"] for point in pitch["points"]} >= {-50.0, -35.0, 0.0, 35.0, 50.0}
    up = next(p for p in pitch["points"] if p["pitch_deg"] == 35.0 and p["direction"] == "forward")
    down = next(p for p in pitch["points"] if p["pitch_deg"] == 35.0 and p["direction"] == "aft")
    assert up["uphill"]
    assert not down["uphill"]
    assert up["energy_j_per_mm"] > down["energy_j_per_mm"] > 0.0
    assert all(run["caught"] for run in pitch["over_runs"])
    assert rudder["turn"]["hold_energy_j"] == 0.0
    assert found.json["warnings"] == []
    assert found.json["written"] == ["plots/drives.svg"]


def test_terminal_fits_80_columns(stommel: Command) -> None:
    found = stommel("drives", "zju")
    assert found.status == 0
    assert max(map(len, found.out.splitlines())) <= 80
    assert "holds the mass without power" in found.out


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("drives", "rogue"), ["rogue.toml", "[drives.pitch]"]),
        (("drives", "zju", "--steepest", 0), ["--steepest = 0: must be between 0.1 and 90 deg"]),
        (("drives", "zju", "--speed", -1), ["--speed = -1: must be between 0.005 and 5 m/s"]),
        (("drives", "zju", "--hold", -1), ["--hold = -1: must be between 0 and 10000 s"]),
    ],
)
def test_refused(stommel: Command, arguments: tuple[object, ...], words: list[str]) -> None:
    found = stommel(*arguments)
    assert found.status == 2
    assert found.out == ""
    assert len(found.err.splitlines()) == 1
    for word in words:
        assert word in found.err


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("stops_mm = { value = [-60, 560]", "stops_mm = { value = [-50, 560]", "must lie outside switches_mm"),
        (
            "lead_angle_deg = { value = 3.6",
            "lead_angle_deg = { value = 50",
            "must be at least 0.05 and less than 45 degrees",
        ),
        (
            "resistance_ohm = 20",
            "resistance_ohm = -20",
            "drives.pitch.motor.resistance_ohm = -20: must be between 0.001 and 2000 ohm",
        ),
        ("gearbox_efficiency = { value = 0.5", "gearbox_efficiency = { value = 1.5", "between 0.01 and 1"),
    ],
)
def test_bad_tables_name_key_value_and_range(
    stommel: Command,
    tmp_path: Path,
    old: str,
    new: str,
    words: str,
) -> None:
    text = stommel("vehicle", "show", "zju", "--toml").out
    assert old in text
    (tmp_path / "bad.toml").write_text(text.replace(old, new, 1))
    found = stommel("drives", "bad.toml")
    assert found.status == 2
    assert found.out == ""
    assert words in found.err


def test_the_guide_runs(stommel: Command) -> None:
    calls = commands(GUIDE, "drives")
    assert calls
    for arguments in calls:
        assert stommel(*arguments).status == 0, arguments
