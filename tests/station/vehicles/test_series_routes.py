"""Values over time, track, words and frames. Oracle: what the test lets the vehicle say, and the bytes it sends."""

import time
from pathlib import Path

import pytest

from stommel.onboard.coordination.executive import TRANSITIONS
from stommel.station.states import EXECUTIVE
from tests.station.client import Client
from tests.station.speaker import speaker, until
from tests.station.stations import station


def test_series_are_what_was_said_at_the_time_that_the_vehicle_tells(tmp_path: Path) -> None:
    now = time.time()
    with speaker() as vehicle, station(tmp_path, vehicle.address) as found:
        vehicle.connect()
        vehicle.say("SYSTEM_TIME", time_unix_usec=int(now * 1e6), time_boot_ms=100_000)
        for k in range(20):
            vehicle.say("GLIDER_STATE", time_boot_ms=100_000 - 1000 * (20 - k), depth=float(k))
        until(lambda: found.hub.values(1).get("depth_m", (0.0, 0.0))[1] == 19.0)
        client = Client(found)
        told = client.get("/vehicles/1/series", channels="depth_m,altitude_m", begin=now - 60, end=now + 60)
        depth = told["channels"]["depth_m"]
        assert depth["value"] == [float(k) for k in range(20)]
        assert depth["t"] == pytest.approx([now - 20 + k for k in range(20)], abs=2e-3)
        assert told["channels"]["altitude_m"]["samples"] == 20


def test_what_cannot_be_asked_is_told(tmp_path: Path) -> None:
    with speaker() as vehicle, station(tmp_path, vehicle.address, start=False) as found:
        client = Client(found)
        wrong = [
            {"channels": "nothing"}, {"channels": "depth_m", "points": 0}, {"channels": ","},
            {"channels": "depth_m", "begin": 20, "end": 10}, {"channels": "depth_m", "begin": "nan"}, {},
        ]  # fmt: skip
        for query in wrong:
            detail = client.refused("GET", "/vehicles/1/series", 422, params=query)
            assert detail["reason"]


def test_track_has_positions_with_accuracy_and_source(tmp_path: Path) -> None:
    now = time.time()
    with speaker() as vehicle, station(tmp_path, vehicle.address) as found:
        vehicle.connect()
        vehicle.say("SYSTEM_TIME", time_unix_usec=int(now * 1e6), time_boot_ms=100_000)
        for k in range(10):
            at = 60_000 + 4000 * k
            vehicle.say("NAVIGATION_ESTIMATE", time_boot_ms=at, sigma=3.0 + k, fix_age=0.0 if k < 5 else 100.0)
            vehicle.say("GLOBAL_POSITION_INT", time_boot_ms=at, lat=290_000_000 + 1000 * k, lon=1_260_000_000)
        until(lambda: found.hub.values(1).get("latitude_deg", (0.0, 0.0))[1] == pytest.approx(29.0009))
        track = Client(found).get("/vehicles/1/track")
        assert track["latitude"] == pytest.approx([29.0 + 1e-4 * k for k in range(10)])
        assert set(track["longitude"]) == {126.0}
        assert track["sigma_m"] == [3.0 + k for k in range(10)]
        assert track["source"] == ["gps"] * 5 + ["estimate"] * 5
        assert Client(found).get("/vehicles/1/track", begin=0, end=10)["t"] == []


def test_frames_are_told_as_they_were_with_what_they_say(tmp_path: Path) -> None:
    with speaker() as vehicle, station(tmp_path, vehicle.address) as found:
        vehicle.connect()
        vehicle.say("GLIDER_STATE", time_boot_ms=7, depth=3.5)
        vehicle.say("STATUSTEXT", severity=4, text="hello <b>")
        client = Client(found)
        until(lambda: client.get("/vehicles/1/texts"))
        assert client.get("/vehicles/1/texts")[0]["words"] == "hello <b>"
        (frame,) = client.get("/vehicles/1/frames", message="GLIDER_STATE")
        kept = {each["message"] for each in client.get("/vehicles/1/frames", limit=1000)}
        assert client.get("/vehicles/1/messages") == sorted(kept) != []
        assert bytes.fromhex(frame["bytes"]) == vehicle.sent[0]
        assert (frame["direction"], frame["values"]["depth"]) == ("in", 3.5)
        client.refused("GET", "/vehicles/1/frames", 422, params={"message": "NOTHING"})
        until(lambda: client.get("/vehicles/1/link")["figures"]["good"] == 2)


def test_states_are_those_of_the_executive(tmp_path: Path) -> None:
    assert tuple((row.state.value, row.condition.words, row.next.value) for row in TRANSITIONS) == EXECUTIVE
    with speaker() as vehicle, station(tmp_path, vehicle.address, start=False) as found:
        told = Client(found).get("/vehicles/1/states")
        assert told["states"][3] == "mission"
        assert ["descent", "inflection", "at the depth"] in told["phase_transitions"]


def test_shape_is_of_the_vehicle_file(tmp_path: Path) -> None:
    with speaker() as vehicle, station(tmp_path, vehicle.address, start=False) as found:
        shape = Client(found).get("/vehicles/1/shape")
        assert shape["diameter_m"] == 0.22  # Fan et al. (2013), Table 3
        places = [x for x, _ in shape["profile"]]
        assert places == sorted(places)
        assert max(r for _, r in shape["profile"]) == 0.11
        assert shape["bladder_range_ml"] == [-250.0, 250.0]
        detail = Client(found).get("/vehicles/1")
        assert detail["shape"] == shape
        assert any(channel["key"] == "phase" and channel["values"]["1"] == "descent" for channel in detail["channels"])
