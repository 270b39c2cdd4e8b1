"""The tutorial runs as it stands, and its numbers are what its commands answer."""

import re
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from tests.support.command import run_here
from tests.support.pages import DOCS
from tests.support.tutorial import PAGE, follow

TEXT = " ".join(PAGE.split())
PLOTTED = re.findall(r"_static/your-own-glider/(\w+\.png)", PAGE)


def number(pattern: str) -> float:
    found = re.search(pattern, TEXT)
    assert found is not None, pattern
    return float(found.group(1))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("tutorial")


@pytest.fixture(scope="module")
def answers(folder: Path) -> dict[str, list[Any]]:
    """What each verb answered in JSON, in the order of the page."""
    run, found = partial(run_here, folder), dict[str, list[Any]]()
    for arguments, outcome in follow(folder, lambda *call: run(*call, "--json")):
        assert outcome.status == 0, (arguments, outcome.err)
        found.setdefault(verb_of(arguments), []).append(outcome.json)
    return found


def verb_of(arguments: list[str]) -> str:
    return " ".join(arguments[:2]) if arguments[0] == "vehicle" else arguments[0]


def test_numbers_of_file_and_check(answers: dict[str, list[Any]]) -> None:
    copied, applied = answers["vehicle check"]
    assert copied["assumptions"] == copied["numbers"] == number(r"copied from `zju`: (\d+) assumptions")
    assert (len(copied["errors"]), len(copied["warnings"])) == (0, 9)
    lateral = {"lateral_lever", "side_force_small", "yaw_damping", "rudder_slope"}
    assert {warning["name"] for warning in applied["warnings"]} == lateral | {"moving_mass_leaves_bay"}


def test_numbers_of_the_flights(answers: dict[str, list[Any]]) -> None:
    first, _, last = answers["trim"]
    assert first["moving_mass_position_mm"] == pytest.approx(number(r"moving mass at ([\d.]+) mm and"), abs=0.05)
    assert first["ballast_volume_ml"] == pytest.approx(-number(r"mm and −([\d.]+) ml of ballast"), abs=0.05)
    assert last["moving_mass_position_mm"] == pytest.approx(number(r"need the mass at ([\d.]+) mm"), abs=0.05)
    (envelope,) = answers["envelope"]
    assert envelope["needs"]["ballast_volume_ml"] == pytest.approx(number(r"±([\d.]+) ml of ballast"), abs=0.05)


def test_numbers_of_hull_and_budget(answers: dict[str, list[Any]]) -> None:
    (hull,) = answers["hull"]
    aluminium = next(row for row in hull["materials"] if row["name"] == "6061-T6")
    assert aluminium["wall_mm"] == pytest.approx(number(r"wants a wall of ([\d.]+) mm"))
    assert aluminium["mass_kg"] == pytest.approx(number(r"mm and weighs ([\d.]+) kg"), abs=0.05)
    light, trimmed = answers["budget"]
    assert light["total_mass_kg"] == pytest.approx(number(r"parts sum to ([\d.]+) kg"), abs=0.05)
    assert "does_not_sink" in {warning["name"] for warning in light["warnings"]}
    (added,) = light["trimming"]["added"]
    assert added["mass_kg"] == pytest.approx(number(r"trim weight of ([\d.]+) kg"), abs=0.05)
    assert trimmed["rigid_body"]["centre_of_mass_m"][2] * 1e3 == pytest.approx(number(r"is ([\d.]+) mm low"), abs=0.05)
    assert not trimmed["trimming"]["added"]


def test_numbers_of_the_endurance(answers: dict[str, list[Any]]) -> None:
    still, sea = answers["endurance"]
    assert still["endurance_days"] == pytest.approx(number(r"([\d.]+) days are met"), abs=0.05)
    assert still["endurance_days"] / 2 == pytest.approx(number(r"it would have been ([\d.]+)\."), abs=0.05)
    likely = still["interval_days"]
    assert [likely["likely_least"], likely["likely_most"]] == pytest.approx(
        [number(r"it is ([\d.]+) to"), number(r"to ([\d.]+) days\. The")], abs=0.05
    )
    assert sea["endurance_days"] == pytest.approx(number(r"and ([\d.]+) days are left"), abs=0.05)
    assert sea["cycle"]["ballast_swing_ml"] == pytest.approx(number(r"must move (\d+) ml"), abs=0.5)


def test_mission_reaches_its_waypoint_and_leaves_what_the_page_says(
    answers: dict[str, list[Any]], folder: Path
) -> None:
    (flown,) = answers["simulate"]
    assert flown["waypoints"][0]["reached_after_hours"] == pytest.approx(number(r"here after ([\d.]+) hours"), abs=0.01)
    for name in ("shelf.html", "first.nc", "first.geojson", "first/mission.html"):
        assert (folder / name).stat().st_size > 0, name
    assert float(flown["deepest_m"]) < 90.0


def test_pictures_are_those_that_the_commands_draw(answers: dict[str, list[Any]], folder: Path) -> None:
    assert answers
    drawn = {path.name for path in folder.rglob("*.png")}
    assert set(PLOTTED) <= drawn
    assert set(PLOTTED) == {path.name for path in (DOCS / "_static" / "your-own-glider").iterdir()}
