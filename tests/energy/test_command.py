"""`stommel endurance` through the front door: JSON, terminal, plots, and every refusal."""

import re
from pathlib import Path

import pytest

from stommel.vehicle import builtin_text
from tests.support.command import Command, Outcome

KEYS = {
    "endurance_days",
    "range_km",
    "dives",
    "energy_per_dive_j",
    "share",
    "best_speed_for_endurance_m_s",
    "best_depth_for_endurance_m",
    "best_speed_for_range_m_s",
    "best_depth_for_range_m",
    "sensitivity",
    "assumptions",
    "gap",
    "target_days",
    "target_met",
}


def test_json(stommel: Command) -> None:
    found = stommel("endurance", "zju", "--depth", 200, "--speed", 0.4, "--pitch", -35, "--json")
    assert found.status == 0
    assert set(found.json) >= KEYS
    assert found.json == stommel("endurance", "zju", "--json").json
    assert found.json["target_days"] == 20
    assert found.json["target_met"] is (found.json["endurance_days"] >= 20)
    assert found.json["battery"]["rated_wh"] == pytest.approx(1080)
    assert all(one["why"] for one in found.json["assumptions"]), "an assumption without a reason"


def test_terminal_is_80_columns_wide_and_lists_every_assumption(stommel: Command) -> None:
    found = stommel("endurance", "zju")
    assert found.status == 0
    assert max(len(line) for line in found.out.splitlines()) <= 80
    for key in (one["key"] for one in stommel("endurance", "zju", "--json").json["assumptions"]):
        assert key in found.out


def test_plot(stommel: Command, tmp_path: Path) -> None:
    found = stommel("endurance", "zju", "--plot", "out/energy.svg", "--json")
    assert found.json["written"] == ["out/energy.svg"]
    svg = (tmp_path / "out" / "energy.svg").read_text()
    # a bar for every part, and two for every assumption shown
    assert len(re.findall(r'id="energy(-\d+)?"', svg)) == len(found.json["energy_per_dive_j"])
    assert len(re.findall(r'id="tornado(-\d+)?"', svg)) >= 20


def refused(found: Outcome, *words: str) -> None:
    assert found.status == 2, found
    assert found.out == ""
    assert all(line.startswith("error: ") for line in found.err.splitlines())
    for word in words:
        assert word in found.err


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("zju", "--depth", 250), ["depth = 250 m", "hull.depth_rating_m = 200 m"]),
        (("zju", "--depth", 0), ["--depth = 0: must be between 0.5 and 12000 m"]),
        (("zju", "--depth", "nan"), ["--depth = nan: must be between 0.5 and 12000 m"]),
        (("zju", "--speed", 2), ["not reachable", "nearest reachable"]),
        (("zju", "--speed", 0.4, "--pitch", -60), ["moving mass", "nearest reachable"]),
        (("zju", "--pitch", 35), ["pitch = 35 deg", "between -90 and 0"]),
        (("zju", "--speed", -1), ["--speed = -1: must be between 0.005 and 5 m/s"]),
        (("zju", "--temperature", 90), ["--temperature = 90: must be between -3 and 45 deg C"]),
        (
            ("slocum",),
            ["slocum.toml: [battery] is missing", "[energy] is missing", "[[consumers]] is missing", "power_w"],
        ),
    ],
)
def test_refused(stommel: Command, arguments: tuple[object, ...], words: list[str]) -> None:
    refused(stommel("endurance", *arguments), *words)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("power_w = { value = 1.0, assumption = \"TMS", "power_w = { value = -1.0, assumption = \"TMS",
         ["consumers.0.power_w = -1.0: must be between 0 and 500 W"]),
        ("sample_s = { value = 1,", "sample_s = { value = 25,", ["consumers.5", "duty of 2.5", "at most 1"]),
        ("surface_session_s = { value = 180,", "surface_session_s = 80 #",
         ["consumers.6.seconds_per_surfacing = 90", "energy.surface_session_s = 80"]),
        ("name = \"altimeter\"", "name = \"compass PNI TCM5\"", ["consumers.5.name", "two consumers"]),
        ("regulator_efficiency = { value = 0.85", "regulator_efficiency = { value = 1.2",
         ["energy.regulator_efficiency = 1.2", "between 0.01 and 1"]),
        ("derating_temperature_c = { value = [-20, 0,", "derating_temperature_c = { value = [0, 0,", ["must rise"]),
        ("derating_fraction = { value = [0.7, ", "derating_fraction = { value = [", ["must have the same number"]),
        ("usable_fraction = {", "usabel_fraction = {", ["usabel_fraction", "did you mean usable_fraction"]),
        ("on = \"surface\"", "on = \"dive\"", ["seconds_per_surfacing needs on"]),
    ],
)  # fmt: skip
def test_bad_files(stommel: Command, tmp_path: Path, old: str, new: str, words: list[str]) -> None:
    text = builtin_text("zju")
    assert old in text
    (tmp_path / "bad.toml").write_text(text.replace(old, new, 1))
    found = stommel("endurance", "bad.toml")
    refused(found, "bad.toml", *words)


def test_a_duty_above_one(stommel: Command, tmp_path: Path) -> None:
    text = builtin_text("zju").replace('on = "always"', 'on = "always"\nduty = 1.5', 1)
    (tmp_path / "bad.toml").write_text(text)
    refused(stommel("endurance", "bad.toml"), "consumers.0.duty = 1.5", "between 0 and 1")


def test_a_motor_too_weak_for_the_depth(stommel: Command, tmp_path: Path) -> None:
    text = builtin_text("zju")
    weak = re.sub(r"current_limit_a = \{ value = [\d.]+", "current_limit_a = { value = 0.7", text, count=1)
    assert weak != text
    (tmp_path / "weak.toml").write_text(weak)
    refused(stommel("endurance", "weak.toml"), "cannot inflate at 1.962 MPa")


def test_specification_row(stommel: Command) -> None:
    days = stommel("endurance", "zju", "--json").json["endurance_days"]
    rows = stommel("design", "zju", "--no-report", "--json").json["specification"]
    (row,) = (row for row in rows if row["name"] == "Endurance")
    assert row["found"] == pytest.approx(days, rel=1e-12)
    assert row["met"] is (days >= 20)
