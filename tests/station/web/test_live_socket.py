"""The live socket: greets, hands on, lets one bad subscription end alone, and shuts with the session."""

import json
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import httpx
import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect

from stommel.station.station import Station
from stommel.station.web import live
from tests.support.station_served import StandInHub, StandInReader, handshake
from tests.support.waiting import WITHIN, until


@contextmanager
def _socket(address: Any, **more: Any) -> Iterator[ClientConnection]:
    with connect(f"{str(address).rstrip('/').replace('http', 'ws')}/api/live", **more) as socket:
        yield socket


def _said(socket: ClientConnection) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(socket.recv(timeout=WITHIN), parse_constant=lambda word: pytest.fail(word))
    return found


def _subscribe(socket: ClientConnection, identity: str, **more: Any) -> None:
    socket.send(json.dumps({"type": "subscribe", "id": identity, "vehicle": 1, "channels": ["depth_m"], **more}))


@pytest.fixture
def hub(station: Station) -> StandInHub:
    hub = StandInHub()
    station.hub = hub  # type: ignore[assignment]
    return hub


def test_hello_then_what_is_known(local: httpx.Client, station: Station) -> None:
    with _socket(local.base_url) as socket:
        hello = _said(socket)
        assert hello["type"] == "hello"
        assert [row["vehicle"] for row in hello["vehicles"]] == [1]
        _subscribe(socket, "a")
        values = _said(socket)
        assert (values["type"], values["id"], values["vehicle"], values["values"]) == ("values", "a", 1, {})


def test_a_failing_subscription_closes_itself_only(local: httpx.Client, hub: StandInHub) -> None:
    """akhenry/openmct-yamcs#220: opening one view drops all live data."""
    hub.ready["bad"] = StandInReader([RuntimeError("a defect")])
    hub.ready["good"] = StandInReader([{"type": "values", "id": "good", "n": k} for k in range(3)])
    with _socket(local.base_url) as socket:
        assert _said(socket)["type"] == "hello"
        _said(socket)  # news
        _subscribe(socket, "bad")
        said = _said(socket)
        assert (said["type"], said["id"]) == ("error", "bad")
        assert "a defect" not in said["reason"]
        _subscribe(socket, "gone", vehicle=9)
        assert _said(socket)["reason"] == "there is no vehicle 9"
        _subscribe(socket, "good")
        assert [_said(socket)["n"] for _ in range(3)] == [0, 1, 2]


def test_not_a_number_is_null(local: httpx.Client, hub: StandInHub) -> None:
    hub.ready["a"] = StandInReader([{"type": "values", "values": {"depth_m": (1.0, float("nan"))}}])
    with _socket(local.base_url) as socket:
        _said(socket), _said(socket)
        _subscribe(socket, "a")
        assert _said(socket)["values"] == {"depth_m": [1.0, None]}


@pytest.mark.parametrize(
    "text",
    [
        "", "{", "[]", "null", "7", '"x"', "[" * 10_000, "{}", '{"type": "subscribe"}', '{"type": "unsubscribe"}',
        '{"type": "subscribe", "id": "a", "vehicle": -1, "channels": []}',
        '{"type": "subscribe", "id": "a", "vehicle": 1e400, "channels": []}',
        '{"type": "subscribe", "id": "a", "vehicle": 1, "channels": "depth_m"}',
        '{"type": "subscribe", "id": "a", "vehicle": 1, "channels": [], "sql": "drop"}',
        json.dumps({"type": "subscribe", "id": "a", "vehicle": 1, "channels": ["x"] * 201}),
        json.dumps({"type": "subscribe", "id": "x" * 65, "vehicle": 1, "channels": []}),
        b"\xff\xfe\x00", "\ud83d\ude00", '{"type": "\\ud800"}', '{"id": "\\ud800"}', "9" * 6000,
    ],
    ids=lambda text: repr(text)[:30],
)  # fmt: skip
def test_nonsense_is_answered_and_the_socket_stands(local: httpx.Client, hub: StandInHub, text: Any) -> None:
    with _socket(local.base_url) as socket:
        _said(socket), _said(socket)
        socket.send(
            text if isinstance(text, bytes) else text.encode("utf-8", "surrogatepass").decode("utf-8", "replace")
        )
        assert _said(socket)["type"] == "error"
        _subscribe(socket, "a")
        assert _said(socket)["type"] == "values"


def test_a_message_without_end_closes_the_socket(local: httpx.Client) -> None:
    with _socket(local.base_url) as socket:
        _said(socket)
        with pytest.raises(ConnectionClosed):  # noqa: PT012 - when it notices is its own affair
            socket.send("x" * (20 << 20))
            for _ in range(10):
                socket.recv(timeout=WITHIN)
    assert local.get("/api/station").status_code == 200


def test_subscriptions_are_bounded_and_closed_with_the_socket(local: httpx.Client, hub: StandInHub) -> None:
    with _socket(local.base_url) as socket:
        _said(socket), _said(socket)
        for number in range(live.MOST_SUBSCRIPTIONS):
            _subscribe(socket, f"s{number}")
            _said(socket)
        _subscribe(socket, "one more")
        assert "at most" in _said(socket)["reason"]
        _subscribe(socket, "s1")  # the same name replaces
        assert _said(socket)["type"] == "values"
        socket.send('{"type": "unsubscribe", "id": "s1"}')
        socket.send('{"type": "unsubscribe", "id": "never was"}')
        _subscribe(socket, "one more")
        assert _said(socket)["type"] == "values"
    until(lambda: all(reader.closed for reader in hub.given))


def test_the_socket_shuts_with_the_session(
    ada: httpx.Client, paul: httpx.Client, address: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(live, "PING_EVERY", 0.1)
    cookie = {"Cookie": f"stommel_session={paul.cookies['stommel_session']}"}
    with _socket(address, additional_headers=cookie) as socket:
        assert _said(socket)["type"] == "hello"
        while _said(socket)["type"] != "ping":
            pass
        ada.patch("/api/users/paul", json={"disabled": True})
        with pytest.raises(ConnectionClosed) as caught:  # noqa: PT012
            while True:
                socket.recv(timeout=WITHIN)
    assert caught.value.rcvd is not None
    assert caught.value.rcvd.code == 4401


def test_a_stranger_gets_no_socket(address: str) -> None:
    for headers in ({}, {"Cookie": "stommel_session=guess"}, {"Authorization": "Bearer guess"}):
        assert handshake(address, **headers) in (401, 403)


def test_a_hand_over_is_seen(paul: httpx.Client, vera: httpx.Client, address: str) -> None:
    cookie = {"Cookie": f"stommel_session={vera.cookies['stommel_session']}"}
    with _socket(address, additional_headers=cookie) as socket:
        assert _said(socket)["type"] == "hello"
        paul.post("/api/vehicles/1/holder", json={})
        while (event := _said(socket))["type"] != "event":
            pass
        assert (event["kind"], event["vehicle"], event["data"]["user"]) == ("holder", 1, "paul")
