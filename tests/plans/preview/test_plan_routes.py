"""Plans over HTTP, with the simulator behind them. Oracle: the planner's own functions, and the simulator's."""

import time
import tomllib
from typing import Any

import httpx
import pytest
from pyproj import Geod

from stommel.archive import Batch, DiveRow
from stommel.geometry.geodesics import Place
from stommel.plans.predicted_track import PredictedTrack
from stommel.plans.preview.flight import previewed
from stommel.plans.preview.ordering import orders_for
from stommel.plans.problems import plan_from
from stommel.station.station import Station
from stommel.station.vehicles.mission_rows import ABOARD, MissionRow, MissionRows
from tests.plans.plans import PLAN, place, plan_with


def ended(client: httpx.Client, job: str) -> dict[str, Any]:
    until = time.monotonic() + 400.0
    while time.monotonic() < until:
        row: dict[str, Any] = client.get(f"/api/jobs/{job}").raise_for_status().json()
        if row["state"] in ("done", "failed", "cancelled"):
            return row
        time.sleep(0.05)
    raise AssertionError("the job never ended")


def start(client: httpx.Client, **changes: Any) -> str:
    answer = client.post("/api/plans/preview", json={"vehicle": 1, "plan": plan_with(**changes)})
    assert answer.status_code == 202, answer.text
    return str(answer.json()["job"])


def take_aboard(station: Station, plan: dict[str, Any] | None, preview: dict[str, Any] | None) -> float:
    """Let vehicle 1 hold a mission; returns since when."""
    rows, t = MissionRows(station.archive), 1_782_864_000.0
    orders = orders_for(plan_from(PLAN))
    row = rows.add(MissionRow(0, 1, t - 60.0, "paul", PLAN["name"], "ab" * 32, orders, plan, "sending"), "", preview)
    rows.change(row.id, ABOARD, "taken", t)
    return t


def test_a_plan_is_checked_and_its_orders_come_back(client: httpx.Client) -> None:
    found = client.post("/api/plans/validate", json={"vehicle": 1, "plan": PLAN}).raise_for_status().json()
    assert found["problems"] == []
    assert found["orders"] == orders_for(plan_from(PLAN))


@pytest.mark.parametrize(
    ("change", "keys"),
    [
        ({"dives": {"depth_m": 500, "pitch_deg": 30, "speed_m_s": 0.5}}, {"dives.depth_m"}),
        ({"dives": {"depth_m": 70, "pitch_deg": 99, "speed_m_s": 99}}, {"dives.pitch_deg", "dives.speed_m_s"}),
        ({"vehicle": "slocum"}, {"vehicle"}),
        ({"vehicle": "/etc/passwd"}, {"vehicle"}),
        ({"waypoints": []}, {"waypoints"}),
        ({"water": {"current": "last_dive"}}, {"water.current"}),
    ],
)
def test_what_is_wrong_is_told_key_by_key(client: httpx.Client, change: dict[str, Any], keys: set[str]) -> None:
    body = {"vehicle": 1, "plan": plan_with(**change)}
    answer = client.post("/api/plans/validate", json=body)
    assert answer.status_code == 200
    problems = answer.json()["problems"]
    assert {problem["key"] for problem in problems} == keys
    assert all(problem["reason"] and problem["allowed"] for problem in problems)
    assert answer.json()["orders"] is None


def test_a_preview_is_the_simulators_flight(client: httpx.Client) -> None:
    row = ended(client, start(client))
    assert row["state"] == "done", row["error"]
    assert row["share"] == 1.0
    expected = previewed(plan_from(PLAN))
    assert row["result"] == expected


def test_a_plan_that_cannot_be_is_not_previewed(client: httpx.Client) -> None:
    answer = client.post("/api/plans/preview", json={"vehicle": 1, "plan": plan_with(dives={"depth_m": 70})})
    assert answer.status_code == 422
    assert {problem["key"] for problem in answer.json()["detail"]["problems"]} >= {"dives.pitch_deg"}
    row = ended(client, start(client, dives={"depth_m": 150, "pitch_deg": 30, "speed_m_s": 0.5}))
    assert row["state"] == "failed"
    assert [problem["key"] for problem in row["error"]["problems"]] == ["dives.depth_m"]


def test_a_preview_is_cancelled(client: httpx.Client) -> None:
    job = start(client, duration_days=365, guidance={"repeat": True}, abort={"battery_share": 0})
    assert client.delete(f"/api/jobs/{job}").status_code == 200
    assert ended(client, job)["state"] == "cancelled"


