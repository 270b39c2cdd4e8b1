"""`stommel vehicle check` holds the numbers of a file against each other; other verbs say how many findings there are.

Each finding is provoked by one number that was changed by hand; what it must say is worked out beside it.
"""

from math import pi
from pathlib import Path

import pytest

from stommel.design.checking import CHECKS, cross_check
from stommel.design.checking.lateral import blade_slope
from stommel.vehicle import builtin_names, builtin_text, load_vehicle, vehicle_from_text
from tests.support.command import Command

ZJU = builtin_text("zju")


RANGE = ", range = [24, 25.9] }"
VOLTAGE = next(line for line in ZJU.splitlines() if line.startswith("voltage_v"))


def changed(*changes: tuple[str, str], text: str = ZJU) -> str:
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    return text


def findings(text: str) -> dict[str, str]:
    found = cross_check(vehicle_from_text(text, "mine.toml"))
    return {finding.name: finding.message for finding in (*found.errors, *found.warnings)}


@pytest.mark.parametrize(
    ("old", "new", "name", "words"),
    [
        # sizes against the specification: 45 + 10 + 5 kg, 1.5 m, 0.11 + 1.5 + 0.49 m, 220 mm, 500 ml, 60 deg
        (
            "mass_kg = 60\n",
            "mass_kg = 59\n",
            "specification_not_met",
            "have 60 kg; specification.mass_kg asks at most 59",
        ),
        ("body_length_m = 1.5", "body_length_m = 1.4", "specification_not_met", "hull.length_m = 1.5"),
        ("overall_length_m = 2.1", "overall_length_m = 2", "specification_not_met", "are 2.1 m long"),
        ("diameter_mm = 220\n", "diameter_mm = 200\n", "specification_not_met", "hull.outer_diameter_mm = 220"),
        (
            "oil_volume_ml = 500",
            "oil_volume_ml = 510",
            "specification_not_met",
            "spans 500 ml; specification.oil_volume",
        ),
        ("rudder_deg = 60", "rudder_deg = 70", "specification_not_met", "actuators.rudder.travel_deg = 60"),
        # depths: 200 m of 1000 kg/m3 weigh 1.96 MPa
        (
            "depth_rating_m = { value = 200",
            "depth_rating_m = { value = 150",
            "depth_beyond_rating",
            "200 is deeper than",
        ),
        ("design_pressure_mpa = { value = 2", "design_pressure_mpa = { value = 1.8", "design_pressure_low", "1.96 MPa"),
        # masses of the parts: 10.25 + 1.75 kg
        ("mass_kg = 10.25", "mass_kg = 12", "mass_differs", "(+1.750 kg)"),
        ("mass_kg = 10.25", "mass_kg = 12", "does_not_float", "too much even with all the ballast volume"),
        ("mass_kg = 10.25", "mass_kg = 8", "does_not_sink", "too little even with the bladder empty"),
        # the hull: 3 mm of titanium against Eq. (9)
        ("wall_mm = { value = 4.2", "wall_mm = { value = 3", "wall too thin", "less than the 4.18 mm"),
        # pi/4 50^2 mm2 times 255 mm are 500.7 ml
        ("volume_ml = { value = [-250, 250]", "volume_ml = { value = [-300, 300]", "engine_volume_short", "500.7 ml"),
        (
            "working_range_mm = { value = [22.5, 277.5]",
            "working_range_mm = { value = [50, 250]",
            "engine_volume_short",
            "392.7",
        ),
        # 1.1 ml at 470 r/min are 8.62 ml/s
        (
            "flow_ml_s = { value = 8.617",
            "flow_ml_s = { value = 9.5",
            "engine_flow_differs",
            "8.62 ml/s without any loss",
        ),
        ("flow_ml_s = { value = 8.617", "flow_ml_s = { value = 3", "engine_flow_differs", "flow_ml_s = 3"),
        # 1.96 MPa times 1.1 ml / 2 pi are 0.34 N m; 0.9 A times 25.1 mN m times 15 times 0.8 are 0.27
        ("current_limit_a = { value = 6", "current_limit_a = { value = 0.9", "engine_stalls", "at 200 m"),
        (
            "switches_mm = { value = [-53, 553]",
            "switches_mm = { value = [-53, 540]",
            "switch_within_travel",
            "[-50, 550]",
        ),
        (
            "speed_mm_s = { value = 5.25",
            "speed_mm_s = { value = 9",
            "moving_mass_speed_differs",
            "moving_mass.speed_mm_s = 9",
        ),
        ("speed_deg_s = { value = 20", "speed_deg_s = { value = 40", "rudder_speed_differs", "rudder.speed_deg_s = 40"),
        (
            VOLTAGE,
            VOLTAGE.replace("value = 24", "value = 14.8").replace(RANGE, " }"),
            "voltage_differs",
            "battery.voltage_v = 14.8",
        ),
    ],
)
def test_one_number_that_contradicts_another(old: str, new: str, name: str, words: str) -> None:
    before, after = findings(ZJU), findings(changed((old, new)))
    assert words in after[name]
    assert words not in before.get(name, "")


