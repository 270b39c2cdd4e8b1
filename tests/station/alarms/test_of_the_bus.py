"""What the vehicle tells of its own bus, and single losses on the radio. Oracle: what the vehicle said, counted."""

from pathlib import Path

from stommel.messages.mavlink import enumeration
from tests.station.client import Client
from tests.station.speaker import speaker, until
from tests.station.stations import station

STRANGER = "alarm: unknown node: 0x709: heartbeat of an unknown node 9"


def test_a_node_that_is_refused_aboard_is_an_alarm_ashore_with_its_name(tmp_path: Path) -> None:
    """PX4/PX4-Autopilot#28243: a full allocation table refused nodes in silence."""
    with speaker() as vehicle, station(tmp_path, vehicle.address) as found:
        vehicle.connect()
        client = Client(found)
        vehicle.say("STATUSTEXT", severity=5, text=STRANGER.encode()[:50], id=0, chunk_seq=0)
        vehicle.say("GLIDER_STATE", time_boot_ms=1, alarms=enumeration("GLIDER_ALARM")["GLIDER_ALARM_UNKNOWN_NODE"])
        until(lambda: client.get("/alarms", vehicle=1, open=True))
        (alarm,) = client.get("/alarms", vehicle=1, open=True)
        assert "nknown node" in alarm["words"]
        assert client.get("/vehicles/1/log", kinds="text")["entries"][0]["words"] == STRANGER[:50]


def test_one_lost_frame_is_a_count_and_no_alarm(tmp_path: Path) -> None:
    """ArduPilot/ardupilot#13033: one lost frame was "node down"; here the page shows how many were lost."""
    with speaker() as vehicle, station(tmp_path, vehicle.address) as found:
        vehicle.connect()
        client = Client(found)
        for k in range(40):
            if k % 20 == 10:
                vehicle.frame("HEARTBEAT", {"type": 12})  # it is said, and does not arrive
            vehicle.say("HEARTBEAT", type=12)
        until(lambda: client.get("/vehicles/1/link")["figures"]["good"] == 40)
        link = client.get("/vehicles/1/link")
        assert (link["figures"]["lost"], link["heard"]) == (2, True)
        assert client.get("/alarms", vehicle=1, open=True) == []
