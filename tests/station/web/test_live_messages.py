"""The live socket says what the document of the API says that it says, every kind of message.

Oracle: the messages of a station whose vehicle is the vehicle's side of the link; each is read as the one declared
shape and written again, and nothing may be lost on the way.
"""

import json
import math
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, get_args

import httpx
import pytest
from pydantic import ValidationError
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect

from stommel.station.live.events import Happening, Samples, Summary
from stommel.station.live.hub import Hub
from stommel.station.web import live
from stommel.station.web.app import api, create_app
from stommel.station.web.live_messages import LiveEvent, LiveMessage
from tests.archive.logs.written import logs as written
from tests.station.served import Served
from tests.station.served import served as vehicle_served
from tests.station.speaker import until
from tests.station.stations import station
from tests.support.orders import ORDERS
from tests.support.station_served import served

KINDS = {get_args(each.model_fields["kind"].annotation)[0] for each in get_args(get_args(LiveEvent)[0])}


class Heard:
    """All messages of a socket, each held against its declared shape as it comes."""

    def __init__(self, socket: ClientConnection) -> None:
        self._socket = socket
        self.messages: list[dict[str, Any]] = []
        self.wrong: list[str] = []
        self._thread = threading.Thread(target=self._listen, daemon=True)
        self._thread.start()

    def _listen(self) -> None:
        try:
            for text in self._socket:
                message = json.loads(text)
                self.messages.append(message)
                if problem := misfit(message):
                    self.wrong.append(problem)
        except ConnectionClosed:
            return

    def has(self, kind: str) -> bool:
        """Whether a message of that type, or an event of that kind, came."""
        return any(kind in (message["type"], message.get("kind")) for message in list(self.messages))


def misfit(message: dict[str, Any]) -> str | None:
    """Where a message is not as it is declared; None where it is."""
    try:
        again = LiveMessage.model_validate(message).model_dump(mode="json", by_alias=True, exclude_unset=True)
    except ValidationError as error:
        return f"{message}: {error}"
    return None if again == message else f"{message} became {again}"


@contextmanager
def listening(address: str) -> Iterator[tuple[ClientConnection, Heard]]:
    with connect(f"{address.replace('http', 'ws')}/api/live") as socket:
        yield socket, Heard(socket)


def tell_everything(client: httpx.Client, vehicle: Served, log: str) -> None:
    """Let every kind of event happen but the replay."""
    client.put("/api/vehicles/1/limits/depth_m", json={"high": 10.0}).raise_for_status()
    vehicle.say("GLIDER_STATE", depth=50.0, altitude=math.nan)
    vehicle.say("STATUSTEXT", severity=4, text="hello <b>")
    vehicle.say("DIVE_SUMMARY", time_begin_unix_ms=1_700_000_000_000, time_end_unix_ms=1_700_003_600_000, dive=3)
    client.post("/api/vehicles/1/commands", json={"name": "surface"}).raise_for_status()
    client.post("/api/notes", json={"vehicle": 1, "words": "seen"}).raise_for_status()
    client.post("/api/vehicles/1/mission", json={"orders": ORDERS}).raise_for_status()
    client.post("/api/vehicles/1/transfers", json={"path": log}).raise_for_status()
    client.delete("/api/vehicles/1/holder").raise_for_status()
    client.post("/api/vehicles/1/parameters/refresh").raise_for_status()


def test_every_message_is_as_it_is_declared(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(live, "PING_EVERY", 0.2)
    with vehicle_served() as vehicle:
        name, log = next((name, data) for name, data in written(seconds=120).items() if "essential" in name)
        vehicle.files.files["logs", name] = log
        with (
            station(tmp_path, vehicle.address) as found,
            served(create_app(found)) as address,
            httpx.Client(base_url=address, timeout=30.0) as client,
            listening(address) as (socket, heard),
        ):
            until(lambda: found.vehicles[1].status().heard)
            socket.send(json.dumps({"type": "subscribe", "id": "a", "vehicle": 1, "channels": ["depth_m"]}))
            every = {"type": "subscribe", "id": "b", "vehicle": 1, "channels": ["depth_m"], "every": True}
            socket.send(json.dumps(every))
            socket.send(json.dumps({"type": "subscribe", "id": "c", "vehicle": 9, "channels": []}))
            tell_everything(client, vehicle, f"logs/{name}")
            until(lambda: heard.has("dive"))
            t = client.get("/api/vehicles/1/latest").json()["values"]["depth_m"]["t"]
            past = {"vehicle": 1, "begin": t - 50.0, "end": t + 50.0}
            replay = client.post("/api/replays", json=past).raise_for_status().json()["replay"]
            client.put(f"/api/replays/{replay}", json={"paused": True}).raise_for_status()
            wanted = KINDS | {"hello", "ping", "summary", "values", "samples", "error"}
            until(lambda: heard.wrong or all(heard.has(kind) for kind in wanted))
            assert heard.wrong == []


def test_gaps_are_as_they_are_declared() -> None:
    """What a reader is told that was too slow, of samples and of events; the hub's own tests say when."""
    hub = Hub()
    hub.open(1, lambda: 5.0)
    news = hub.watch()
    slow = hub.subscribe("a", 1, ["depth_m"], True)
    for t in range(2):
        hub.publish(Samples(1, 5.0, [("depth_m", float(t), 1.0)] * 30_000))
    for _ in range(1002):
        hub.publish(Happening("text", 1, {"t": 1.0, "severity": 4, "words": "x"}))
    hub.publish(Summary(1, {}))
    told = [slow.collect(), news.collect()]
    assert [message and message["type"] for message in told] == ["gap", "gap"]
    assert [misfit(dict(message or {})) for message in told] == [None, None]


def test_the_document_has_the_messages_and_no_body_of_another_kind() -> None:
    document = api().openapi()
    schemas = document["components"]["schemas"]
    assert {"LiveMessage", "LiveRequest", "Refused"} <= set(schemas)
    assert not [name for name in schemas if "__" in name or "Validation" in name]
    bodies = {
        status: answer["content"]["application/json"]["schema"]["$ref"]
        for status, answer in document["components"]["responses"].items()
    }
    assert set(bodies.values()) == {"#/components/schemas/Refused"}
    for path, operations in document["paths"].items():
        for method, operation in operations.items():
            refusals = [status for status in operation["responses"] if int(status) >= 400]
            assert set(refusals) <= set(bodies), f"{method} {path}"
            assert {"401", "403", "503"} <= set(refusals), f"{method} {path}"