def test_lateral_coefficients_of_zju_are_named_as_implausible() -> None:
    """100 / 20 is 5 m on a vehicle that reaches 1.24 m; 100 times 1.2 m over 0.4 m/s is 300; 135 - 67 is 68."""
    found = findings(ZJU)
    assert "acts 5 m from the centre of buoyancy; the vehicle reaches 1.24 m" in found["lateral_lever"]
    assert "lifts 68 kg/m per rad" in found["side_force_small"]
    assert "-20 is 0.067 of what a fin 1.2 m aft" in found["yaw_damping"]
    assert "at 0.4 m/s, -300" in found["yaw_damping"]
    # 1000/2 times 0.08 by 0.22 m2 times 1 / (1 / 1.8 pi + 1 / (5.5 pi)) = 4.26 per rad
    assert "a blade of 80 by 220 mm in [drives.rudder] has about 37.5 kg/m" in found["rudder_slope"]


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("lateral_lever", ("side_force_per_rad_kg_m = { value = 20,", "side_force_per_rad_kg_m = { value = 115,")),
        ("side_force_small", ("side_force_per_rad_kg_m = { value = 20,", "side_force_per_rad_kg_m = { value = 115,")),
        ("yaw_damping", ("yaw_damping_kg_s = { value = -20", "yaw_damping_kg_s = { value = -300")),
        ("rudder_slope", ("side_force_per_rad_kg_m = { value = 5,", "side_force_per_rad_kg_m = { value = 30,")),
    ],
)
def test_plausible_lateral_coefficients_are_not_named(name: str, change: tuple[str, str]) -> None:
    assert name in findings(ZJU)
    assert name not in findings(changed(change))


@pytest.mark.parametrize("chord_mm", [8, 400])
def test_rudder_without_a_span_is_held_against_blades_that_are_built(chord_mm: int) -> None:
    lines = [line for line in ZJU.splitlines() if not line.startswith("span_mm")]
    text = changed(("chord_mm = { value = 80", f"chord_mm = {{ value = {chord_mm}"), text="\n".join(lines))
    assert f"chord_mm = {chord_mm}" in findings(text)["rudder_slope"]


def test_fin_formula_on_remus() -> None:
    """Prestero (2001): fins of 6.65e-3 m2 and 0.0857 m span on REMUS have 3.12 per rad."""
    rho, area, span = 1030.0, 6.65e-3, 0.0857
    assert blade_slope(rho, area / span, span) / (0.5 * rho * area) == pytest.approx(3.12, abs=0.03)
    assert blade_slope(rho, 0.1, 1e6) / (0.5 * rho * 1e5) == pytest.approx(
        1.8 * pi, rel=1e-6
    )  # a long blade: 2 pi, less 10 %


def test_the_literature_is_told_apart() -> None:
    """Sea-Wing's published set, with a lever of 0.29 m, passes; the Slocum-like set, with 5 m, does not."""
    seawing = cross_check(load_vehicle("seawing"))
    assert [finding.name for finding in (*seawing.errors, *seawing.warnings)] == []
    slocum = cross_check(load_vehicle("slocum"))
    assert {finding.name for finding in slocum.warnings} == {"lateral_lever", "yaw_damping"}


@pytest.mark.parametrize("name", builtin_names())
def test_no_built_in_vehicle_has_an_error(stommel: Command, name: str) -> None:
    found = stommel("vehicle", "check", name, "--json").json
    assert found["errors"] == []
    shown = stommel("vehicle", "check", name)
    assert shown.status == 0
    for finding in found["warnings"]:
        assert f"warning: {finding['name']}: {finding['message']}" in " ".join(shown.out.split())


def test_every_check_is_in_the_list_once() -> None:
    names = [check.__name__ for check in CHECKS]
    assert len(names) == len(set(names)) >= 9


def test_errors_are_shown_first_and_counted(stommel: Command, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(changed(("mass_kg = 10.25", "mass_kg = 12")))
    found = stommel("vehicle", "check", "mine.toml", "--json").json
    assert [error["name"] for error in found["errors"]] == ["does_not_float"]
    shown = stommel("vehicle", "check", "mine.toml").out
    assert f"1 error, {len(found['warnings'])} warnings" in shown.splitlines()[0]
    assert shown.index("error: does_not_float") < shown.index("warning: ")


@pytest.mark.parametrize("verb", [("design", "zju", "--no-report"), ("simulate", "pool_trial")])
def test_verbs_print_how_many_findings_and_where(stommel: Command, verb: tuple[str, ...]) -> None:
    check = stommel("vehicle", "check", "zju", "--json").json
    line = f"vehicle: 0 errors, {len(check['warnings'])} warnings: stommel vehicle check zju"
    assert line in stommel(*verb).out.splitlines()
    assert stommel(*verb, "--json").json["vehicle_check"] == {
        "errors": 0,
        "warnings": len(check["warnings"]),
        "command": "stommel vehicle check zju",
    }


def test_study_prints_how_many_findings_and_where(stommel: Command, tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text(
        'name = "s"\nmission = "pool_trial"\nkind = "sweep"\nseed = 1\noutputs = ["deepest_m"]\n'
        '[[parameters]]\nkey = "vehicle.ballast.mass_kg"\nvalues = [5.0]\n'
    )
    found = stommel("study", "s.toml", "--workers", 1)
    assert found.status == 0, found.err
    assert "warnings: stommel vehicle check zju" in found.out


def test_nothing_is_printed_where_there_is_nothing_to_read(stommel: Command) -> None:
    assert "stommel vehicle check" not in stommel("design", "seawing", "--no-report").out
