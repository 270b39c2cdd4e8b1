"""What became of a command, as its sender knows it."""

from typing import NamedTuple

from stommel.link.commands.shore_queue import Waiting
from stommel.link.commands.states import UNKNOWN_PERCENT, Progress, State
from stommel.link.commands.table import command_numbered


class Report(NamedTuple):
    """What became of a command."""

    id: int
    name: str
    parameters: tuple[float, ...]
    given: float
    """By the clock ashore [s]."""
    expires: float
    """By the clock ashore [s]."""
    state: State
    """The last word, or what the vehicle said last; `NOT_KNOWN` if it has said nothing."""
    percent: int
    """Of the execution; `UNKNOWN_PERCENT` where nobody knows."""
    words: str
    """Why; of an open one what is known, and until when the rest is not."""
    tries: int
    """How often it was said since the vehicle was heard."""
    sent: bool
    """Whether it may have left."""

    @property
    def is_last(self) -> bool:
        """Whether nothing comes after it."""
        return self.state.is_last


def report_of(entry: Waiting, now: int) -> Report:
    """Report on a command at a time of the clock ashore [ms]."""
    command, kind = entry.command, command_numbered(entry.command.number)
    known = entry.last or entry.heard or Progress(State.NOT_KNOWN, UNKNOWN_PERCENT)
    return Report(
        command.id, kind.name if kind else str(command.number), command.parameters, command.given / 1000.0,
        command.expires / 1000.0, known.state, known.percent,
        known.words if entry.last else _open_words(entry, now), entry.tries, entry.sent,
    )  # fmt: skip


def _open_words(entry: Waiting, now: int) -> str:
    """What is known of a command without a last word."""
    told = f": {entry.heard.words}" if entry.heard and entry.heard.words else ""
    if not entry.sent:
        return "taken back; the disk does not keep it yet" if entry.cancel else "not sent yet"
    if now >= entry.command.expires:
        return f"time is over; whether it was executed is unknown until the vehicle is heard{told}"
    if entry.cancel:
        return f"taken back; whether in time is unknown until the vehicle is heard{told}"
    if entry.heard is None:
        return "sent; whether it is executed is unknown until the vehicle is heard"
    return f"{entry.heard.state.words}{told}"
