"""`stommel plan`: for scripts what the planner of the station is for people. Oracle: the planner's own functions."""

import json
from pathlib import Path
from typing import Any

import pytest

from stommel.plans.plan_file import read_plan
from stommel.plans.preview.flight import previewed
from stommel.plans.preview.ordering import orders_for
from tests.plans.plans import PLAN, plan_with
from tests.support.command import Command


@pytest.fixture
def plan(tmp_path: Path) -> Path:
    path = tmp_path / "plan.json"
    path.write_text(json.dumps(PLAN))
    return path


def with_changes(folder: Path, **changes: Any) -> Path:
    path = folder / "changed.json"
    path.write_text(json.dumps(plan_with(**changes)))
    return path


def test_a_plan_is_checked_and_its_orders_written(stommel: Command, plan: Path, tmp_path: Path) -> None:
    orders = tmp_path / "orders.toml"
    answer = stommel("plan", "check", plan, "--output", orders)
    assert answer.status == 0, answer.err
    text = orders.read_text()
    assert text == orders_for(read_plan(plan))
    assert f"its orders have {len(text)} bytes" in answer.out
    found = stommel("plan", "check", plan, "--json").json
    assert (found["problems"], found["orders"], found["written"]) == ([], text, [])


def test_everything_that_is_wrong_is_told_with_status_1(stommel: Command, tmp_path: Path) -> None:
    dives = {"depth_m": 300, "pitch_deg": 30, "speed_m_s": 0.5}
    wrong = with_changes(tmp_path, dives=dives, surface={"ballast_ml": 400})
    orders = tmp_path / "none.toml"
    answer = stommel("plan", "check", wrong, "--output", orders)
    assert answer.status == 1
    assert answer.out.splitlines()[0] == "2 problems"
    assert "dives.depth_m = 300: deeper than the hull's rating, 200 m" in answer.out
    assert not orders.exists()
    found = stommel("plan", "check", wrong, "--json")
    assert found.status == 1
    assert [(each["key"], each["allowed"]) for each in found.json["problems"]] == [
        ("dives.depth_m", "at most 200 m"), ("surface.ballast_ml", "at most 250 ml"),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('{"name": 3}', "name = 3: must be text"),
        ("{", "is not valid JSON"),
        ('{"duration_days": NaN}', "NaN is no number of JSON"),
        ("[" * 100_000, "nested too deeply"),
        ("", "is not valid JSON"),
    ],
)
def test_what_is_no_plan_is_told_with_status_2(stommel: Command, tmp_path: Path, text: str, words: str) -> None:
    path = tmp_path / "odd.json"
    path.write_text(text)
    for verb in ("check", "preview"):
        answer = stommel("plan", verb, path)
        assert answer.status == 2
        assert words in answer.err
        assert "Traceback" not in answer.err


def test_a_plan_may_be_toml(stommel: Command, tmp_path: Path) -> None:
    path = tmp_path / "plan.toml"
    path.write_text(
        'name = "t"\nvehicle = "zju"\nstart = { latitude_deg = 28.7, longitude_deg = 126.1 }\n'
        "start_time = 2026-07-01T00:00:00Z\nwaypoints = [{ latitude_deg = 28.67, longitude_deg = 126.13 }]\n"
        "dives = { depth_m = 70, pitch_deg = 30, speed_m_s = 0.5 }\n"
    )
    assert stommel("plan", "check", path).status == 0


def test_a_preview_shows_what_its_json_says(stommel: Command, plan: Path, tmp_path: Path) -> None:
    expected = previewed(read_plan(plan))
    found = stommel("plan", "preview", plan, "--json").json
    assert {key: value for key, value in found.items() if key != "written"} == json.loads(json.dumps(expected))
    file = tmp_path / "flown.json"
    answer = stommel("plan", "preview", plan, "--output", file)
    assert json.loads(file.read_text()) == json.loads(json.dumps(expected))
    assert expected["verdict"][:40] in answer.out
    assert f"{expected['energy_j'] / 3600.0:.1f} W h" in answer.out
    assert f"{expected['battery_left_share']:.1%}" in answer.out
    rows = [line.split() for line in answer.out.splitlines()]
    first = expected["dives"][0]
    minutes = (first["t_end"] - first["t_begin"]) / 60.0
    assert ["1", f"{minutes:.1f}", f"{first['greatest_depth_m']:.1f}", f"{first['energy_j'] / 3600.0:.2f}"] in rows


def test_orders_open_as_a_plan_that_makes_them_again(stommel: Command, tmp_path: Path) -> None:
    made = with_changes(tmp_path, dives={"depth_m": 70, "pitch_deg": 30, "ballast_ml": 40})
    orders, again, plan = tmp_path / "a.toml", tmp_path / "b.toml", tmp_path / "opened.json"
    assert stommel("plan", "check", made, "--output", orders).status == 0
    answer = stommel("plan", "open", orders, "--vehicle", "zju", "--start", "28.7,126.1", "--output", plan)
    assert answer.status == 0, answer.err
    assert "to 70 m at 30 deg with 40 ml" in answer.out
    found = stommel("plan", "open", orders, "--vehicle", "zju", "--start", "28.7,126.1", "--json").json
    assert found["plan"] == json.loads(plan.read_text())
    assert stommel("plan", "check", plan, "--output", again).status == 0
    assert again.read_text() == orders.read_text()


@pytest.mark.parametrize("start", ["28.7", "a,b", "95,0", "0,400", "nan,0", "1,2,3", ""])
def test_an_impossible_start_is_refused(stommel: Command, tmp_path: Path, start: str) -> None:
    answer = stommel("plan", "open", tmp_path / "o.toml", "--vehicle", "zju", "--start", start)
    assert answer.status == 2
    assert "--start" in answer.err
