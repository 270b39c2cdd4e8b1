"""A station's application on a free port of this machine, served by a thread, and people who ask it."""

import asyncio
import threading
from collections.abc import AsyncIterator, Iterator, Sequence
from contextlib import contextmanager
from http.client import HTTPConnection
from typing import Any

import httpx
import uvicorn
from fastapi import FastAPI

from stommel.errors import StommelError

PASSWORD = "a long way to the sea"


class StandInReader:
    """Messages that a test puts in; an exception among them is raised."""

    def __init__(self, messages: Sequence[Any], *, ends: bool = False) -> None:
        self.messages, self.ends, self.closed = list(messages), ends, False

    async def __aiter__(self) -> AsyncIterator[dict[str, Any]]:
        for message in self.messages:
            if isinstance(message, Exception):
                raise message
            yield message
        while not self.ends and not self.closed:
            await asyncio.sleep(0.01)

    def close(self) -> None:
        self.closed = True


class StandInHub:
    """Gives out the readers that a test lays ready, by identity."""

    def __init__(self) -> None:
        self.ready: dict[str, StandInReader] = {}
        self.given: list[StandInReader] = []

    def subscribe(self, identity: str, vehicle: Any, channels: Sequence[str], every: bool = False) -> StandInReader:
        if vehicle != 1:
            raise StommelError(f"there is no vehicle {vehicle}")
        reader = self.ready.get(identity) or StandInReader(
            [{"type": "values", "id": identity, "vehicle": vehicle, "values": {}, "channels": list(channels)}]
        )
        self.given.append(reader)
        return reader

    def watch(self) -> StandInReader:
        return self.subscribe("", 1, ())


@contextmanager
def served(app: FastAPI, **options: Any) -> Iterator[str]:
    """Serve an application; the address, such as http://127.0.0.1:40001."""
    config = uvicorn.Config(
        app,
        port=0,
        loop="asyncio",
        http="h11",
        log_level="warning",
        lifespan="off",
        ws="websockets-sansio",
        timeout_graceful_shutdown=1,
        **options,
    )
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run, daemon=True)
    thread.start()
    try:
        while not server.started:
            if not thread.is_alive():
                raise RuntimeError("the server did not start")
            threading.Event().wait(0.005)
        port = server.servers[0].sockets[0].getsockname()[1]
        yield f"http://127.0.0.1:{port}"
    finally:
        server.should_exit = True
        thread.join(10.0)


def handshake(address: str, **headers: str) -> int:
    """Status that answers a browser's wish for a socket."""
    place = httpx.URL(address)
    asked = {
        "Connection": "Upgrade", "Upgrade": "websocket", "Sec-WebSocket-Version": "13",
        "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ==",
    } | headers  # fmt: skip
    connection = HTTPConnection(place.host, place.port, timeout=60.0)
    try:
        connection.request("GET", "/api/live", headers=asked)
        return connection.getresponse().status
    finally:
        connection.close()


def logged_in(address: str, name: str, password: str = PASSWORD) -> httpx.Client:
    """Somebody with a session."""
    client = httpx.Client(base_url=address, timeout=60.0)
    answer = client.post("/api/session", json={"name": name, "password": password})
    assert answer.status_code == 200, answer.text
    return client
