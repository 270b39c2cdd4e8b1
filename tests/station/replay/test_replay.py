"""Replays: the past told again whole, at any speed that listeners can follow, beside the present."""

import json
import time
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from websockets.sync.client import connect

from stommel.archive import Archive, Batch
from stommel.station.live.events import Samples
from stommel.station.replay import replay as replay_module
from stommel.station.replay.course import LONGEST_STEP, Course
from stommel.station.replay.reading import MOST_SAMPLES, channel_keys, samples_between, values_at
from stommel.station.station import Station
from stommel.station.web.app import create_app
from tests.station.client import Client
from tests.support.station_served import served
from tests.support.waiting import WITHIN, until

T0 = 1_700_000_000.0
DEPTHS = [("depth_m", T0 + n, float(n % 200)) for n in range(20_000)]


# the clock of a replay

steps = st.lists(
    st.one_of(
        st.tuples(st.just("pass"), st.floats(0.0, 5.0)),
        st.tuples(st.just("speed"), st.floats(0.1, 1000.0)),
        st.tuples(st.just("pause"), st.floats(0.0, 1.0)),
        st.tuples(st.just("jump"), st.floats(-50.0, 1050.0)),
    ),
    max_size=40,
)


@given(steps)
def test_a_course_goes_forward_only_and_stays_inside(moves: list[tuple[str, float]]) -> None:
    course = Course(0.0, 1000.0, 1.0, 0.0)
    for what, value in moves:
        before = course.at
        if what == "pass":
            due = course.due(value)
            assert before <= due <= before + course.speed * LONGEST_STEP + 1e-9
            assert due == before or course.goes_on
            course.at = due
        elif what == "speed":
            course.speed = value
        elif what == "pause":
            course.paused = value > 0.5
        else:
            course.jump(value)
        assert 0.0 <= course.at <= 1000.0


# what it reads


def test_what_is_read_is_all_in_order_whatever_the_stretches(station: Station) -> None:
    """Oracle: the samples that were stored; far more than are read at once."""
    second = [("pitch_deg", t + 0.5, value) for _, t, value in DEPTHS[::2]]
    station.archive.store(1, Batch(samples=[*DEPTHS, *second]))
    found, begin = [], T0 - 1.0
    with station.archive.reading() as connection:
        known = channel_keys(connection, 1)
        for step in (100.0, 7.5, 0.001, 30_000.0, 30_000.0, 30_000.0, 30_000.0, 30_000.0, 30_000.0):
            some, reached = samples_between(connection, 1, known, begin, begin + step)
            assert len(some) <= MOST_SAMPLES
            assert begin < reached <= begin + step + 1e-6
            found += some
            begin = reached
        assert values_at(connection, 1, known, T0 + 10.4) == {
            "depth_m": (T0 + 10.0, 10.0), "pitch_deg": (T0 + 8.5, 8.0),
        }  # fmt: skip
        assert values_at(connection, 1, known, T0 - 1.0) == {}
    assert found == sorted([*DEPTHS, *second], key=lambda sample: sample[1])


# through the hub


def test_a_replay_tells_every_sample_once_and_stands_at_its_end(station: Station, client: Client) -> None:
    station.archive.store(1, Batch(samples=DEPTHS[:2000], texts=[(T0 + 5.0, 4, "hello")]))
    news = station.hub.watch()
    state = client.post("/replays", {"vehicle": 1, "begin": T0 - 1.0, "end": T0 + 1500.0, "speed": 1000.0})
    reader = station.hub.subscribe("a", f"replay:{state['replay']}", ["depth_m"], True)
    found: list[float] = []
    seen = []

    def at_end() -> bool:
        is_at_end = client.get(f"/replays/{state['replay']}")["at"] == T0 + 1500.0
        message = reader.collect()
        if message is not None:
            found.extend(message["samples"]["depth_m"][0])
        seen.append(news.collect())
        return is_at_end and message is None

    until(at_end)
    assert found == [T0 + n for n in range(1501)]
    now = client.get(f"/replays/{state['replay']}")
    assert (now["paused"], now["ended"]) == (True, False)
    texts = [event for event in seen if event and event.get("kind") == "text"]
    assert texts == [
        {
            "type": "event", "kind": "text", "vehicle": f"replay:{state['replay']}",
            "data": {"t": T0 + 5.0, "severity": 4, "words": "hello"},
        }
    ]  # fmt: skip
    assert station.hub.values(1) == {}


