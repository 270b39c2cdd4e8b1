"""Oracle of `stommel sitl campaign` and `replay`: what their help says of each option, on flights of a minute."""

from pathlib import Path
from typing import Any

import pytest

from stommel.sitl.campaign import kit
from stommel.sitl.campaign.run import TRIAL
from stommel.sitl.campaign.verdict import FAILED, Verdict
from tests.support.command import run_here


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    text = TRIAL.read_text().replace("duration_days = 0.08333333333333333", "duration_days = 0.0007")
    (tmp_path / "minute.toml").write_text(text)
    return tmp_path


@pytest.fixture
def in_this_process(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Fly here, and keep how many workers were asked for."""
    from stommel.sitl.campaign import run

    asked: list[int] = []

    def fly_here(kit: Any, tasks: Any, workers: int, _stop: Any, fly: Any) -> Any:
        asked.append(workers)
        yield from (fly(kit, number, values) for number, values in tasks)

    monkeypatch.setattr(run, "fly_here", fly_here)
    return asked


def test_each_option_of_a_campaign(folder: Path, in_this_process: list[int]) -> None:
    call = ("sitl", "campaign", "minute.toml", "--output", "out", "--seed", "7", "--workers", "3", "--json")
    found = run_here(folder, *call, "--runs", "2")
    assert found.status == 0, found.err
    assert found.json["flights"] == found.json["passed"] + sum(found.json["unsurvivable"].values()) == 2
    assert found.json["kept"] == 0
    assert found.json["written"] == []
    assert in_this_process == [3]
    assert sorted(path.name for path in (folder / "out" / "0000").iterdir()) == ["0000007.json", "0000008.json"]
    assert run_here(folder, *call, "--runs", "3").json["kept"] == 2
    assert run_here(folder, *call, "--runs", "3", "--restart").json["kept"] == 0


def test_a_failing_flight_is_written_as_scenarios_and_is_the_exit_status(
    folder: Path, in_this_process: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    def planted(_mission: Any, faults: Any, _radio: Any) -> Verdict:
        return Verdict(FAILED if faults else "passed", "planted", "somewhere")

    monkeypatch.setattr(kit, "fly_with", planted)
    found = run_here(folder, "sitl", "campaign", "minute.toml", "--runs", "1", "--json")
    assert found.status == 1
    (failed,) = found.json["failed"]
    assert failed["why"] == "planted"
    assert len(failed["fewest"]) == 1
    assert found.json["written"] == [f"campaign/failing/seed_1{name}.toml" for name in ("", "_fewest")]
    words = run_here(folder, "sitl", "campaign", "minute.toml", "--runs", "1")
    assert "1 flight with faults: 1 failed" in words.out
    assert failed["fewest"][0].split()[0] in words.out
    again = run_here(folder, "sitl", "replay", "campaign/failing/seed_1_fewest.toml", "--json")
    assert again.status == 0, again.err
    assert again.json["faults"] == failed["fewest"]
    assert again.json["seed"] == 1


def test_replay_of_a_seed(folder: Path) -> None:
    first = run_here(folder, "sitl", "replay", "minute.toml", "--seed", "4", "--json")
    assert first.status == 0, first.err
    assert first.json == run_here(folder, "sitl", "replay", "minute.toml", "--seed", "4", "--json").json
    other = run_here(folder, "sitl", "replay", "minute.toml", "--seed", "5", "--json")
    assert other.json["sha256"] != first.json["sha256"]
    words = run_here(folder, "sitl", "replay", "minute.toml", "--seed", "4")
    assert f"Seed 4: {first.json['verdict']}" in words.out
    assert first.json["faults"][0].split()[0] in words.out


def test_a_wrong_scheduler_is_named(folder: Path) -> None:
    found = run_here(folder, "sitl", "campaign", "minute.toml", "--runs", "1", "--scheduler", "nowhere")
    assert found.status != 0
    assert "--scheduler nowhere: must look like tcp://host:8786" in found.err


def test_bad_faults_of_a_scenario_are_named(folder: Path) -> None:
    (folder / "bad.toml").write_text((folder / "minute.toml").read_text() + '\n[[faults]]\nkind = "pump_deaf"\n')
    for verb in (("sitl", "replay"), ("sitl", "campaign"), ("sitl", "fly")):
        found = run_here(folder, *verb, "bad.toml")
        assert found.status != 0
        assert "bad.toml: faults[0].kind = 'pump_deaf'" in found.err
        assert "did you mean pump_dead" in found.err


def test_the_loop_flies_a_scenario_with_faults(folder: Path) -> None:
    text = (folder / "minute.toml").read_text()
    (folder / "broken.toml").write_text(text + '\n[[faults]]\nkind = "bus_off"\ntarget = "motion"\nat_s = 5\n')
    sound = run_here(folder, "sitl", "minute.toml", "--json")
    broken = run_here(folder, "sitl", "broken.toml", "--json")
    assert sound.status == broken.status == 0, broken.err
    assert broken.json["frames_to_coordinator"] < sound.json["frames_to_coordinator"] - 50
