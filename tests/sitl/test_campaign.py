"""Oracle of campaigns: planted bugs, the rules in words, and flights that are flown twice."""

import json
from dataclasses import replace
from math import inf
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from stommel.simulation.scenario.mission import Mission
from stommel.sitl.campaign.draw import draw_faults
from stommel.sitl.campaign.flight import FaultFlight, fly_with, with_seed
from stommel.sitl.campaign.kit import CampaignKit
from stommel.sitl.campaign.replay import replay
from stommel.sitl.campaign.run import TRIAL, load_kit, run_campaign, scenario_text
from stommel.sitl.campaign.shrink import fewest
from stommel.sitl.campaign.verdict import FAILED, PASSED, UNSURVIVABLE, wrong_log
from stommel.sitl.faults.fault import Fault
from stommel.sitl.faults.table import ANALOG, BY_NAME, DRAWN, KINDS, SENSORS
from stommel.sitl.scenario import load_scenario
from stommel.studies.errors import StudyError, StudyInterruptedError


def short(tmp_path: Path, days: float) -> CampaignKit:
    """The trial, of another length."""
    path = tmp_path / "short.toml"
    text = TRIAL.read_text().replace("duration_days = 0.08333333333333333", f"duration_days = {days}")
    assert f"duration_days = {days}" in text
    path.write_text(text)
    return load_kit(path)


# drawing


def test_faults_follow_from_the_seed_and_are_within_their_rows() -> None:
    kinds, numbers = set(), set()
    for seed in range(400):
        drawn = draw_faults(seed, 5000.0)
        assert drawn == draw_faults(seed, 5000.0)
        numbers.add(len(drawn))
        for fault in drawn:
            row = BY_NAME[fault.kind]
            kinds.add(fault.kind)
            assert fault.target in (row.targets or ("",))
            assert 0.0 <= fault.at < 5000.0
            assert fault.duration > 0.0
            assert row.low <= fault.value <= row.high or not row.has_value
            if fault.kind == "sensor_biased":
                assert fault.target in ANALOG
                assert abs(fault.value) <= SENSORS[fault.target].bias
    assert numbers == {1, 2, 3, 4}
    assert kinds == {row.name for row in DRAWN}


def test_a_seed_means_what_it_meant_before_the_radio_could_break() -> None:
    """Oracle: the flight that the guide tells of. Kinds of the radio are flown on purpose only."""
    assert Fault("clock_jump", "", 1462.0, 24.0, -2495.0) in load_kit(TRIAL).faults_of(57)
    assert {row.name for row in KINDS} - {row.name for row in DRAWN} == {"radio_dead", "radio_packets_lost"}


# shrinking


@pytest.mark.parametrize("pair", [(0, 1), (0, 7), (3, 4), (2, 6)])
def test_the_smallest_pair_of_a_planted_bug_is_found(pair: tuple[int, int]) -> None:
    assert fewest(range(8), lambda chosen: set(pair) <= set(chosen)) == pair


def test_what_fails_without_any_fault_shrinks_to_none() -> None:
    assert fewest(range(4), lambda _: True) == ()


def test_nothing_of_what_is_left_can_be_left_out() -> None:
    def fails(chosen: tuple[int, ...]) -> bool:
        return len(set(chosen) & {1, 3, 5}) >= 2

    left = fewest(range(6), fails)
    assert fails(left)
    assert len(left) == 2


