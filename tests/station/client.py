"""Asks the station's web door without a port."""

import asyncio
from typing import Any

import httpx

from stommel.station.station import Station
from stommel.station.web.app import create_app

ADDRESS = "http://127.0.0.1:8470"


class Client:
    """One browser or script; every call is a request of its own."""

    def __init__(self, station: Station) -> None:
        self._app: Any = create_app(station)

    def request(self, method: str, path: str, **more: Any) -> httpx.Response:
        """Answer of a path below /api."""

        async def ask() -> httpx.Response:
            transport = httpx.ASGITransport(app=self._app)
            async with httpx.AsyncClient(transport=transport, base_url=ADDRESS) as client:
                return await client.request(method, f"/api{path}", **more)

        return asyncio.run(ask())

    def get(self, path: str, **query: Any) -> Any:
        """JSON of a path that must be there."""
        answer = self.request("GET", path, params=query)
        assert answer.status_code == 200, answer.text
        return answer.json()

    def post(self, path: str, body: Any = None) -> Any:
        """JSON that a path answers to JSON."""
        answer = self.request("POST", path, json=body)
        assert answer.status_code in (200, 201, 202), answer.text
        return answer.json()

    def refused(self, method: str, path: str, status: int, **more: Any) -> dict[str, Any]:
        """The detail of an error."""
        answer = self.request(method, path, **more)
        assert answer.status_code == status, answer.text
        detail: dict[str, Any] = answer.json()["detail"]
        return detail
