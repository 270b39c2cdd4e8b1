"""The same seed gives the same bytes, wherever the nodes run; another seed gives others."""

from dataclasses import replace
from pathlib import Path

from tests.sitl.comparison import mission_of
from tests.sitl.flights import digest, flown_with_log

SECONDS = 1200


def test_the_same_seed_gives_the_same_bytes(tmp_path: Path) -> None:
    mission = mission_of("kuroshio", SECONDS, errors=True)
    flights = [
        flown_with_log(mission, tmp_path / name, separate=name == "separate") for name in ("one", "two", "separate")
    ]
    assert len({digest(tmp_path / name) for name in ("one", "two", "separate")}) == 1
    assert len({flown.record.tobytes() for flown in flights}) == 1
    assert len(flights[0].events) >= 3  # a dive and its turn
    other = replace(mission, scenario=mission.scenario.model_copy(update={"seed": mission.scenario.seed + 1}))
    flown_with_log(other, tmp_path / "other")
    assert digest(tmp_path / "other") != digest(tmp_path / "one")


def test_a_second_flight_leaves_the_log_of_the_first(tmp_path: Path) -> None:
    mission = mission_of("pool_trial", 30)
    flown_with_log(mission, tmp_path)
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    flown_with_log(mission, tmp_path)
    after = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    assert len(after) == 2 * len(before)
    assert {name: after[name] for name in before} == before
