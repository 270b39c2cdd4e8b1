"""A plan alone is what a vehicle is told; a scenario adds the world. Oracle: the one file that holds both."""

from pathlib import Path

import numpy as np
import pytest

from stommel.errors import FileError
from stommel.mission.loading import load_plan
from stommel.mission.plan import Plan
from stommel.simulation.flight import fly_mission
from stommel.simulation.scenario.loading import load_mission

PLAN = """
format = 1
name = "to the buoy"
waypoints = [{ latitude_deg = 18.5, longitude_deg = 116.5 }]
dives = { depth_m = 80, pitch_deg = 30, speed_m_s = 0.3 }
abort = { dive_hours = 6 }
"""
WORLD = """
vehicle = "zju"
start_time = 2026-07-01T00:00:00Z
duration_days = 0.05
start = { latitude_deg = 18, longitude_deg = 116 }
ocean = { name = "south_china_sea" }
"""


def write(folder: Path, scenario: str, plan: str = PLAN) -> Path:
    (folder / "plan.toml").write_text(plan)
    (folder / "scenario.toml").write_text(scenario)
    return folder / "scenario.toml"


def test_plan_is_read_without_a_world(tmp_path: Path) -> None:
    write(tmp_path, "")
    plan = load_plan(tmp_path / "plan.toml")
    assert type(plan) is Plan
    assert (plan.dives.depth_m, plan.abort.dive_hours, plan.waypoints[0].latitude_deg) == (80.0, 6.0, 18.5)


def test_scenario_with_a_plan_flies_as_one_file(tmp_path: Path) -> None:
    apart = load_mission(write(tmp_path, 'plan = "plan.toml"\n' + WORLD))
    whole = tmp_path / "whole.toml"
    whole.write_text(PLAN + WORLD)
    together = load_mission(whole)
    assert apart.scenario == together.scenario
    np.testing.assert_array_equal(fly_mission(apart).record, fly_mission(together).record)


def test_scenario_may_have_a_name_of_its_own(tmp_path: Path) -> None:
    named = load_mission(write(tmp_path, 'name = "in a calm"\nplan = "plan.toml"\n' + WORLD))
    assert named.scenario.name == "in a calm"


def test_world_keys_do_not_belong_into_a_plan(tmp_path: Path) -> None:
    write(tmp_path, "", PLAN + "[leak]\nrate_ml_min = 3\n")
    with pytest.raises(FileError, match=r"plan\.toml: leak: unknown key"):
        load_plan(tmp_path / "plan.toml")


@pytest.mark.parametrize(
    ("scenario", "plan", "words"),
    [
        (
            'plan = "plan.toml"\nabort = { dive_hours = 3 }\n',
            PLAN,
            r"scenario\.toml: abort: stands here",
        ),
        ('plan = "nowhere.toml"\n', PLAN, r"nowhere\.toml"),
        ("plan = 3\n", PLAN, r"scenario\.toml: plan = 3: must be text"),
        ('plan = "plan.toml"\n', PLAN.replace("80", "-80"), r"plan\.toml: dives\.depth_m = -80"),
    ],
)
def test_wrong_plans_are_refused_by_name(tmp_path: Path, scenario: str, plan: str, words: str) -> None:
    with pytest.raises(FileError, match=words):
        load_mission(write(tmp_path, scenario + WORLD, plan))
