"""The routes of vehicles. Oracle: what the test lets the vehicle say."""

from pathlib import Path

from tests.station.client import Client
from tests.station.speaker import speaker, until
from tests.station.stations import station


def test_missing_source_is_null_with_its_reason(tmp_path: Path) -> None:
    """jenseva/spray_pilot#39 and #88: a missing source is empty, with its reason."""
    with speaker() as vehicle, station(tmp_path, vehicle.address) as found:
        client = Client(found)
        (summary,) = client.get("/vehicles")
        assert summary["vehicle"] == 1
        nulls = {key for key, value in summary.items() if value is None} - {"holder"}
        assert nulls == set(summary["missing"])
        assert {"position", "battery", "current", "speed_made_good", "eta", "next_surfacing"} <= nulls
        assert all(reason for reason in summary["missing"].values())


def test_latest_values_have_their_age_and_are_stale_when_older_than_their_period(tmp_path: Path) -> None:
    with speaker() as vehicle, station(tmp_path, vehicle.address) as found:
        vehicle.connect()
        vehicle.say("GLIDER_STATE", time_boot_ms=1, depth=12.5)
        until(lambda: "depth_m" in found.hub.values(1))
        client = Client(found)
        depth = client.get("/vehicles/1/latest")["values"]["depth_m"]
        assert depth["value"] == 12.5
        assert depth["age_s"] < depth["period_s"]
        assert not depth["stale"]
        until(lambda: client.get("/vehicles/1/latest")["values"]["depth_m"]["stale"])


def test_a_vehicle_that_is_not_there_is_404_with_those_that_are(tmp_path: Path) -> None:
    with speaker() as vehicle, station(tmp_path, vehicle.address, start=False) as found:
        client = Client(found)
        assert client.refused("GET", "/vehicles/7/latest", 404)["allowed"] == "1"
