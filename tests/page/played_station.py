"""A station whose live socket a test plays message by message."""

import json
import re
from typing import Any

from tests.page import fake_glider as glider

NOW = glider.EPOCH + 5000.0


class PlayedStation:
    """Takes the page's sockets one after another; says what the test says, and remembers what was asked."""

    def __init__(self, page: Any) -> None:
        self.sockets: list[Any] = []
        self.asked: list[list[dict[str, Any]]] = []
        self.alarms: dict[int, list[dict[str, Any]]] = {}
        """By vehicle, what a summary says of open alarms."""
        self._told: dict[str, tuple[float, float, float]] = {}
        page.route_web_socket(re.compile("/api/live$"), self._open)

    def _open(self, socket: Any) -> None:
        asked: list[dict[str, Any]] = []
        self.sockets.append(socket)
        self.asked.append(asked)
        self._told.clear()
        socket.on_message(lambda text: self._hear(asked, json.loads(text)))
        socket.send(json.dumps({"type": "hello", "now": NOW, "vehicles": [self._summary(1), self._summary(2)]}))

    def _summary(self, vehicle: int) -> dict[str, Any]:
        summary = glider.summary(vehicle, NOW, 20.0 if vehicle == 1 else 1.0)
        return summary | {"alarms": self.alarms.get(vehicle, [])}

    def say(self, message: dict[str, Any]) -> None:
        """Say something on the present socket."""
        self.sockets[-1].send(json.dumps(message))

    def sum_up(self, vehicle: int, heard: bool = True) -> None:
        """Say how a vehicle is now."""
        self.say({"type": "summary", "vehicle": vehicle, "summary": self._summary(vehicle) | {"heard": heard}})

    def _hear(self, asked: list[dict[str, Any]], message: dict[str, Any]) -> None:
        asked.append(message)
        if message["type"] == "subscribe":
            for channel in set(message["channels"]) & set(self._told):
                self._say(message["id"], channel)

    def _say(self, identity: str, channel: str, periods: dict[str, float] | None = None) -> None:
        t, value, now = self._told[channel]
        values = {channel: [t, value]}
        self.say(
            {
                "type": "values", "id": identity, "vehicle": 1, "now": now, "values": values,
                "periods": periods or {},
            }
        )  # fmt: skip

    def ids(self, channel: str) -> list[str]:
        """Subscriptions of the present socket that hold a channel."""
        return [m["id"] for m in self.asked[-1] if m["type"] == "subscribe" and channel in m["channels"]]

    def tell(
        self, channel: str, t: float, value: float, now: float = NOW, periods: dict[str, float] | None = None
    ) -> None:
        """Say a value to all who have asked for it on the present socket, and to those who still will."""
        self._told[channel] = (t, value, now)
        for identity in self.ids(channel):
            self._say(identity, channel, periods)
