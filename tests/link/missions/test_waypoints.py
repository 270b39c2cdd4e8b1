"""Waypoints by MAVLink's mission protocol. Oracle: what was sent and what was held before, compared whole."""

import os
import random

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pymavlink.dialects.v20 import common

from stommel.link.endings import Ending
from stommel.link.missions.items import MissionResult
from stommel.link.missions.port import Waypoint, WaypointPlan, WaypointRefusal
from stommel.link.missions.waypoint_client import WaypointClient, WaypointOutcome
from stommel.link.missions.waypoint_server import WaypointServer
from stommel.link.service import Received
from stommel.messages.mavlink import Fields, message_named
from tests.link.line import End, Line, Says, losing, losing_number
from tests.link.missions.vehicle import Vehicle, plan, waypoints_joined

UPLOADS = int(os.environ.get("STOMMEL_LINK_UPLOADS", "5"))
"""Sessions of 100 uploads each; 100 for the full count."""


def ended(client: WaypointClient, line: Line, within: float = 3600.0) -> WaypointOutcome:
    line.run(lambda: client.outcome is not None, within)
    assert client.outcome is not None
    return client.outcome


def test_waypoints_are_sent_and_fetched() -> None:
    vehicle = Vehicle()
    client, line = waypoints_joined(vehicle)
    sent = plan(12, 5, depth=80.0, radius=250.0)
    client.send(sent, line.t)
    assert ended(client, line).ending is Ending.WHOLE
    assert vehicle.waypoints == sent
    client.fetch(line.t)
    assert ended(client, line) == WaypointOutcome(Ending.WHOLE, "", sent)
    client.send(plan(2, 6), line.t)
    ended(client, line)
    assert vehicle.waypoints == WaypointPlan(plan(2, 6).waypoints, 80.0, 250.0), "0 keeps depth and radius"


def test_any_single_message_lost() -> None:
    """Each message of an upload, and of a download, is lost in turn."""
    for is_upload in (True, False):
        vehicle = Vehicle()
        client, line = waypoints_joined(vehicle)
        begin = (lambda client, t: client.send(plan(5), t)) if is_upload else (lambda client, t: client.fetch(t))
        begin(client, line.t)
        ended(client, line)
        total = len(line.sent)
        assert total > 10
        for number in range(total):
            vehicle = Vehicle()
            client, line = waypoints_joined(vehicle)
            line.loses = losing_number(number)
            begin(client, line.t)
            assert ended(client, line, 30.0).ending is Ending.WHOLE, f"message {number} lost"
            if is_upload:
                assert vehicle.waypoints.waypoints == plan(5).waypoints


def test_two_hundred_items_over_a_noisy_link() -> None:
    """mavlink/qgroundcontrol#12516, #7254: 30 % loss, 500 ms; it arrives whole, or the old one stays."""
    for seed in range(3):
        vehicle = Vehicle()
        old = vehicle.waypoints
        client, line = waypoints_joined(vehicle)
        line.loses, line.latency = losing(random.Random(seed), 0.3), 0.5
        client.send(plan(200, seed), line.t)
        outcome = ended(client, line)
        new = WaypointPlan(plan(200, seed).waypoints, old.depth, old.radius)
        assert (outcome.ending, vehicle.waypoints) == (Ending.WHOLE, new)
        client.fetch(line.t)
        assert ended(client, line).plan == new


@pytest.mark.parametrize("session", range(UPLOADS))
def test_a_hundred_uploads_in_one_session_cut_anywhere(session: int) -> None:
    """mavlink/qgroundcontrol#6731: after several uploads half a mission was aboard. What is held is one that was sent,
    whole, and the last one that ended whole or one sent after it; cut uploads are of few lengths, so that they could be
    mixed, and the line loses a quarter.
    """
    draw = random.Random(session)
    vehicle = Vehicle()
    client, line = waypoints_joined(vehicle)
    line.loses, line.latency = losing(draw, 0.25), draw.choice([0.02, 0.3])
    allowed = {vehicle.waypoints.waypoints}
    for number in range(100):
        sent = plan(draw.choice([3, 4, 5]), 1000 * session + number)
        client.send(sent, line.t)
        allowed.add(sent.waypoints)
        if draw.random() < 0.15:  # the shore's program is killed, another is started
            client = WaypointClient(1)
            line.shore.services = [client]
            client.send(sent, line.t)
        cut_at = line.t + draw.uniform(0.0, 8.0)
        while line.t < cut_at and client.outcome is None:
            line.step()
            assert vehicle.waypoints.waypoints in allowed
        if client.outcome is not None and client.outcome.ending is Ending.WHOLE:
            assert vehicle.waypoints.waypoints == sent.waypoints
            allowed = {sent.waypoints}
    line.wait(130.0)
    assert vehicle.waypoints.waypoints in allowed


