"""Oracle of faults in files: what the guide says a table may hold; an error names file, key, value and what may be."""

import re
from collections.abc import Callable
from math import inf
from pathlib import Path

import pytest

from stommel.errors import FileError
from stommel.sitl.campaign.run import TRIAL, load_kit
from stommel.sitl.faults.fault import Fault, faults_from
from stommel.sitl.faults.table import KINDS
from stommel.sitl.scenario import load_scenario
from tests.support.command import run_here

GOOD = '\n[[faults]]\nkind = "frames_lost"\ntarget = "motion"\nat_s = 600\nfor_s = 30\nvalue = 0.2\n'


def test_a_scenario_has_a_mission_and_faults(tmp_path: Path) -> None:
    path = tmp_path / "s.toml"
    path.write_text(TRIAL.read_text() + GOOD + '\n[[faults]]\nkind = "pump_dead"\n')
    found = load_scenario(path)
    assert found.faults == (Fault("frames_lost", "motion", 600.0, 30.0, 0.2), Fault("pump_dead", "", 0.0, inf, 0.0))
    assert found.mission.scenario.name == "Trial of faults"
    assert load_scenario(TRIAL).faults == ()


@pytest.mark.parametrize("row", KINDS, ids=lambda row: row.name)
def test_a_fault_is_what_its_table_said(row) -> None:  # type: ignore[no-untyped-def]
    target = row.targets[0] if row.targets else ""
    fault = Fault(row.name, target, 12.0, 34.0, row.default)
    assert faults_from([fault.as_table()], "file") == (fault,)
    assert faults_from([fault._replace(duration=inf).as_table()], "file") == (fault._replace(duration=inf),)


@pytest.mark.parametrize(
    ("table", "words"),
    [
        (
            {"kind": "frames_losst"},
            r"faults\[0\].kind = 'frames_losst': .*did you mean frames_lost. allowed are frame_bits_fli",
        ),
        ({}, r"faults\[0\].kind = None: is no kind"),
        ({"kind": 3}, r"faults\[0\].kind = 3: is no kind"),
        ({"kind": "frames_lost"}, r"faults\[0\].target = None: must be one of all, coordinator, motion, acquisition"),
        ({"kind": "bus_off", "target": "all"}, r"target = 'all': must be one of coordinator, motion, acquisition"),
        ({"kind": "pump_dead", "target": "pump"}, r"target = 'pump': pump_dead has none; leave it out"),
        ({"kind": "pump_dead", "value": 1}, r"value = 1: pump_dead has no value; leave it out"),
        ({"kind": "pump_weak", "value": 1.5}, r"value = 1.5: must be a number at least 0 and at most 1"),
        ({"kind": "pump_weak", "value": "half"}, r"value = 'half': must be a number"),
        ({"kind": "pump_weak", "value": True}, r"value = True: must be a number"),
        ({"kind": "pump_weak", "value": float("nan")}, r"value = nan: must be a number"),
        ({"kind": "pump_weak", "at_s": -1}, r"at_s = -1: must be a number at least 0 s"),
        ({"kind": "pump_weak", "for_s": "long"}, r"for_s = 'long': must be a number at least 0.001 s"),
        ({"kind": "pump_weak", "for_s": 0}, r"for_s = 0: must be a number at least 0.001 s"),
        *[
            ({"kind": kind, "target": "ctd", "value": 1e300}, r"value = 1e\+300: must be a number .*at most 1e\+06 of")
            for kind in ("sensor_biased", "sensor_noisy")
        ],
        ({"kind": "pump_weak", "until_s": 3}, r"until_s: is no key of a fault.*allowed are kind, target, at_s"),
        ({"kind": "sensor_biased", "target": "leak_detector"}, r"target = 'leak_detector': must be one of pressure"),
    ],
)
def test_what_is_impossible_is_named(table: dict[str, object], words: str) -> None:
    with pytest.raises(FileError) as caught:
        faults_from([table], "dive.toml")
    assert str(caught.value).startswith("dive.toml: ")
    assert re.search(words, str(caught.value))


@pytest.mark.parametrize("load", [load_scenario, load_kit])
def test_a_fault_after_the_mission_is_refused(tmp_path: Path, load: Callable[[Path], object]) -> None:
    """The trial lasts two hours; the last second of it may still break something."""
    path = tmp_path / "s.toml"
    path.write_text(TRIAL.read_text() + GOOD + '\n[[faults]]\nkind = "pump_dead"\nat_s = 7200\n')
    words = r"s.toml: faults\[1\].at_s = 7200: must be less than 7200 s, when the mission is over"
    with pytest.raises(FileError, match=words):
        load(path)
    path.write_text(path.read_text().replace("7200", "7199"))
    load(path)


def test_faults_that_are_no_list_are_refused() -> None:
    for wrong in ("frames_lost", 3, [3]):
        with pytest.raises(FileError, match="faults"):
            faults_from(wrong, "dive.toml")


def test_the_fast_simulator_says_where_faults_fly(tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text(TRIAL.read_text() + GOOD)
    found = run_here(tmp_path, "simulate", "s.toml")
    assert found.status != 0
    assert "stommel sitl" in found.err
    assert "s.toml: faults" in found.err
