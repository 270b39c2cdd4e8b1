"""`stommel vehicle new` begins a short, whole and honest file: every number an assumption, copied from another."""

from pathlib import Path

import pytest

from stommel.vehicle import builtin_names, builtin_text, load_vehicle, stated_numbers
from stommel.vehicle.lean_file import FIRST, SECTIONS
from tests.cli.test_bad_input import refused
from tests.support.command import Command

EVERY = ",".join(SECTIONS)


def new(stommel: Command, *options: object) -> None:
    made = stommel("vehicle", "new", "mine", *options)
    assert made.status == 0, made.err
    assert "wrote mine.toml" in made.out


def test_short_commented_and_every_number_an_assumption(stommel: Command, tmp_path: Path) -> None:
    new(stommel)
    text = (tmp_path / "mine.toml").read_text()
    lines = text.splitlines()
    assert 70 <= len(lines) <= 95
    assert sum("# " in line for line in lines) >= 20
    assert max(map(len, lines)) <= 120
    mine = load_vehicle(tmp_path / "mine.toml")
    assert mine.name == "mine"
    origins = {(origin.kind, origin.text) for _, _, origin in stated_numbers(mine)}
    assert origins == {("assumption", "copied from zju")}
    found = stommel("vehicle", "check", "mine.toml", "--json").json
    assert (found["sourced"], found["not_stated"]) == (0, 0)
    assert found["assumptions"] == found["numbers"] > 40
    assert found["errors"] == []


@pytest.mark.parametrize("name", builtin_names())
def test_the_new_vehicle_is_the_old_one(stommel: Command, tmp_path: Path, name: str) -> None:
    """Every table that is written says what it said, also where a number is left to its default."""
    new(stommel, "--from", name)
    mine, old = (v.description.model_dump() for v in (load_vehicle(tmp_path / "mine.toml"), load_vehicle(name)))
    for table in FIRST:
        assert mine[table] == old[table], table
    assert stommel("design", "mine.toml", "--no-report").status == 0


def test_all_sections_are_the_whole_vehicle(stommel: Command, tmp_path: Path) -> None:
    new(stommel, "--with", EVERY)
    mine, zju = load_vehicle(tmp_path / "mine.toml"), load_vehicle("zju")
    whole = [v.description.model_dump(exclude={"name", "summary", "notes"}) for v in (mine, zju)]
    assert whole[0] == whole[1]
    assert {origin.text for _, _, origin in stated_numbers(mine)} == {"copied from zju"}


def test_a_section_at_a_time_is_the_same_as_all_at_once(stommel: Command, tmp_path: Path) -> None:
    new(stommel)
    for section in SECTIONS:
        added = stommel("vehicle", "new", "mine", "--with", section)
        assert added.status == 0, added.err
        assert f"added {section}" in added.out
    zju = load_vehicle("zju").description.model_dump(exclude={"name", "summary", "notes"})
    mine = load_vehicle(tmp_path / "mine.toml")
    assert mine.description.model_dump(exclude={"name", "summary", "notes"}) == zju
    assert {origin.kind for _, _, origin in stated_numbers(mine)} == {"assumption"}


def test_what_the_user_wrote_stays_when_a_section_is_added(stommel: Command, tmp_path: Path) -> None:
    """Also where the head of the file speaks of a source: the added numbers have their own word."""
    new(stommel)
    path = tmp_path / "mine.toml"
    edited = path.read_text().replace('assumption = "copied from zju"', 'source = "our drawing 7"', 1) + "# mine\n"
    path.write_text(edited)
    assert stommel("vehicle", "new", "mine.toml", "--with", "hull,battery").status == 0
    assert path.read_text().startswith(edited)
    mine = load_vehicle(path)
    assert mine.provenance_of("rigid_body.mass_kg").text == "our drawing 7"
    for key in ("hull.length_m", "battery.capacity_ah", "energy.surface_session_s", "consumers.3.power_w"):
        assert (mine.provenance_of(key).kind, mine.provenance_of(key).text) == ("assumption", "copied from zju"), key


def test_from_a_file(stommel: Command, tmp_path: Path) -> None:
    (tmp_path / "theirs.toml").write_text(builtin_text("zju").replace("mass_kg = 45\n", "mass_kg = 46\n", 1))
    new(stommel, "--from", "theirs.toml", "--with", "hull")
    mine = load_vehicle(tmp_path / "mine.toml")
    assert mine.description.rigid_body.mass_kg == 46
    assert mine.provenance_of("hull.length_m").text == "copied from theirs.toml"