def test_the_vehicle_gives_up_an_upload_that_does_not_go_on() -> None:
    vehicle = Vehicle()
    client, line = waypoints_joined(vehicle)
    server = line.vehicle.services[0]
    assert isinstance(server, WaypointServer)
    client.send(plan(50), line.t)
    line.run(lambda: line.counted("MISSION_ITEM_INT") == 10, 60.0)
    line.shore.services = []
    assert server.is_receiving
    line.wait(125.0)
    assert not server.is_receiving
    assert vehicle.switched == []


def test_a_dive_in_the_middle_of_an_upload() -> None:
    """The vehicle forgets the upload meanwhile; the shore begins it anew when the vehicle is heard again."""
    vehicle = Vehicle()
    client, line = waypoints_joined(vehicle)
    client.send(plan(50), line.t)
    line.run(lambda: line.counted("MISSION_ITEM_INT") == 10, 60.0)
    line.is_silent = True
    line.wait(900.0)
    line.is_silent = False
    assert ended(client, line, 200.0).ending is Ending.WHOLE
    assert vehicle.waypoints.waypoints == plan(50).waypoints


def test_a_vehicle_that_does_not_answer_fails_within_its_time() -> None:
    client, line = waypoints_joined(Vehicle())
    line.vehicle.services = []
    client.send(plan(3), line.t)
    assert ended(client, line, 200.0) == WaypointOutcome(
        Ending.FAILED, "no answer for 180 s, though the vehicle is heard"
    )


def test_a_refusal_names_the_item_and_what_is_allowed() -> None:
    vehicle = Vehicle()
    client, line = waypoints_joined(vehicle)
    vehicle.refusals = [WaypointRefusal("depth_m = 300: must be between 0 and 200 m"), WaypointRefusal("ashore", 2)]
    client.send(plan(3), line.t)
    outcome = ended(client, line)
    assert outcome.ending is Ending.REFUSED
    assert sorted(outcome.words.split("; ")) == ["depth_m = 300: must be between 0 and 200 m", "item 2: ashore"]
    client.send(plan(3)._replace(depth=-5.0), line.t)
    assert client.outcome is not None
    assert client.outcome.words == "item 0: z = 5 m: must be minus the depth of the dives, or 0 to keep it"
    client.send(WaypointPlan((), None, None), line.t)
    assert client.outcome.words == "0 waypoints: must be between 1 and 5000"
    assert vehicle.switched == []


def conversation(vehicle: Vehicle, *messages: tuple[str, Fields], system: int = 255) -> list[Received]:
    """What a vehicle answers to plain messages of ordinary software."""
    says = Says(*messages)
    line = Line(End(system, 190, [says]), End(1, 1, [WaypointServer(1, 1, vehicle)]))
    line.wait(1.0)
    return [each for each in says.heard if each.name not in ("MISSION_CURRENT", "MISSION_ITEM_REACHED")]


TO = {"target_system": 1, "target_component": 1}
ITEM: Fields = {**TO, "seq": 0, "frame": 6, "command": 16, "x": 300_000_000, "y": 1_220_000_000, "z": -50.0}


@pytest.mark.parametrize(
    ("changed", "result", "words"),
    [
        ({"command": 21}, MissionResult.UNSUPPORTED, "command = 21: must be 16"),
        ({"frame": 1}, MissionResult.UNSUPPORTED_FRAME, "frame = 1: must be a global one"),
        ({"param1": 5.0}, MissionResult.INVALID_PARAM1, "param1 = 5 s: must be 0"),
        ({"param2": -1.0}, MissionResult.INVALID_PARAM2, "param2 = -1 m: must be the acceptance radius"),
        ({"param3": 1.0}, MissionResult.INVALID_PARAM3, "param3 = 1 m: must be 0"),
        ({"param4": 90.0}, MissionResult.INVALID_PARAM4, "param4 = 90 deg: must be 0"),
        ({"x": 900_000_001}, MissionResult.INVALID_X, "x = 90.0000001 deg: must be between -90 and 90"),
        ({"y": -1_800_000_001}, MissionResult.INVALID_Y, "must be between -180 and 180"),
        ({"x": 0, "y": 0}, MissionResult.INVALID_X, "has no position"),
        ({"z": 50.0}, MissionResult.INVALID_Z, "z = 50 m: must be minus the depth"),
        ({"z": float("nan")}, MissionResult.INVALID_Z, "z = nan m: must be minus the depth"),
    ],
)
def test_an_item_that_a_glider_cannot_do(changed: Fields, result: MissionResult, words: str) -> None:
    """What ordinary software sends; the acknowledgement is MAVLink's own for the parameter."""
    vehicle = Vehicle()
    says = Says(("MISSION_COUNT", {**TO, "count": 1}))
    line = Line(End(255, 190, [says]), End(1, 1, [WaypointServer(1, 1, vehicle)]))
    line.run(lambda: any(each.name == "MISSION_REQUEST_INT" for each in says.heard), 5.0)
    says.waiting.append(("MISSION_ITEM_INT", {**ITEM, **changed}))
    line.wait(1.0)
    told = {each.name: each.values for each in says.heard}
    assert told["MISSION_ACK"]["type"] == result
    assert words in str(told["WAYPOINTS_REFUSED"]["words"])
    assert str(told["WAYPOINTS_REFUSED"]["words"]).startswith("item 0: ")
    assert vehicle.switched == []