def test_a_replay_stands_jumps_and_ends(station: Station, client: Client) -> None:
    station.archive.store(1, Batch(samples=DEPTHS[:2000]))
    made = client.post("/replays", {"vehicle": 1, "begin": T0, "end": T0 + 1999.0, "speed": 0.1})
    path, name = f"/replays/{made['replay']}", f"replay:{made['replay']}"
    client.request("PUT", path, json={"paused": True})
    changed = client.request("PUT", path, json={"at": T0 + 1000.5, "speed": 2.0}).json()
    assert (changed["at"], changed["paused"], changed["speed"]) == (T0 + 1000.5, True, 2.0)
    assert station.hub.values(name) == {"depth_m": (T0 + 1000.0, 0.0)}
    client.request("PUT", path, json={"at": T0 + 7.0})
    assert station.hub.values(name) == {"depth_m": (T0 + 7.0, 7.0)}
    time.sleep(0.3)
    assert client.get(path)["at"] == T0 + 7.0
    reader = station.hub.subscribe("a", name, ["depth_m"])
    client.request("PUT", path, json={"paused": False, "speed": 1000.0})
    until(lambda: client.get(path)["at"] > T0 + 100.0)
    assert client.request("DELETE", path).status_code == 204
    assert client.refused("PUT", path, 404, json={})["reason"] == "this replay is over; begin another"
    assert reader.is_closed
    assert not station.hub.knows(name)


@pytest.mark.parametrize(
    ("body", "status", "key"),
    [
        ({"vehicle": 7, "begin": 0, "end": 10}, 404, "vehicle"),
        ({"vehicle": 1, "begin": 10, "end": 10}, 422, "end"),
        ({"vehicle": 1, "begin": 10, "end": 5}, 422, "end"),
        ({"vehicle": 1, "begin": 0, "end": 1e12}, 422, "end"),
        ({"vehicle": 1, "begin": 0, "end": 10, "speed": 0.05}, 422, "speed"),
        ({"vehicle": 1, "begin": 0, "end": 10, "speed": 1001}, 422, "speed"),
        ({"vehicle": 1, "begin": 0, "end": 10, "sped": 1}, 422, "sped"),
    ],
)
def test_a_replay_that_cannot_be_is_refused(client: Client, body: dict[str, Any], status: int, key: str) -> None:
    assert client.refused("POST", "/replays", status, json=body)["key"] == key


def test_a_jump_out_of_the_replay_is_refused(station: Station, client: Client) -> None:
    station.archive.store(1, Batch(samples=DEPTHS[:101]))
    made = client.post("/replays", {"vehicle": 1, "begin": T0, "end": T0 + 100.0})
    told = client.refused("PUT", f"/replays/{made['replay']}", 422, json={"at": T0 + 101.0})
    assert told["key"] == "at"


def test_there_is_an_end_to_replays(station: Station, client: Client) -> None:
    station.archive.store(1, Batch(samples=DEPTHS[:101]))
    body = {"vehicle": 1, "begin": T0, "end": T0 + 100.0}
    for _ in range(10):
        client.post("/replays", body)
    assert "end one of them first" in client.refused("POST", "/replays", 409, json=body)["reason"]
    assert len(client.get("/replays")) == 10
    station.replays.stop()
    until(lambda: client.get("/replays") == [])


def test_a_replay_to_which_nobody_listens_ends(station: Station, client: Client) -> None:
    station.archive.store(1, Batch(samples=DEPTHS[:101]))
    replay = station.replays.begin("local", 1, T0, T0 + 100.0, 1.0)
    reader = station.hub.subscribe("a", replay.name, [])
    replay._alone = 0.3
    time.sleep(0.6)
    assert len(client.get("/replays")) == 1
    reader.close()
    until(lambda: client.get("/replays") == [])


def test_a_replay_waits_for_a_reader_that_is_slow(station: Station, monkeypatch: pytest.MonkeyPatch) -> None:
    """yamcs/yamcs#911: at full speed, no more waits than is allowed, and nothing is lost."""
    monkeypatch.setattr(replay_module, "MOST_WAITING", 500)
    station.archive.store(1, Batch(samples=DEPTHS))
    replay = station.replays.begin("ana", 1, T0 - 1.0, T0 + 19_999.0, 1000.0)
    reader = station.hub.subscribe("a", replay.name, ["depth_m"], True)
    until(lambda: reader.waiting > 500)
    held = replay.state()["at"]
    time.sleep(0.5)
    assert replay.state()["at"] == held  # nobody took anything: it stands
    assert reader.waiting <= 500 + 1000.0 * LONGEST_STEP
    found: list[float] = []
    while len(found) < 2000:
        message = reader.collect()
        if message is not None:
            assert message["type"] == "samples"
            found += message["samples"]["depth_m"][0]
        time.sleep(0.005)
    assert found == [found[0] + n for n in range(len(found))]