def test_no_job_of_this_name(client: httpx.Client) -> None:
    for ask in (client.get, client.delete):
        answer = ask("/api/jobs/0123abcd")
        assert answer.status_code == 404
        assert "there is no job" in answer.json()["detail"]["reason"]
    assert client.get("/api/jobs/..%2f..").status_code in (404, 422)


def test_templates_can_be_flown_as_they_are(client: httpx.Client) -> None:
    """At a place on the shelf, and where nothing is known of the vehicle."""
    found = client.get("/api/plan-templates", params={"vehicle": 1}).raise_for_status().json()
    assert len(found["templates"]) >= 3
    assert {"zju"} <= set(found["vehicles"])
    depth = next(field for field in found["fields"] if field["key"] == "dives.depth_m")
    assert (depth["low"], depth["high"], depth["unit"]) == (0.5, 200.0, "m")
    for template in found["templates"]:
        answer = client.post("/api/plans/validate", json={"vehicle": 1, "plan": template["plan"]}).json()
        assert answer["problems"] == [], template["name"]
        row = ended(client, start(client, **template["plan"] | {"start_time": PLAN["start_time"]}))
        assert row["state"] == "done"
        assert row["result"]["dive_count"] > 10, template["name"]
    assert client.get("/api/plan-templates", params={"vehicle": 9}).status_code == 404


def test_orders_open_as_a_plan(client: httpx.Client) -> None:
    dives = {"depth_m": 70, "pitch_deg": 30, "ballast_ml": 40}
    text = orders_for(plan_from(plan_with(dives=dives)))
    found = client.post("/api/plans/open", params={"vehicle": 1}, json={"orders": text}).raise_for_status().json()
    assert found["plan"]["dives"]["ballast_ml"] == pytest.approx(40.0)
    again = client.post("/api/plans/validate", json={"vehicle": 1, "plan": found["plan"]}).json()
    assert again["problems"] == []
    wrong = client.post("/api/plans/open", params={"vehicle": 1}, json={"orders": "no orders"})
    assert wrong.status_code == 422
    assert "not valid TOML" in wrong.json()["detail"]["reason"]


def test_how_often_the_ctd_measures_is_ordered_where_somebody_said_it(client: httpx.Client) -> None:
    """Oracle: the plan. A template leaves it to the vehicle, and so do its orders."""
    plan = client.get("/api/plan-templates", params={"vehicle": 1}).json()["templates"][0]["plan"]
    for sampling, ordered in ({}, None), ({"every_s": 10.0}, 10.0):
        body = {"vehicle": 1, "plan": plan | {"sampling": sampling}} if sampling else {"vehicle": 1, "plan": plan}
        text = client.post("/api/plans/validate", json=body).raise_for_status().json()["orders"]
        assert tomllib.loads(text).get("sample_every_s") == ordered


def test_what_the_vehicle_holds_is_shown_as_a_plan(client: httpx.Client, station: Station) -> None:
    assert client.get("/api/vehicles/1/mission/plan").status_code == 404
    t = take_aboard(station, None, None)
    found = client.get("/api/vehicles/1/mission/plan").raise_for_status().json()
    assert (found["mission"], found["t"]) == (PLAN["name"], t)
    assert found["plan"]["waypoints"] == PLAN["waypoints"]
    take_aboard(station, PLAN, None)
    kept = client.get("/api/vehicles/1/mission/plan").raise_for_status().json()
    assert kept["plan"]["dives"]["speed_m_s"] == 0.5, "as it was made"
    templates = client.get("/api/plan-templates", params={"vehicle": 1}).json()["templates"]
    assert 1000.0 < templates[0]["plan"]["neutral_density_kg_m3"] < 1050.0, "it is not trimmed anew at sea"