def test_all_items_have_one_depth() -> None:
    vehicle = Vehicle()
    says = Says(("MISSION_COUNT", {**TO, "count": 2}))
    line = Line(End(255, 190, [says]), End(1, 1, [WaypointServer(1, 1, vehicle)]))
    for seq, z in ((0, -50.0), (1, -60.0)):
        line.run(lambda: any(each.values.get("seq") == seq for each in says.heard if "REQUEST" in each.name), 5.0)  # noqa: B023
        says.waiting.append(("MISSION_ITEM_INT", {**ITEM, "seq": seq, "z": z}))
    line.wait(1.0)
    refused = next(each.values for each in says.heard if each.name == "WAYPOINTS_REFUSED")
    assert refused["words"] == "item 1: z = -60 m: must be -50 m as of item 0, all dives are alike"


def test_a_second_station_cannot_end_an_upload_nor_mix_into_it() -> None:
    vehicle = Vehicle()
    client, line = waypoints_joined(vehicle)
    client.send(plan(30), line.t)
    line.run(lambda: line.counted("MISSION_REQUEST_INT") == 11, 60.0)
    server = line.vehicle.services[0]
    for name, values in (
        ("MISSION_COUNT", {**TO, "count": 1}),
        ("MISSION_ITEM_INT", {**ITEM, "seq": 10}),
        ("MISSION_ITEM_INT", {**ITEM, "seq": 11}),
        ("MISSION_ACK", {**TO, "type": 15}),
        ("MISSION_REQUEST_LIST", {**TO}),
    ):
        arrived = message_named(name).unpack(message_named(name).pack(values))
        server.take(Received(254, 190, name, arrived), line.t)
    assert ended(client, line).ending is Ending.WHOLE
    assert vehicle.waypoints.waypoints == plan(30).waypoints


def test_old_software_that_speaks_in_degrees() -> None:
    """MISSION_REQUEST is answered with MISSION_ITEM, and MISSION_ITEM is taken, to what 32 bits hold."""
    vehicle = Vehicle(WaypointPlan((Waypoint(300_000_000, 1_220_000_000),), 100.0, 500.0))
    (item,) = conversation(vehicle, ("MISSION_REQUEST", {**TO, "seq": 0}))
    assert (item.name, item.values["x"], item.values["y"]) == ("MISSION_ITEM", 30.0, 122.0)
    says = Says(("MISSION_COUNT", {**TO, "count": 1}))
    line = Line(End(255, 190, [says]), End(1, 1, [WaypointServer(1, 1, vehicle)]))
    line.run(lambda: bool([each for each in says.heard if "REQUEST" in each.name]), 5.0)
    says.waiting.append(("MISSION_ITEM", {**ITEM, "frame": 3, "x": 30.123456, "y": -122.654321}))
    line.wait(1.0)
    (waypoint,) = vehicle.waypoints.waypoints
    assert waypoint.latitude == pytest.approx(301_234_560, abs=20)
    assert waypoint.longitude == pytest.approx(-1_226_543_210, abs=80)


def test_why_waypoints_are_refused_is_told_in_words_too() -> None:
    """Software that is not ours knows no WAYPOINTS_REFUSED."""
    told: list[str] = []
    vehicle, says = Vehicle(), Says(("MISSION_CLEAR_ALL", TO))
    Line(End(255, 190, [says]), End(1, 1, [WaypointServer(1, 1, vehicle, told.append)])).wait(1.0)
    (refused,) = [each for each in says.heard if each.name == "WAYPOINTS_REFUSED"]
    assert told == [f"waypoints refused: {refused.values['words']}"]