def test_an_archive_that_fails_holds_a_replay_and_does_not_end_it(
    station: Station, monkeypatch: pytest.MonkeyPatch
) -> None:
    from stommel.archive import ArchiveError

    station.archive.store(1, Batch(samples=DEPTHS[:100]))
    replay = station.replays.begin("ana", 1, T0, T0 + 99.0, 100.0)
    station.hub.subscribe("a", replay.name, ["depth_m"])

    def fail(self: Archive) -> Any:
        raise ArchiveError("archive.sqlite: the disk is gone")

    with monkeypatch.context() as patch:
        patch.setattr(Archive, "reading", fail)
        until(lambda: replay.state()["reason"])
        assert replay.state()["reason"] == "archive.sqlite: the disk is gone"
    until(lambda: replay.state()["at"] == T0 + 99.0)
    assert replay.state()["reason"] == ""


# over the socket


def test_a_replay_at_full_speed_kills_no_connection_and_live_views_go_on(station: Station) -> None:
    """yamcs/yamcs#911: a replay at full speed is back-pressured; its slow connection lives, live views lose nothing."""
    station.archive.store(1, Batch(samples=DEPTHS[:6000]))
    live = [("pitch_deg", T0 + 1e6 + n, float(n)) for n in range(300)]
    with (
        served(create_app(station)) as address,
        connect(address.replace("http", "ws") + "/api/live", origin=address) as slow,
        connect(address.replace("http", "ws") + "/api/live", origin=address) as quick,
    ):
        replay = station.replays.begin("local", 1, T0 - 1.0, T0 + 5999.0, 1000.0)
        _ask(slow, "s", replay.name, "depth_m")
        _ask(quick, "q", 1, "pitch_deg")
        until(lambda: station.hub.listeners(replay.name) and station.hub.listeners(1))
        seen, slowly = [], []
        for sample in live:
            station.hub.publish(Samples(1, sample[1], [sample]))
            time.sleep(0.005)
            seen += _samples(quick, "q", 0.0)
            if len(slowly) < 10 and sample[2] % 20 == 0:
                slowly += _samples(slow, "s", 0.0, most=1)
        until(lambda: seen.extend(_samples(quick, "q", 0.1)) or len(seen) >= len(live))
        assert [t for t, _ in seen] == [t for _, t, _ in live]
        until(lambda: slowly.extend(_samples(slow, "s", 0.1)) or (slowly and slowly[-1][0] == T0 + 5999.0))
        assert [t for t, _ in slowly] == [T0 + n for n in range(6000)]
        assert slow.ping().wait(WITHIN)


def _ask(socket: Any, identity: str, vehicle: int | str, channel: str) -> None:
    socket.send(json.dumps(
        {"type": "subscribe", "id": identity, "vehicle": vehicle, "channels": [channel], "every": True}
    ))  # fmt: skip


def _samples(socket: Any, identity: str, patience: float, most: int = 1000) -> list[tuple[float, float]]:
    """Time and value of what has come for a subscription; a gap or an error of it fails."""
    found: list[tuple[float, float]] = []
    for _ in range(most):
        try:
            message = json.loads(socket.recv(timeout=patience))
        except TimeoutError:
            break
        if message.get("id") == identity:
            assert message["type"] == "samples", message
            (pair,) = message["samples"].values()
            found += zip(*pair, strict=True)
    return found


def test_a_replay_that_fails_says_so_and_is_over(station: Station, monkeypatch: pytest.MonkeyPatch) -> None:
    station.archive.store(1, Batch(samples=DEPTHS[:100]))
    news = station.hub.watch()

    def broken(*_: object) -> None:
        raise ZeroDivisionError("a defect")

    monkeypatch.setattr(replay_module, "samples_between", broken)
    replay = station.replays.begin("ada", 1, T0, T0 + 100.0, 10.0)
    reader = station.hub.subscribe("a", replay.name, ["depth_m"])
    until(lambda: station.replays.named(replay.identity) is None)
    assert reader.is_closed
    told = []
    while (message := news.collect()) is not None:
        told.append(message)
    last = [message["data"] for message in told if message.get("kind") == "replay"][-1]
    assert last["ended"]
    assert "ZeroDivisionError: a defect" in last["reason"]
