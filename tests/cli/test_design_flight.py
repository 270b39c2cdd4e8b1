"""Where a verb is given no speed and no pitch, it takes those of the file's [specification], not numbers of its own."""

from pathlib import Path

import pytest

from stommel.vehicle import builtin_text
from tests.cli.test_bad_input import refused
from tests.support.command import Command

VERBS = (
    ("trim",),
    ("table",),
    ("modes",),
    ("turn", "--turn-rate", "0.005"),
    ("root-locus", "--over", "wing_position", "--from", "0.1", "--to", "0.2", "--points", "3"),
    ("endurance",),
)


@pytest.fixture
def other(tmp_path: Path) -> str:
    """A vehicle that is designed for 0.33 m/s at -28 deg."""
    text = builtin_text("zju")
    for old, new in (("design_speed_m_s = { value = 0.4", "design_speed_m_s = { value = 0.33"),
                     ("design_pitch_deg = { value = 35", "design_pitch_deg = { value = 28")):  # fmt: skip
        assert old in text
        text = text.replace(old, new, 1)
    (tmp_path / "other.toml").write_text(text)
    return "other.toml"


@pytest.mark.parametrize("verb", VERBS, ids=lambda verb: verb[0])
def test_the_files_own_flight_is_the_default(stommel: Command, other: str, verb: tuple[str, ...]) -> None:
    name, *options = verb
    asked = stommel(name, other, *options, "--json")
    assert asked.status == 0, asked.err
    assert asked.json == stommel(name, other, *options, "--speed", 0.33, "--pitch", -28, "--json").json
    assert asked.json != stommel(name, other, *options, "--speed", 0.4, "--pitch", -35, "--json").json


@pytest.mark.parametrize("verb", VERBS[:-1], ids=lambda verb: verb[0])
def test_one_of_them_may_be_given(stommel: Command, other: str, verb: tuple[str, ...]) -> None:
    name, *options = verb
    asked = stommel(name, other, *options, "--speed", 0.4, "--json").json
    assert asked == stommel(name, other, *options, "--speed", 0.4, "--pitch", -28, "--json").json


def test_a_glide_path_takes_the_place_of_the_pitch(stommel: Command, other: str) -> None:
    row = stommel("trim", other, "--glide-path", -30, "--json").json
    assert row["glide_path_deg"] == pytest.approx(-30.0)
    assert row["speed_m_s"] == pytest.approx(0.33)


@pytest.mark.parametrize("verb", VERBS[:3], ids=lambda verb: verb[0])
def test_a_file_without_a_specification_is_asked(stommel: Command, verb: tuple[str, ...]) -> None:
    refused(stommel(verb[0], "slocum", *verb[1:]), "give --speed; its file has no specification.design_speed_m_s")
    refused(
        stommel(verb[0], "slocum", *verb[1:], "--speed", 0.4),
        "give --pitch; its file has no specification.design_pitch_deg",
    )