def test_planned_and_flown_stand_side_by_side(client: httpx.Client, station: Station) -> None:
    nothing = client.get("/api/vehicles/1/mission/comparison").raise_for_status().json()
    assert nothing["dives"] == []
    assert "not known" in nothing["reason"]
    preview = previewed(plan_from(PLAN))
    t = take_aboard(station, PLAN, preview)
    first = preview["dives"][0]
    flown = DiveRow(
        7, t + 200.0, t + 830.0, latitude_end=first["latitude_end"], longitude_end=first["longitude_end"],
        greatest_depth_m=first["greatest_depth_m"] + 1.5,
    )  # fmt: skip
    station.archive.store(1, Batch(dives=[DiveRow(6, t - 900.0, t - 300.0), flown]))
    found = client.get("/api/vehicles/1/mission/comparison").raise_for_status().json()
    assert (found["reason"], found["t"], len(found["dives"])) == (None, t, len(preview["dives"]))
    row = found["dives"][0]
    assert (row["dive"], row["flown"]["dive"]) == (1, 7)
    assert row["difference"]["depth_m"] == pytest.approx(1.5)
    assert row["difference"]["distance_m"] == pytest.approx(0.0, abs=1e-6)
    assert row["difference"]["energy_j"] is None, "the vehicle has not told it"
    assert found["dives"][1]["flown"] is None
    assert row["off_track_m"] < 20.0 + 1.0, "it ended on the track, which is kept within 20 m"
    assert (found["prediction"]["distance_m"], found["prediction"]["track"]) == (
        preview["distance_m"],
        preview["track"],
    )
    sums = found["so_far"]
    assert (sums["first"], sums["last"], sums["energy_j"]) == (1, 1, None)
    assert sums["time_s"]["predicted"] == pytest.approx(first["t_end"] - first["t_begin"])
    assert sums["time_s"]["flown"] == pytest.approx(630.0)


def test_each_fix_tells_how_far_off_the_predicted_track_it_is(client: httpx.Client, station: Station) -> None:
    """Predicted is a way straight east; the first fix is on it, the second 0.01 deg to the north, a third no fix."""
    track = [{"t": 0.0, "lat": 28.7, "lon": 126.0}, {"t": 9.0, "lat": 28.7, "lon": 126.3}]
    t = take_aboard(station, None, {"dives": [], "track": track})
    told = [(60.0, 28.7, 3.0), (90.0, 28.71, 3.0), (120.0, 28.72, 500.0)]
    station.archive.store(1, Batch(samples=[
        sample for after, latitude, age in told for sample in (
            ("latitude_deg", t + after, latitude), ("longitude_deg", t + after, 126.1), ("fix_age_s", t + after, age),
            ("position_sigma_m", t + after, 1000.0),
        )
    ]))  # fmt: skip
    found = client.get("/api/vehicles/1/mission/comparison").raise_for_status().json()
    assert [(fix["t"] - t, fix["lat"]) for fix in found["fixes"]] == [(60.0, 28.7), (90.0, 28.71)]
    _, _, north = Geod(ellps="WGS84").inv(126.1, 28.7, 126.1, 28.71)
    assert [fix["off_track_m"] for fix in found["fixes"]] == pytest.approx([0.0, north], abs=1.0)
    assert found["so_far"] is None


def upload(client: httpx.Client, **told: Any) -> httpx.Response:
    return client.post("/api/vehicles/1/mission", json={"plan": PLAN} | told)


def test_a_mission_keeps_the_preview_whose_job_it_names(client: httpx.Client, station: Station) -> None:
    """Oracle: the simulator's own result. Of another plan, forgotten, unfinished: told, and nothing given."""
    station.start()
    job = start(client)
    result = ended(client, job)["result"]
    other = upload(client, plan=plan_with(name="Another"), job=job)
    assert (other.status_code, other.json()["detail"]["key"]) == (422, "job")
    forgotten = upload(client, job="0123abcd")
    assert (forgotten.status_code, forgotten.json()["detail"]["key"]) == (404, "job")
    long = start(client, duration_days=365, guidance={"repeat": True}, abort={"battery_share": 0})
    unfinished = upload(client, job=long)
    assert (unfinished.status_code, unfinished.json()["detail"]["key"]) == (409, "job")
    client.delete(f"/api/jobs/{long}")
    assert client.get("/api/vehicles/1/missions").json() == []

    given = upload(client, job=job)
    assert given.status_code == 202, given.text
    MissionRows(station.archive).change(given.json()["id"], ABOARD, "taken", station.now(1))
    found = client.get("/api/vehicles/1/mission/comparison").raise_for_status().json()
    for name in ("t_begin", "duration_s", "energy_j", "battery_left_share", "distance_m", "dive_count"):
        assert found["prediction"][name] == result[name]
    assert [row["predicted"] for row in found["dives"]] == result["dives"]
    track = found["prediction"]["track"]
    assert (track[0], track[-1]) == (result["track"][0], result["track"][-1])
    assert len(track) < len(result["track"]) / 4
    assert found["prediction"]["track_within_m"] == 20.0
    line = PredictedTrack([Place(each["lat"], each["lon"]) for each in track])
    assert max(far or 0.0 for far in line.off([Place(each["lat"], each["lon"]) for each in result["track"]])) < 20.1


