"""Oracle: what JSON may hold, and how an answer reads at 80 columns."""

import json
import re
from math import inf, nan
from pathlib import Path
from typing import Any

import pytest
import typer

from stommel.cli.finish import NotFiniteError, finish
from stommel.cli.output import show_notes, show_values, show_warnings
from stommel.design.named_warning import NamedWarning
from stommel.files.units import counted
from stommel.vehicle import builtin_names, load_vehicle, stated_numbers

Captured = pytest.CaptureFixture[str]


def silent(_answer: Any) -> None:
    raise AssertionError("shown where JSON was asked for")


class Result:
    def as_json(self) -> dict[str, Any]:
        return {"speed_m_s": 0.4, "limits": None}


def test_json_is_the_result_and_what_was_written(capsys: Captured) -> None:
    finish(Result(), [Path("out") / "a.png"], True, silent)
    assert json.loads(capsys.readouterr().out) == {"speed_m_s": 0.4, "limits": None, "written": ["out/a.png"]}


def test_a_verb_that_never_writes_lists_nothing(capsys: Captured) -> None:
    finish([{"name": "zju"}], None, True, silent)
    assert json.loads(capsys.readouterr().out) == [{"name": "zju"}]


def test_the_terminal_shows_the_result_and_then_the_files(capsys: Captured) -> None:
    finish(Result(), [Path("a.png"), Path("b.nc")], False, lambda result: typer.echo(type(result).__name__))
    assert capsys.readouterr().out == "Result\nwrote a.png\nwrote b.nc\n"


@pytest.mark.parametrize("as_json", [True, False])
@pytest.mark.parametrize(
    ("answer", "words"),
    [
        ({"rows": [{"time_s": 1.0}, {"time_s": inf}]}, ["rows.1.time_s became infinite"]),
        ({"torque": {"mean_n_m": nan}}, ["torque.mean_n_m became no number"]),
        ([1.0, (-inf, 2.0)], ["1.0 became infinite"]),
        ({"a": inf, "b": [nan, inf]}, ["a became infinite", "2 more"]),
    ],
)
def test_what_became_non_finite_is_named_and_nothing_is_shown(
    capsys: Captured, answer: Any, words: list[str], as_json: bool
) -> None:
    with pytest.raises(NotFiniteError) as caught:
        finish(answer, None, as_json, silent)
    for word in words:
        assert word in str(caught.value)
    assert "\n" not in str(caught.value)
    assert capsys.readouterr().out == ""


def test_counts_of_one_are_singular() -> None:
    assert [counted(count, "day") for count in (0, 1, 1.0, "1", 1.5, 2)] == [
        "0 days", "1 day", "1 day", "1 day", "1.5 days", "2 days",
    ]  # fmt: skip
    assert counted(2, "day allows", "days allow") == "2 days allow"


def test_one_day_of_endurance_is_a_day(stommel: Any, tmp_path: Path) -> None:
    text = stommel("vehicle", "show", "zju", "--toml").out
    assert text.count("endurance_days = 20") == 1
    (tmp_path / "mine.toml").write_text(text.replace("endurance_days = 20", "endurance_days = 1"))
    shown = stommel("endurance", "mine.toml").out
    assert "1 day asked: met" in shown
    shown += stommel("design", "mine.toml", "--output", "mine.html").out
    assert re.search(r"Endurance +1 day ", shown)
    page = (tmp_path / "mine.html").read_text(encoding="utf-8")
    assert "The 1 day of the specification is met." in page
    assert not re.search(r"\b1 days\b", shown + page)


LONG = "the centre of mass lies out of reach of every part, as rigid_body.centre_of_mass_m and the bays have it"


def test_notes_values_and_warnings_keep_their_indent(capsys: Captured) -> None:
    show_notes([LONG], "note")
    show_warnings([NamedWarning("centre_of_mass_differs", LONG)])
    show_values("Title", {"key": LONG, "other": "short"})
    note, note_goes_on, warning, *rest, title, key, key_goes_on, other = capsys.readouterr().out.splitlines()
    assert note.startswith("note: the centre")
    assert warning.startswith("warning: centre_of_mass_differs: the centre")
    assert all(line.startswith("  ") and line[2] != " " for line in (note_goes_on, *rest))
    assert title == "Title"
    assert key.startswith("  key    the centre")
    assert key_goes_on.startswith(" " * 9)
    assert key_goes_on[9] != " "
    assert other == "  other  short"
    assert max(map(len, (note, note_goes_on, warning, *rest, key, key_goes_on))) <= 80


def test_a_path_is_longer_than_a_line_rather_than_broken(capsys: Captured) -> None:
    path = "/".join(["folder-of-results"] * 8)
    show_notes([f"see {path} for more"], "note")
    assert path in capsys.readouterr().out


@pytest.mark.parametrize("name", builtin_names())
def test_every_key_is_shown_unbroken_with_its_number(stommel: Any, name: str) -> None:
    shown = stommel("vehicle", "show", name).out.splitlines()
    assert max(map(len, shown)) <= 80
    begun = [line.split(" = ") for line in shown if " = " in line]
    keys = {key: rest[0] for key, *rest in begun}
    for key, value, _ in stated_numbers(load_vehicle(name)):
        if not isinstance(value, list):
            assert keys[key].split(" ")[0] == str(value)
        else:
            assert key in keys


def test_a_torque_constant_is_shown_in_its_unit(stommel: Any) -> None:
    shown = stommel("vehicle", "show", "zju").out
    assert "drives.pitch.motor.torque_constant_mn_m_a = 23 mN m/A\n" in shown
    assert "engine.solenoid_valves.0.loss_mpa_s2_ml2 = 0.0008 MPa s2/ml2\n" in shown


@pytest.mark.parametrize("name", ["rogue", "seawing"])
def test_what_a_design_could_not_answer_is_one_sentence(stommel: Any, name: str) -> None:
    found = stommel("design", name, "--no-report", "--json").json
    shown = stommel("design", name, "--no-report").out
    assert len(found["unanswered"]) > 5
    assert shown.lower().count("not answered") == 1
    told = " ".join(shown.split("not answered: ")[1].split())
    assert told.startswith(", ".join(found["unanswered"]))


def test_a_turn_shows_what_steers_and_nothing_that_the_vehicle_lacks(stommel: Any) -> None:
    by_rolling = stommel("turn", "seawing", "--speed", 0.4, "--pitch", -30, "--turn-rate", 0.005).out
    assert "roll of moving mass" in by_rolling
    assert "rudder" not in by_rolling
    by_rudder = stommel("turn", "zju", "--speed", 0.4, "--pitch", -35, "--radius", 20).out
    assert "rudder" in by_rudder
    assert "roll of moving mass" not in by_rudder