def test_items_are_in_a_frame_that_mavsdk_knows() -> None:
    """MAVSDK's missions know MAV_FRAME_GLOBAL_RELATIVE_ALT_INT alone, and end a download at any other."""
    (item,) = conversation(Vehicle(), ("MISSION_REQUEST_INT", {**TO, "seq": 0}))
    assert item.values["frame"] == common.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT


def test_aiming_clearing_and_other_kinds_of_missions() -> None:
    vehicle = Vehicle()
    conversation(vehicle, ("MISSION_SET_CURRENT", {**TO, "seq": 2}))
    assert vehicle.current == 2
    heard = conversation(vehicle, ("MISSION_SET_CURRENT", {**TO, "seq": 3}))
    assert [each.values.get("words") for each in heard] == ["waypoint 3: must be between 0 and 2", None]
    heard = conversation(vehicle, ("MISSION_CLEAR_ALL", TO))
    assert heard[-1].values["type"] == MissionResult.DENIED
    assert "send another" in str(heard[0].values["words"])
    (count,) = conversation(vehicle, ("MISSION_REQUEST_LIST", {**TO, "mission_type": 1}))
    assert (count.values["count"], count.values["mission_type"]) == (0, 1)
    (refused,) = conversation(vehicle, ("MISSION_COUNT", {**TO, "count": 4, "mission_type": 1}))
    assert refused.values["type"] == MissionResult.UNSUPPORTED
    assert len(vehicle.waypoints.waypoints) == 3


def test_reached_and_current_are_told() -> None:
    vehicle = Vehicle()
    says = Says()
    line = Line(End(255, 190, [says]), End(1, 1, [WaypointServer(1, 1, vehicle)]))
    line.wait(1.0)
    vehicle.current = 1
    line.wait(0.2)
    told = [(each.name, each.values["seq"]) for each in says.heard]
    assert told == [("MISSION_CURRENT", 0), ("MISSION_ITEM_REACHED", 0), ("MISSION_CURRENT", 1)]
    assert says.heard[0].values["total"] == 3


def test_pymavlinks_own_waypoint_file_is_what_arrives(tmp_path) -> None:  # type: ignore[no-untyped-def]
    """Items as pymavlink's MAVWPLoader makes them of a file, its home included."""
    from pymavlink.mavwp import MAVWPLoader

    path = tmp_path / "mission.txt"
    rows = ["0\t0\t0\t16\t0\t0\t0\t0\t30.25\t122.5\t0\t1", "1\t0\t3\t16\t0\t0\t0\t0\t-30.5\t-122.75\t0\t1"]
    path.write_text("\n".join(["QGC WPL 110", *rows]) + "\n")
    loader = MAVWPLoader(1, 1)
    assert loader.load(str(path)) == 2
    vehicle = Vehicle()
    says = Says(("MISSION_COUNT", {**TO, "count": loader.count()}))
    line = Line(End(255, 190, [says]), End(1, 1, [WaypointServer(1, 1, vehicle)]))
    for seq in range(2):
        line.run(lambda: any(each.values.get("seq") == seq for each in says.heard if "REQUEST" in each.name), 5.0)  # noqa: B023
        item = loader.item(seq)
        item.mission_type = 0
        says.waiting.append(("MISSION_ITEM", {key: getattr(item, key) for key in item.fieldnames}))
    line.wait(1.0)
    assert vehicle.waypoints.waypoints == (
        Waypoint(302_500_000, 1_225_000_000), Waypoint(-305_000_000, -1_227_500_000),
    )  # fmt: skip


NAMES = [
    "MISSION_COUNT", "MISSION_ITEM_INT", "MISSION_ITEM", "MISSION_ACK", "MISSION_REQUEST_LIST", "MISSION_REQUEST_INT",
    "MISSION_REQUEST", "MISSION_CLEAR_ALL", "MISSION_SET_CURRENT",
]  # fmt: skip


@given(st.lists(st.tuples(st.sampled_from(NAMES), st.binary(max_size=40)), max_size=6))
def test_no_message_ends_the_server(messages: list[tuple[str, bytes]]) -> None:
    """Any payload of any message; whatever it then says can be packed."""
    line = Line(End(255, 190, [Says()]), End(1, 1, [WaypointServer(1, 1, Vehicle())]))
    for name, payload in messages:
        values = message_named(name).unpack(payload) | {"target_system": 1, "target_component": 1}
        line.vehicle.services[0].take(Received(255, 190, name, values), line.t)
        line.step()
    line.wait(0.2)
