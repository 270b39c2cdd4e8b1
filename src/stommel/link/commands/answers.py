"""Answers to commands that wait to be said: one a command, the newest."""

from typing import NamedTuple

from stommel.link.commands.states import MOST_WORDS, UNKNOWN_PERCENT, Progress
from stommel.link.outbox import Outbox, Priority
from stommel.link.words import fitted
from stommel.messages.mavlink import FieldValue, message_named

STATUS = "GLIDER_COMMAND_STATUS"
MOST = 64
"""That wait; the sender asks again for those that are dropped."""


class _Answer(NamedTuple):
    progress: Progress
    component: int
    asking: int


class Answers:
    """Answers to one shore station, by its system number."""

    def __init__(self, shore: int) -> None:
        self._shore = shore
        self._waiting: dict[int, _Answer] = {}

    def put(self, id: int, progress: Progress, component: int = 0, asking: int = 0) -> None:
        """Say what became of a command: to a component that asked, and which question it was; 0 where nobody did."""
        waiting = self._waiting.pop(id, None)
        if waiting is not None and not asking:
            component, asking = waiting.component, waiting.asking
        self._waiting[id] = _Answer(progress, component, asking)
        if len(self._waiting) > MOST:
            del self._waiting[next(iter(self._waiting))]

    def poll(self, outbox: Outbox) -> None:
        """Say what there is room for."""
        size = message_named(STATUS).layout.size
        while self._waiting and outbox.room(Priority.COMMAND) >= size:
            id = next(iter(self._waiting))
            progress, component, asking = self._waiting.pop(id)
            values: dict[str, FieldValue] = {
                "id": id,
                "target_system": self._shore,
                "target_component": component,
                "state": int(progress.state),
                "percent": min(max(progress.percent, 0), UNKNOWN_PERCENT),
                "asking": asking,
                "words": fitted(progress.words, MOST_WORDS),
            }
            outbox.put(Priority.COMMAND, STATUS, values)