def test_what_a_forgotten_preview_told_is_taken_and_checked(client: httpx.Client, station: Station) -> None:
    station.start()
    told: dict[str, Any] = {"dives": [], "track": [{"t": 0.0, "lat": 28.7, "lon": 126.0}], "duration_s": 3600.0}
    for wrong, key in (
        ({"preview": told | {"duration_s": -1.0}}, "preview.duration_s"),
        ({"preview": told | {"track": [{"t": 0.0, "lat": 99.0, "lon": 0.0}]}}, "preview.track.0.lat"),
        ({"preview": told | {"series": {}}}, "preview.series"),
        ({"preview": {}}, "preview.dives"),
        ({"preview": told, "job": "0123abcd"}, None),
    ):
        answer = upload(client, **wrong)
        assert (answer.status_code, answer.json()["detail"]["key"]) == (422, key)
    given = upload(client, preview=told)
    assert given.status_code == 202, given.text
    MissionRows(station.archive).change(given.json()["id"], ABOARD, "taken", station.now(1))
    found = client.get("/api/vehicles/1/mission/comparison").raise_for_status().json()
    assert (found["prediction"]["track"], found["prediction"]["duration_s"]) == (told["track"], 3600.0)


def test_the_flown_track_is_held_against_the_fence_of_the_plan(client: httpx.Client, station: Station) -> None:
    """Oracle: a track straight north that leaves a fence at 28.80 deg; what came before the mission does not count."""
    fence = [place(28.6, 126.0), place(28.8, 126.0), place(28.8, 126.3), place(28.6, 126.3)]
    t = take_aboard(station, plan_with(geofence=fence), None)
    outside = [("latitude_deg", t - 600.0, 40.0), ("longitude_deg", t - 600.0, 126.1)]
    inside = [("latitude_deg", t + 60.0, 28.7), ("longitude_deg", t + 60.0, 126.1)]
    station.archive.store(1, Batch(samples=[*outside, *inside]))
    answer = client.get("/api/vehicles/1/mission/comparison").raise_for_status().json()
    assert answer["left_geofence"] is None
    track = [
        sample
        for k in range(1, 30)
        for sample in (("latitude_deg", t + 60.0 + k, 28.7 + 0.013 * k), ("longitude_deg", t + 60.0 + k, 126.1))
    ]
    station.archive.store(1, Batch(samples=track))
    left = client.get("/api/vehicles/1/mission/comparison").raise_for_status().json()["left_geofence"]
    assert left["lat"] == pytest.approx(28.804), "the eighth of the steps of 0.013 deg"
    assert left["t"] == t + 68.0
    then = client.get("/api/vehicles/1/mission", params={"at": t + 100.0}).raise_for_status().json()
    assert [(corner["latitude"], corner["longitude"]) for corner in then["geofence"]] == [
        (corner["latitude_deg"], corner["longitude_deg"]) for corner in fence
    ]
    before = client.get("/api/vehicles/1/mission", params={"at": t - 100.0}).raise_for_status().json()
    assert (before["name"], before["waypoints"]) == (None, [])
    assert before["missing"] == "it is not known which mission the vehicle held then"


def test_what_was_kept_in_place_of_a_preview_breaks_nothing(client: httpx.Client, station: Station) -> None:
    take_aboard(station, None, {"dives": [{"dive": "one"}, 3]})
    found = client.get("/api/vehicles/1/mission/comparison").raise_for_status().json()
    assert "no preview was made" in found["reason"]


def test_the_current_of_the_last_dive_is_taken(client: httpx.Client, station: Station) -> None:
    dive = DiveRow(1, 1_782_000_000.0, 1_782_000_600.0, current_north_m_s=0.2, current_east_m_s=0.1)
    station.archive.store(1, Batch(dives=[dive]))
    row = ended(client, start(client, water={"current": "last_dive"}))
    told = previewed(plan_from(plan_with(water={"current": "given", "north_m_s": 0.2, "east_m_s": 0.1})))
    assert row["result"]["track"] == told["track"]
