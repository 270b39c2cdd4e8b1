"""The one word that goes out while the archive takes nothing."""

from collections.abc import Mapping

from stommel.link.commands.client import CommandClient
from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Received
from stommel.messages.mavlink import FieldValue


class _AbortOutbox(Outbox):
    """Has room for aborts, and for nothing else."""

    def __init__(self, outbox: Outbox) -> None:
        super().__init__()
        self._through = outbox

    def put(
        self, priority: Priority, name: str, values: Mapping[str, FieldValue], component: int | None = None
    ) -> None:
        """Queue an abort."""
        if priority is Priority.ABORT:
            self._through.put(priority, name, values, component)

    def room(self, priority: Priority) -> int:
        """Bytes that it takes."""
        return self._through.room(priority) if priority is Priority.ABORT else 0


class AbortOnly:
    """A service in place of all others: commands, as far as they are aborts."""

    def __init__(self, commands: CommandClient) -> None:
        self._commands = commands

    def take(self, received: Received, t: float) -> None:
        """Hear nothing: the others have."""

    def poll(self, t: float, outbox: Outbox) -> None:
        """Say an abort that is due."""
        self._commands.poll(t, _AbortOutbox(outbox))
