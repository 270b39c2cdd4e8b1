"""Routes of alarms, limits and alerts, with a vehicle that speaks over TCP. Oracle: what it says."""

import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from stommel.station.station import Station
from tests.station.alarms.receivers import web_server
from tests.station.client import Client
from tests.station.speaker import Speaker, speaker, until
from tests.station.stations import station as running


@pytest.fixture
def vehicle() -> Iterator[Speaker]:
    with speaker() as made:
        yield made


@pytest.fixture
def station(vehicle: Speaker, tmp_path: Path) -> Iterator[Station]:
    with running(tmp_path, vehicle.address) as made:
        vehicle.connect()
        yield made


@pytest.fixture
def client(station: Station) -> Client:
    return Client(station)


def test_limits_come_from_the_vehicle_file_until_a_pilot_sets_others(client: Client) -> None:
    """Oracle: Table 3 of the paper says 200 m. Each says who set it, and when."""
    before = time.time()
    limits = {limit["channel"]: limit for limit in client.get("/vehicles/1/limits")}
    assert limits["depth_m"].pop("changed_by") == "vehicle file"
    assert limits["depth_m"].pop("changed") <= before
    assert limits["depth_m"] == {
        "channel": "depth_m", "low": None, "high": 200.0, "hysteresis": 2.0, "delay_s": 0.0, "severity": "critical",
    }  # fmt: skip
    body = {"low": -1.0, "high": 90.0, "hysteresis": 3.0, "delay_s": 0, "severity": "warning"}
    assert client.request("PUT", "/vehicles/1/limits/depth_m", json=body).status_code == 200
    assert client.request("DELETE", "/vehicles/1/limits/pitch_deg").status_code == 204
    limits = {limit["channel"]: limit for limit in client.get("/vehicles/1/limits")}
    assert limits["depth_m"].pop("changed_by") == "local"
    assert limits["depth_m"].pop("changed") >= before - 1e-3
    assert limits["depth_m"] == {"channel": "depth_m", **body}
    assert "pitch_deg" not in limits
    assert client.refused("DELETE", "/vehicles/1/limits/pitch_deg", 404)["reason"] == "this channel has no limit"


@pytest.mark.parametrize(
    ("channel", "body", "status", "words"),
    [
        ("depht_m", {"high": 1.0}, 404, "there is no such channel"),
        ("depth_m", {}, 422, "give low, high, or both"),
        ("depth_m", {"low": 5, "high": 1}, 422, "must be less than high = 1"),
        ("depth_m", {"high": 1, "delay_s": 1e9}, 422, "86400"),
        ("depth_m", {"high": 1, "severity": "bad"}, 422, "notice"),
        ("depth_m", {"high": 1, "colour": "red"}, 422, "colour"),
    ],
)
def test_a_limit_that_cannot_be_is_refused_in_words(
    client: Client, channel: str, body: dict[str, Any], status: int, words: str
) -> None:
    answer = client.request("PUT", f"/vehicles/1/limits/{channel}", json=body)
    assert answer.status_code == status
    assert words in answer.text


def test_a_vehicle_too_deep_raises_an_alarm_that_somebody_acknowledges(
    vehicle: Speaker, station: Station, client: Client
) -> None:
    news = station.hub.watch()
    vehicle.say("GLIDER_STATE", time_boot_ms=1, depth=230.5, alarms=8)
    until(lambda: len(client.get("/alarms", open=True)) == 2)
    told: list[Any] = []

    def alarms_told() -> list[Any]:
        told.append(news.collect())
        return [event["data"] for event in told if event and event.get("kind") == "alarm"]

    rows = {row["key"]: row for row in client.get("/alarms", vehicle=1)}
    assert rows["limit:depth_m:high"]["words"] == "Depth greater than 200 m"
    assert rows["limit:depth_m:high"]["value"] == 230.5
    assert rows["vehicle:too deep"]["severity"] == "critical"
    until(lambda: rows["limit:depth_m:high"] in alarms_told())
    until(lambda: len(client.get("/vehicles")[0]["alarms"]) == 2)

    number = rows["limit:depth_m:high"]["id"]
    seen = client.post(f"/alarms/{number}/acknowledge", {"note": "sensor is wrong"})
    assert (seen["acknowledged_by"], seen["note"], seen["cleared"]) == ("local", "sensor is wrong", None)
    again = client.refused("POST", f"/alarms/{number}/acknowledge", 409, json={})
    assert again["reason"] == f"alarm {number}: local has acknowledged it already"
    assert client.refused("POST", "/alarms/999/acknowledge", 404, json={})["key"] == "alarm"
    assert [row["key"] for row in client.get("/alarms", acknowledged=False)] == ["vehicle:too deep"]
    briefs = {brief["key"]: brief for brief in client.get("/vehicles")[0]["alarms"]}
    for key, row in (("limit:depth_m:high", seen), ("vehicle:too deep", rows["vehicle:too deep"])):
        assert briefs[key] == {name: row[name] for name in briefs[key]}, "a summary tells what the row says"
    assert briefs["limit:depth_m:high"]["acknowledged_by"] == "local"

    vehicle.say("GLIDER_STATE", time_boot_ms=2, depth=20.0, alarms=0)
    until(lambda: client.get("/alarms", open=True) == [])
    assert [row["id"] for row in client.get("/alarms", before=max(row["id"] for row in rows.values()))] == [1]
    until(lambda: client.get("/vehicles")[0]["alarms"] == [])


def test_an_open_alarm_is_there_after_a_restart(tmp_path: Path) -> None:
    with speaker() as vehicle:
        with running(tmp_path, vehicle.address) as first:
            vehicle.connect()
            vehicle.say("GLIDER_STATE", time_boot_ms=1, depth=230.5)
            until(lambda: first.alarms.open_of(1))
        with running(tmp_path, vehicle.address, start=False) as second:
            second.alarms.look()
            client = Client(second)
            assert [row["key"] for row in client.get("/alarms", open=True)] == ["limit:depth_m:high"]
            assert [alarm["key"] for alarm in client.get("/vehicles")[0]["alarms"]] == ["limit:depth_m:high"]


def test_alerts_can_be_tried(tmp_path: Path) -> None:
    with speaker() as vehicle, web_server(200, 500) as server:
        url = f"http://127.0.0.1:{server.server_port}/"
        with running(tmp_path, vehicle.address, start=False, alerts={"webhooks": [{"url": url}]}) as made:
            client = Client(made)
            assert client.get("/alerts") == {
                "ways": ["webhook at 127.0.0.1"], "least_severity": "warning", "quiet_s": 900.0, "cleared": True,
            }  # fmt: skip
            assert client.post("/alerts/test") == [{"way": "webhook at 127.0.0.1", "sent": True, "reason": ""}]
            (failed,) = client.post("/alerts/test")
            assert failed["reason"] == "webhook at 127.0.0.1: answers 500"
            made.alarms.look()
            assert [row["key"] for row in client.get("/alarms", open=True)] == ["alerts_failing"]


@pytest.mark.parametrize(
    "query", ["?vehicle=0", "?limit=0", "?limit=100000", "?before=-1", "?open=perhaps", "?vehicle=1e9"]
)
def test_queries_have_ranges(client: Client, query: str) -> None:
    assert client.request("GET", f"/alarms{query}").status_code == 422
