"""`stommel hull` through the front door."""

from pathlib import Path

import pytest

from tests.cli.test_bad_input import refused
from tests.support.command import Command
from tests.support.pages import commands, guide

KEYS = {
    "name",
    "yield_wall_mm",
    "circumferential_wall_mm",
    "axial_critical_stress_mpa",
    "mass_kg",
    "collapse_depth_m",
    "wall_mm",
    "required_wall_mm",
    "displaced_volume_l",
    "compressibility_per_pa",
    "criteria",
    "rank",
    "reasons",
}
GUIDE = guide("hull")


def test_json(stommel: Command) -> None:
    found = stommel("hull", "zju", "--json").json
    assert len(found["materials"]) == 8
    assert all(set(row) >= KEYS for row in found["materials"])
    titanium = next(row for row in found["materials"] if row["name"] == "TC4")
    assert titanium["wall_mm"] == 4.2
    assert titanium["collapse_depth_m"] == pytest.approx(405.5, abs=0.1)
    assert found["own"]["name"] == "TC4"
    assert found["pressure_mpa"] == 2.0


def test_rated_depth_asked_for_is_the_design_pressure(stommel: Command) -> None:
    assert stommel("hull", "zju", "--depth", 200, "--json").json == stommel("hull", "zju", "--json").json


def test_deeper_needs_more(stommel: Command) -> None:
    options = ("--material", "TC4", "--material", "6061-T6", "--json")
    shallow = stommel("hull", "zju", *options).json
    deep = stommel("hull", "zju", "--depth", 400, *options).json
    assert {row["name"] for row in deep["materials"]} == {"TC4", "6061-T6"}
    assert deep["pressure_mpa"] == 4.0
    walls = [{row["name"]: row["circumferential_wall_mm"] for row in found["materials"]} for found in (shallow, deep)]
    for name in walls[0]:
        assert walls[1][name] == pytest.approx(walls[0][name] * 2**0.4, rel=1e-12)


def test_thin_wall_is_named_in_terminal_and_json(stommel: Command) -> None:
    shown = stommel("hull", "zju", "--material", "TC4", "--wall", 3.5)
    assert shown.status == 0
    assert "warning: wall too thin: " in shown.out
    found = stommel("hull", "zju", "--material", "TC4", "--wall", 3.5, "--json").json
    assert "wall too thin" in {warning["name"] for warning in found["warnings"]}
    assert "wall too thin" in {warning["name"] for warning in found["materials"][0]["warnings"]}


def test_readable_at_80_columns(stommel: Command) -> None:
    shown = stommel("hull", "zju")
    assert shown.status == 0
    assert max(len(line) for line in shown.out.splitlines()) <= 80
    assert "1.08e+05 MPa" in " ".join(shown.out.split())