def test_a_planted_bug_of_two_faults_is_shrunk_to_them(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    from stommel.sitl.campaign import kit as kits

    culprits = {"disk_full", "gps_jump"}

    def planted(_mission: Mission, faults: Any, _radio: Any) -> Any:
        bad = culprits <= {fault.kind for fault in faults}
        return SimpleNamespace(verdict=FAILED if bad else PASSED, why="planted", ending="")

    others = (Fault("frames_lost", "all", 0.0, 9.0, 0.1), Fault("disk_full", "", 0.0, 9.0, 0.0))
    monkeypatch.setattr(kits, "fly_with", planted)
    monkeypatch.setattr(kits, "draw_faults", lambda *_: (*others, Fault("gps_jump", "", 0.0, 9.0, 1.0)))
    record = kits.fly_seed(load_kit(TRIAL), 3, (3,))
    assert record["verdict"] == FAILED
    assert {table["kind"] for table in record["fewest"]} == culprits


# verdicts


def test_a_dead_pump_in_a_descent_is_counted_apart_and_a_sound_vehicle_passes(trial: Mission) -> None:
    # surfacing, GPS and radio take four minutes at most; from then on it descends
    found = fly_with(trial, (Fault("pump_dead", "", 400.0, float("inf"), 0.0),))
    assert found.verdict == UNSURVIVABLE
    assert found.why.startswith("pump_dead: lost")
    assert fly_with(_of_days(trial, 0.002), ()).verdict == PASSED


def _of_days(mission: Mission, days: float) -> Mission:
    return replace(mission, scenario=mission.scenario.model_copy(update={"duration_days": days}))


def test_without_any_power_a_descent_is_counted_apart_and_no_missing_reaction_is_blamed(trial: Mission) -> None:
    """Oracle: all three computers are off below 15 V, in the descent in which seed 175 of a campaign found it."""
    verdict = fly_with(with_seed(trial, 175), (Fault("supply_drop", "", 2145.0, inf, 9.257),))
    assert verdict.verdict == UNSURVIVABLE
    assert verdict.why.startswith("supply_drop: lost")


def test_a_pump_that_dies_at_the_surface_is_found_before_the_dive(trial: Mission) -> None:
    """Oracle: the vehicle stays where it can be fetched; its first dive would begin after 171 s, and be the last."""
    short = _of_days(trial, 0.008)
    found = fly_with(short, (Fault("pump_dead", "", 100.0, inf, 0.0),))
    assert found.verdict == PASSED, found
    assert "waiting at the surface, at 0.0 m; abort" in found.ending


@pytest.mark.parametrize(
    ("fault", "verdict"),
    [
        # 3 ml/s of oil run in from 172 s on; at 233 s the climb's ballast is left and the pump proves itself
        (Fault("pump_dead", "", 229.0, inf, 0.0), PASSED),
        (Fault("pump_dead", "", 238.0, inf, 0.0), UNSURVIVABLE),
        (Fault("valve_stuck_open", "", 229.0, inf, 1.0), PASSED),
        # open as the oil runs in on its way down: told within seconds of when it should be shut
        (Fault("valve_stuck_open", "", 250.0, inf, 0.5), PASSED),
        (Fault("valve_stuck_open", "", 400.0, inf, 0.5), UNSURVIVABLE),
    ],
)
def test_a_pump_or_valve_that_breaks_as_the_dive_begins(fault: Fault, verdict: str, trial: Mission) -> None:
    """Oracle: afloat with the climb's ballast outside it stays there; with less, no one learns of it in time."""
    assert fly_with(_of_days(trial, 2100.0 / 86400.0), (fault,)).verdict == verdict


def test_an_exception_that_escapes_fails(trial: Mission, monkeypatch: pytest.MonkeyPatch) -> None:
    flight = FaultFlight(_of_days(trial, 0.001), ())

    def broken(*_: Any) -> Any:
        raise ZeroDivisionError("planted")

    monkeypatch.setattr(flight.system.coordinator, "step", broken)
    found = flight.fly()
    assert found.verdict == FAILED
    assert "ZeroDivisionError" in found.why
    assert "planted" in found.why


def test_pump_against_valve_fails(trial: Mission, monkeypatch: pytest.MonkeyPatch) -> None:
    flight = FaultFlight(_of_days(trial, 0.001), ())
    sound = flight.system.motion.step

    def both(*arguments: Any) -> Any:
        frames, outputs = sound(*arguments)
        return frames, outputs._replace(pump=0.1, valve=0.1)

    monkeypatch.setattr(flight.system.motion, "step", both)
    assert "pump and valve" in flight.fly().why


def test_a_committed_record_that_is_altered_or_gone_fails(trial: Mission) -> None:
    flight = FaultFlight(_of_days(trial, 0.001), ())
    assert flight.fly().verdict == PASSED
    committed = sum(counts.committed for log in flight.inject.logbooks for counts in log.counts.values())
    assert committed > 100
    assert wrong_log(flight.disk, committed) == ""
    assert "read back" in wrong_log(flight.disk, committed + 1)
    content = next(content for name, content in flight.disk.files.items() if "detail" in name)
    content.data[len(content.data) // 2] ^= 1
    assert "were committed" in wrong_log(flight.disk, committed)


def test_a_vehicle_that_ends_under_water_without_coming_up_fails(trial: Mission) -> None:
    # in the middle of its first descent the flight is over
    found = fly_with(_of_days(trial, 400.0 / 86400.0), ())
    assert found.verdict == FAILED
    assert "is not coming up" in found.why


# flights of the real campaign


@pytest.mark.parametrize("seed", [57, 133, 262, 324, 2038])  # each once found a fault of the software or of the verdict
def test_vehicles_with_random_faults_come_home(seed: int, trial: Mission) -> None:
    found = fly_with(with_seed(trial, seed), load_kit(TRIAL).faults_of(seed))
    assert found.verdict == PASSED, found


# running, interrupting, replaying


def test_replay_gives_identical_bytes(tmp_path: Path) -> None:
    kit = short(tmp_path, 0.008)
    path = tmp_path / "short.toml"
    first, second, other = replay(path, 5), replay(path, 5), replay(path, 6)
    assert first == second
    assert first.digest != other.digest
    # of the same name: the orders on the vehicle's disk say from which file they were made
    written = tmp_path / "again" / path.name
    written.parent.mkdir()
    written.write_text(scenario_text(kit, 5, first.faults, "why it failed"))
    assert load_scenario(written).faults == first.faults
    assert replay(written).digest == first.digest


def test_an_interrupted_campaign_goes_on_where_it_stopped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from stommel.sitl.campaign import run

    kit, seeds = short(tmp_path, 0.002), range(1, 5)
    flown: list[int] = []

    def fly_here(kit: Any, tasks: Any, _workers: int, stop: Any, fly: Any) -> Any:
        for number, values in tasks:
            if stop.is_set():
                return
            flown.append(number)
            yield fly(kit, number, values)

    monkeypatch.setattr(run, "fly_here", fly_here)
    stopping: list[Any] = []
    real = run.interruptible

    def interruptible() -> Any:
        around = real()
        stopping.append(around)
        return _Kept(around, stopping)

    monkeypatch.setattr(run, "interruptible", interruptible)

    def progress(finished: int, _runs: int) -> None:
        if finished == 2:
            stopping[-1].set()

    with pytest.raises(StudyInterruptedError, match="2 of 4 flights are kept"):
        run_campaign(kit, tmp_path / "out", seeds, workers=1, progress=progress)
    assert flown == [1, 2]
    monkeypatch.setattr(run, "interruptible", real)
    done = run_campaign(kit, tmp_path / "out", seeds, workers=1)
    assert flown == [1, 2, 3, 4]
    assert done.kept == 2
    assert [record["seed"] for record in done.records] == [1, 2, 3, 4]
    whole = run_campaign(kit, tmp_path / "whole", seeds, workers=1)
    assert json.dumps(whole.records) == json.dumps(done.records)


class _Kept:
    """Lets a test set the event of an interruption."""

    def __init__(self, around: Any, kept: list[Any]) -> None:
        self._around, self._kept = around, kept

    def __enter__(self) -> Any:
        self._kept.append(self._around.__enter__())
        return self._kept[-1]

    def __exit__(self, *told: Any) -> Any:
        return self._around.__exit__(*told)


def test_worker_processes_fly_the_same(tmp_path: Path) -> None:
    kit = short(tmp_path, 0.001)
    done = run_campaign(kit, tmp_path / "two", range(1, 4), workers=2)
    from stommel.sitl.campaign.kit import fly_seed

    assert list(done.records) == [json.loads(json.dumps(fly_seed(kit, seed, (seed,)))) for seed in range(1, 4)]


def test_a_folder_of_another_scenario_is_refused(tmp_path: Path) -> None:
    kit = short(tmp_path, 0.001)
    run_campaign(kit, tmp_path / "out", range(1, 2), workers=1)
    other = replace(kit, document={**kit.document, "name": "Another"})
    with pytest.raises(StudyError, match="differs in: scenario"):
        run_campaign(other, tmp_path / "out", range(1, 2), workers=1)
