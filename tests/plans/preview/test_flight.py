"""A plan flown. Oracle: the mission file that says the same, flown as `stommel simulate` does."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from stommel.plans.preview.flight import MOST_POINTS, previewed
from stommel.plans.problems import plan_from
from stommel.simulation.flight import Flown, fly_mission
from stommel.simulation.results.summary import summary
from stommel.simulation.scenario.loading import mission_from
from tests.plans.plans import PLAN, place, plan_with


def fly(**changes: Any) -> dict[str, Any]:
    return previewed(plan_from(plan_with(**changes)))


@pytest.fixture(scope="module")
def preview() -> dict[str, Any]:
    return fly()


@pytest.fixture(scope="module")
def flown() -> Flown:
    document = {key: value for key, value in PLAN.items() if key != "water"} | {"ocean": {"name": "east_china_sea"}}
    return fly_mission(mission_from(document, "mission.toml", Path()))


def test_it_is_the_flight_of_the_mission_file(preview: dict[str, Any], flown: Flown) -> None:
    row = summary(flown)
    assert preview["verdict"] == row["verdict"]
    assert preview["surfacings"] == row["surfacings"]
    assert preview["dive_count"] == row["dives"]
    assert preview["battery_left_share"] == row["battery_left_share"]
    assert preview["energy_j"] == pytest.approx(3600.0 * sum(row["energy_wh"].values()))
    assert preview["duration_s"] == pytest.approx(row["days"] * 86400.0)


def test_its_dives_are_those_of_the_record(preview: dict[str, Any], flown: Flown) -> None:
    """Depth and time of each by the record's rows; the energy of all, and what came before, is the whole."""
    start, record = flown.mission.scenario.start_seconds, flown.record
    dives = preview["dives"]
    assert len(dives) > 5
    for dive in dives:
        assert dive["t_begin"] < dive["t_end"]
        inside = (record["time"] > dive["t_begin"] - start) & (record["time"] < dive["t_end"] - start)
        assert dive["greatest_depth_m"] == pytest.approx(record["depth"][inside].max(), abs=1.5)
        at = int(np.argmin(np.abs(record["time"] + start - dive["t_end"])))
        assert dive["latitude_end"] == pytest.approx(np.degrees(record["latitude"][at]), abs=2e-4)
    assert [dive["dive"] for dive in dives] == list(range(1, len(dives) + 1))
    spent = sum(dive["energy_j"] for dive in dives)
    assert 0.9 * preview["energy_j"] < spent <= preview["energy_j"]


def test_currents_are_those_that_its_surfacings_found(preview: dict[str, Any], flown: Flown) -> None:
    found = {int(row["dive"]): (row["current_north"], row["current_east"]) for row in flown.surfacings}
    for dive in preview["dives"]:
        expected = found.get(dive["dive"], (None, None))
        assert (dive["current_north_m_s"], dive["current_east_m_s"]) == expected
    assert len(found) > 5


def test_what_is_reduced_keeps_its_ends_and_every_dive(flown: Flown) -> None:
    long = fly(duration_days=6, guidance={"repeat": True})
    series = long["series"]
    assert len({len(curve) for curve in series.values()}) == 1
    assert len(series["t"]) <= MOST_POINTS + 2
    assert len(long["track"]) <= MOST_POINTS + 1
    t, depth = np.array(series["t"]), np.array(series["depth_m"])
    assert (np.diff(t) > 0).all()
    for dive in long["dives"][:300]:
        inside = (t >= dive["t_begin"]) & (t <= dive["t_end"])
        assert depth[inside].max() > dive["greatest_depth_m"] - 10.0
    assert long["track"][0]["lat"] == pytest.approx(28.70, abs=1e-6)
    assert json.dumps(long, allow_nan=False)
    assert flown.record["time"][0] + flown.mission.scenario.start_seconds == series["t"][0]


def test_the_path_is_depth_over_the_way_made(preview: dict[str, Any]) -> None:
    path = preview["path"]
    assert path["distance_m"] == sorted(path["distance_m"])
    assert max(path["depth_m"]) == pytest.approx(68.0, abs=2.0)
    ups = sum(a > 40.0 >= b for a, b in zip(path["depth_m"], path["depth_m"][1:], strict=False))
    assert ups == 3, "three dives, as in Fig. 17"


def test_a_given_current_carries_the_track(preview: dict[str, Any]) -> None:
    """Oracle: 0.5 m/s to the north for a quarter of a day are 10.8 km more than in still water."""
    del preview
    away = {"duration_days": 0.25, "waypoints": [place(29.3, 126.1)], "guidance": {"acceptance_radius_m": 1000}}
    still = fly(**away, water={"current": "still"})
    moved = fly(**away, water={"current": "given", "north_m_s": 0.5})
    north = (moved["track"][-1]["lat"] - still["track"][-1]["lat"]) * 110_850.0
    assert north == pytest.approx(0.5 * 21600.0, rel=0.03)


def test_what_a_pilot_should_know_is_told() -> None:
    gate = [place(28.65, 126.05), place(28.75, 126.05), place(28.75, 126.12), place(28.65, 126.12)]
    carried = fly(geofence=gate, waypoints=[place(28.74, 126.08)], water={"current": "given", "east_m_s": 0.6})
    assert any("leaves the geofence after" in words for words in carried["warnings"])
    left = carried["left_geofence"]
    assert left["lon"] > 126.12, "carried to the east"
    assert all(point["lon"] <= 126.12 for point in carried["track"] if point["t"] < left["t"])
    stopped = fly(abort={"battery_share": 0.99})
    assert any("battery low" in words for words in stopped["warnings"])
    assert fly(waypoints=[place(28.69, 126.11)], water={"current": "still"})["warnings"] == []


def test_a_flight_without_a_dive_is_one() -> None:
    short = fly(duration_days=0.01, surface={"session_s": 900})
    assert (short["dive_count"], short["dives"]) == (0, [])
    assert short["path"] == {"distance_m": [], "depth_m": []}


def test_progress_is_told_and_may_end_it() -> None:
    shares: list[float] = []
    previewed(plan_from(plan_with(guidance={"repeat": True})), shares.append)
    assert shares == [0.5, 1.0]

    def stop(_: float) -> None:
        raise KeyError

    with pytest.raises(KeyError):
        previewed(plan_from(PLAN), stop)