def test_plot_and_own_materials(stommel: Command, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(
        "[PMMA]\ntitle = 'acrylic'\nelastic_modulus_mpa = 3000\npoisson_ratio = 0.37\ndensity_kg_m3 = 1190\n"
        "failure_stress_mpa = 100\npermissible_stress_mpa = 20\nthermal_expansion_per_k = 7e-5\ncorrosion_grade = 4\n"
        "corrosion = 'none'\nmachinability_grade = 3\nmachinability = 'easy'\n"
    )
    options = ("--materials", "mine.toml", "--material", "pmma", "--depth", 50, "--plot", "hull.png", "--json")
    found = stommel("hull", "zju", *options).json
    assert [row["name"] for row in found["materials"]] == ["PMMA"]
    assert found["written"] == ["hull.png"]
    assert (tmp_path / "hull.png").read_bytes().startswith(b"\x89PNG")


def long_bay(folder: Path) -> str:
    """The vehicle of the paper with 1.2 m between its joints."""
    from stommel.vehicle.loading import builtin_text

    text = builtin_text("zju")
    assert "checked_length_m = { value = 0.75" in text
    (folder / "long.toml").write_text(
        text.replace("checked_length_m = { value = 0.75", "checked_length_m = { value = 1.2")
    )
    return "long.toml"


def test_raised_walls_are_marked_in_terminal_and_json(stommel: Command, tmp_path: Path) -> None:
    name = long_bay(tmp_path)
    shown = stommel("hull", name, "--material", "alumina").out
    assert "3.7+" in shown
    assert "raised to 3.7 mm" in shown
    (row,) = stommel("hull", name, "--material", "alumina", "--json").json["materials"]
    assert row["raised_for"] == ["von Mises, n lobes"]
    assert row["fails"] == []
    assert row["collapse_depth_m"] >= 400


def test_failed_walls_are_marked_in_terminal_and_json(stommel: Command, tmp_path: Path) -> None:
    """2.6 mm of carbon fibre, for 30 m between joints 1.2 m apart."""
    asked = ("hull", long_bay(tmp_path), "--material", "carbon-fibre", "--depth", 30, "--wall", 2.6)
    shown = stommel(*asked).out
    assert "2.6!" in shown
    assert "classical criterion not met: carbon-fibre, wall 2.6 mm: von Mises" in " ".join(shown.split())
    (row,) = stommel(*asked, "--json").json["materials"]
    assert "von Mises, n lobes" in row["fails"]


def test_knock_down_is_an_option_a_key_and_a_word_of_the_answer(stommel: Command, tmp_path: Path) -> None:
    asked = stommel("hull", "zju", "--material", "TC4", "--knock-down", 0.75)
    assert "knock-down for imperfections: 0.75 of the buckling pressure" in " ".join(asked.out.split())
    plain = stommel("hull", "zju", "--material", "TC4")
    assert "knock-down for imperfections: none" in " ".join(plain.out.split())
    found = stommel("hull", "zju", "--material", "TC4", "--knock-down", 0.75, "--json").json
    assert found["knock_down"] == 0.75
    # Eq. (9): the wall grows with the pressure to the power 0.4
    was = stommel("hull", "zju", "--material", "TC4", "--json").json["materials"][0]["circumferential_wall_mm"]
    assert found["materials"][0]["circumferential_wall_mm"] == pytest.approx(was * 0.75**-0.4)
    from stommel.vehicle.loading import builtin_text

    (tmp_path / "mine.toml").write_text(
        builtin_text("zju").replace("[hull]", '[hull]\nknock_down = { value = 0.75, assumption = "as built" }')
    )
    key = stommel("hull", "mine.toml", "--material", "TC4", "--json").json
    assert key["materials"][0]["wall_mm"] == found["materials"][0]["wall_mm"]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("zju", "--depth", -200), ["--depth = -200: must be between 0.5 and 12000 m"]),
        (("zju", "--pressure-mpa", -2), ["--pressure-mpa = -2: must be between 0.001 and 200 MPa"]),
        (("zju", "--depth", "nan"), ["--depth = nan: must be"]),
        (("zju", "--depth", 200, "--pressure-mpa", 2), ["not both"]),
        (("zju", "--material", "unobtainium"), ["'unobtainium'", "known materials: 12Cr1MoV"]),
        (("zju", "--knock-down", 0), ["--knock-down = 0: must be between 0.1 and 1"]),
        (("zju", "--knock-down", 1.2), ["--knock-down = 1.2: must be between 0.1 and 1"]),
        (("zju", "--knock-down", "nan"), ["--knock-down = nan"]),
        (("zju", "--wall", 0), ["--wall = 0: must be between 0.1 and 200 mm"]),
        (("zju", "--wall", 110), ["wall = 110 mm", "less than half"]),
        (("zju", "--material", "LY12", "--pressure-mpa", 200), ["LY12", "no wall"]),
        (("zju", "--materials", "nowhere.toml"), ["nowhere.toml", "cannot be read"]),
        (("rogue",), ["no table [hull]"]),
        (("seawing",), ["give a depth"]),
    ],
)
def test_refused(stommel: Command, arguments: tuple[object, ...], words: list[str]) -> None:
    refused(stommel("hull", *arguments), *words)


@pytest.mark.parametrize(
    ("was", "becomes", "words"),
    [
        ("inner_diameter_mm = { value = 210", "inner_diameter_mm = { value = 230", ["230", "less than outer_diameter"]),
        ("design_pressure_mpa = { value = 2,", "design_pressure_mpa = { value = -2,", ["design_pressure_mpa = -2"]),
        (
            "weld_efficiency = { value = 1,",
            "weld_efficiency = { value = 1.2,",
            ["weld_efficiency", "between 0.1 and 1"],
        ),
        ("checked_length_m = { value = 0.75", "checked_length_m = { value = 7.5", ["checked_length_m = 7.5"]),
        ("wall_mm = { value = 4.2", "wall_mm = { value = 111", ["wall_mm = 111", "less than half"]),
        ("yield_safety_factor = { value = 2", "yield_safety_factor = { value = 0.5", ["yield_safety_factor = 0.5"]),
    ],
)
def test_refused_vehicle_files(stommel: Command, tmp_path: Path, was: str, becomes: str, words: list[str]) -> None:
    from stommel.vehicle.loading import builtin_text

    text = builtin_text("zju")
    assert was in text
    (tmp_path / "bad.toml").write_text(text.replace(was, becomes))
    refused(stommel("hull", "bad.toml"), "bad.toml", *words)


def test_commands_of_the_guide_run(stommel: Command) -> None:
    calls = commands(GUIDE)
    assert len(calls) >= 3
    for arguments in calls:
        assert stommel(*arguments).status == 0, arguments