@pytest.mark.parametrize("section", list(SECTIONS))
def test_each_section_alone(stommel: Command, section: str) -> None:
    new(stommel, "--with", section)
    assert stommel("vehicle", "check", "mine.toml", "--json").json["errors"] == []


def test_verbs_answer_for_the_sections_that_are_there(stommel: Command) -> None:
    new(stommel, "--with", "hull,engine,drives,battery")
    for verb in (("hull",), ("drives",), ("endurance",), ("engine",)):
        assert stommel(verb[0], "mine.toml", *verb[1:]).status == 0, verb


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("mine", "--with", "engin"), ["no section 'engin'", "hull, engine, drives, battery, parts, antenna"]),
        (("mine", "--with", "hull,,engine"), ["no section ''"]),
        (("mine", "--with", "engine", "--from", "slocum"), ["slocum has no [engine]", "zju"]),
        (("mine", "--from", "nowhere"), ["nowhere"]),
        (("mine.txt",), ["FILE", "mine.txt"]),
        ((" ",), ["FILE", "names no file"]),
        (("there",), ["there.toml: already exists; --force replaces it"]),
        (("full", "--with", "hull"), ["full.toml has [hull] already"]),
        (("broken", "--with", "hull"), ["broken.toml", "not valid TOML"]),
    ],
)
def test_refused(stommel: Command, tmp_path: Path, arguments: tuple[str, ...], words: list[str]) -> None:
    (tmp_path / "there.toml").write_text("")
    (tmp_path / "full.toml").write_text(builtin_text("zju"))
    (tmp_path / "broken.toml").write_text("[")
    before = {path.name: path.read_text() for path in tmp_path.iterdir()}
    refused(stommel("vehicle", "new", *arguments), *words)
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == before


def test_a_missing_table_is_answered_with_all_its_keys(stommel: Command, tmp_path: Path) -> None:
    """Every required key of every required table, in one answer, not one key a try."""
    (tmp_path / "empty.toml").write_text('name = "nothing yet"\n')
    told = stommel("vehicle", "check", "empty.toml")
    assert told.status == 2
    lines = told.err.splitlines()
    for table, keys in {
        "water": ["density_kg_m3", "gravity_m_s2"],
        "rigid_body": ["mass_kg", "centre_of_mass_m", "inertia_kg_m2", "inertia_about"],
        "moving_mass": ["mass_kg", "neutral_position_m", "offset_m"],
        "ballast": ["mass_kg", "position_m"],
        "added_inertia": ["surge_kg", "heave_kg", "sway_kg", "coupling_kg_m"],
        "hydrodynamics": ["drag_kg_m", "lift_per_rad_kg_m", "pitch_damping_kg_s", "side_force_per_rad_kg_m"],
    }.items():
        (line,) = [line for line in lines if f"the table [{table}] is missing" in line]
        for key in keys:
            assert key in line, (table, key)


@pytest.mark.parametrize(
    ("arguments", "keys"),
    [
        (("hull", "rogue"), ["length_m", "outer_diameter_mm", "nose_position_m", "wall_mm", "[rings]"]),
        (("drives", "slocum"), ["[screw]", "guide_friction", "stops_mm", "chord_mm", "gearbox_efficiency", "[brake]"]),
        (("engine", "rogue"), ["connections", "[oil]", "[sensor]", "[pumps]"]),
        (("budget", "slocum"), ["name", "bay", "position_m", "trim_weight", "from_m", "flooded"]),
        (("turn", "slocum", "--speed", "0.4", "--pitch", "-30", "--turn-rate", "0.01", "--by", "rudder"),
         ["aerodynamic_centre_aft_m", "height_m", "side_force_per_rad_kg_m"]),
        (("flight-table", "rogue"), ["volume_ml", "flow_ml_s", "bladder_position_m"]),
        (("root-locus", "slocum", "--speed", "0.4", "--pitch", "-30", "--over", "wing_position", "--from", "0", "--to",
          "0.1"), ["length_m", "tail_length_m"]),
    ],
)  # fmt: skip
def test_verbs_answer_a_missing_table_with_all_its_keys(
    stommel: Command, arguments: tuple[str, ...], keys: list[str]
) -> None:
    refused(stommel(*arguments), *keys)
