"""What `envelope` and `design` find keeps to the limits of the vehicle file, or says which limit it breaks."""

from pathlib import Path

import pytest

from stommel.vehicle import builtin_text
from tests.support.command import Command

STALL = next(line for line in builtin_text("zju").splitlines() if line.startswith("stall_begins_deg"))


def changed(folder: Path, *changes: tuple[str, str]) -> str:
    text = builtin_text("zju")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    (folder / "mine.toml").write_text(text)
    return "mine.toml"


def words(text: str) -> str:
    return " ".join(text.split())


def test_no_best_flight_below_a_table_that_cannot_reach_it(stommel: Command, tmp_path: Path) -> None:
    name = changed(tmp_path, ("travel_mm = { value = [-50, 550]", "travel_mm = { value = [-50, 350]"))
    found = stommel("envelope", name, "--json").json
    reached = [row["pitch_deg"] for row in found["reach"] if row["maximum_speed_m_s"] is not None]
    assert found["fastest"]["pitch_deg"] >= min(reached) - 1e-6
    assert found["fastest"]["limits"] == ["at the end of the moving mass's travel, 350 mm"]
    for verb in (("envelope", name), ("design", name, "--no-report")):
        assert "at the end of the moving mass's travel, 350 mm" in words(stommel(*verb).out)


def test_design_says_none_where_there_is_none(stommel: Command, tmp_path: Path) -> None:
    """With travel to 270 mm no dive and no climb beyond 5 deg; with none below 260 mm no dive at -35 deg at all."""
    name = changed(
        tmp_path,
        ("travel_mm = { value = [-50, 550]", "travel_mm = { value = [245, 255]"),
        ("design_speed_m_s = { value = 0.4", "design_speed_m_s = { value = 0.9"),
    )
    found = {row["name"]: row for row in stommel("design", name, "--no-report", "--json").json["specification"]}
    for requirement in ("Pitch, diving", "Pitch, climbing", "Speed"):
        row = found[requirement]
        assert row["found"] is None
        assert row["met"] is False
        assert row["how"].startswith("no ")
    shown = stommel("design", name, "--no-report").out
    for requirement in ("Pitch, diving", "Pitch, climbing", "Speed"):
        (line,) = [line for line in shown.splitlines() if line.strip().startswith(requirement + "  ")]
        assert "none" in line
        assert "NOT MET" in line
        assert f"{requirement}: no " in words(shown)


def test_design_flight_beyond_the_limits_is_named(stommel: Command, tmp_path: Path) -> None:
    name = changed(tmp_path, ("travel_mm = { value = [-50, 550]", "travel_mm = { value = [-50, 350]"))
    shown = words(stommel("design", name, "--no-report").out)
    assert "note: this flight needs the moving mass at 408.2 mm, but the limits are -50 to 350 mm" in shown
    beyond = stommel("design", name, "--no-report", "--json").json["design_flight"]["beyond"]
    assert beyond == ["needs the moving mass at 408.2 mm, but the limits are -50 to 350 mm"]
    assert stommel("design", "zju", "--no-report", "--json").json["design_flight"]["beyond"] == []


def test_no_speed_where_there_is_no_reserve(stommel: Command) -> None:
    """Trimmed for the middle of 1000 to 1040 kg/m3, 250 ml are too few at both ends: no speed, not 0 m/s."""
    rows = stommel("budget", "zju", "--density", "1000:1040", "--json").json["reserve"]["rows"]
    for row in rows:
        assert (row["to_sink_ml"] > 0) is (row["dive_speed_m_s"] is not None)
        assert (row["to_rise_ml"] > 0) is (row["climb_speed_m_s"] is not None)
    assert rows[0]["climb_speed_m_s"] is None or rows[-1]["climb_speed_m_s"] is None


@pytest.mark.parametrize("verb", ["envelope", "design"])
def test_free_optima_carry_no_remark(stommel: Command, verb: str) -> None:
    options = ("--no-report",) if verb == "design" else ()
    found = stommel(verb, "zju", *options, "--json").json
    assert found["best_glide"]["limits"] == []
    assert found["fastest"]["limits"] == []


def test_wanted_flights_beyond_stall_are_named(stommel: Command, tmp_path: Path) -> None:
    """Table 1 has 5.52 deg of incidence at -5 deg and 3.80 at -10 deg: stalled from 5 deg on, only the first is."""
    name = changed(tmp_path, (STALL, "stall_begins_deg = 5"))
    found = stommel("envelope", name, "--json").json["needs"]["beyond_stall"]
    assert [(row["speed_m_s"], round(row["pitch_deg"], 6)) for row in found] == [(0.4, -5.0), (0.4, 5.0)]
    assert "beyond the stall angle, out of reach of any range: 0.4 m/s at pitch -5.0 deg" in words(
        stommel("envelope", name).out
    )
