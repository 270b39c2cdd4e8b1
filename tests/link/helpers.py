"""Services that only listen or only speak."""

from collections.abc import Callable, Iterable

from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Received
from stommel.messages.mavlink import Fields


class Listener:
    """Keeps what it hears, with the time."""

    def __init__(self) -> None:
        self.heard: list[tuple[float, Received]] = []

    def take(self, received: Received, t: float) -> None:
        self.heard.append((t, received))

    def poll(self, t: float, outbox: Outbox) -> None:
        """Says nothing."""

    def named(self, name: str) -> list[Received]:
        return [received for _, received in self.heard if received.name == name]


class Speaker:
    """Says what it is given, as soon as there is room."""

    def __init__(self, priority: Priority, messages: Iterable[tuple[str, Fields]], since: float = 0.0) -> None:
        self._priority, self._messages, self._since = priority, iter(messages), since

    def take(self, received: Received, t: float) -> None:
        """Hears nothing."""

    def poll(self, t: float, outbox: Outbox) -> None:
        while t >= self._since and outbox.room(self._priority) > 300:
            said = next(self._messages, None)
            if said is None:
                return
            outbox.put(self._priority, *said)


class Weak:
    """Cannot bear one name, or cannot speak."""

    def __init__(self, name: str = "", error: Callable[[], Exception] = lambda: ValueError("no")) -> None:
        self._name, self._error = name, error

    def take(self, received: Received, t: float) -> None:
        if received.name == self._name or not self._name:
            raise self._error()

    def poll(self, t: float, outbox: Outbox) -> None:
        if not self._name:
            raise self._error()
