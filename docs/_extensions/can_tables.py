"""The messages of the CAN bus and their signals as tables, both from `stommel.messages.database`."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from stommel.messages.database import database, guard_of

if TYPE_CHECKING:
    from cantools.database.can import Message, Signal


def can_tables() -> Iterator[str]:
    """Lines of the tables, in Markdown: all messages, then the signals of each."""
    messages = sorted(database().messages, key=lambda message: message.frame_id)
    yield "## Messages\n\n| identifier | message | from | to | every | guarded by | what it says |\n|---|---|---|---|---|---|---|\n"
    for message in messages:
        yield (
            f"| 0x{message.frame_id:03X} | [{message.name}](#can-{message.name.lower()}) | {', '.join(message.senders)} | "
            f"{', '.join(sorted(message.receivers))} | {_cycle(message)} | {_guards(message)} | {message.comment} |\n"
        )
    yield "\n## Signals\n"
    for message in messages:
        yield f"\n(can-{message.name.lower()})=\n### {message.name}, 0x{message.frame_id:03X}\n\n{message.comment}\n\n"
        yield "| signal | bits | unit | step | allowed | meaning |\n|---|---|---|---|---|---|\n"
        for signal in sorted(message.signals, key=lambda signal: signal.start):
            yield _row(signal)


def _cycle(message: "Message") -> str:
    return f"{message.cycle_time / 1000:g} s" if message.cycle_time else "as it happens"


def _guards(message: "Message") -> str:
    guard = guard_of(message.frame_id)
    return ", ".join(["counter"] * guard.counted + ["checksum"] * guard.checked)


def _row(signal: "Signal") -> str:
    bits = f"{signal.start} to {signal.start + signal.length - 1}" if signal.length > 1 else f"{signal.start}"
    step = "" if signal.choices else f"{signal.scale:g}"
    return f"| `{signal.name}` | {bits} | {signal.unit or ''} | {step} | {_allowed(signal)} | {signal.comment} |\n"


def _allowed(signal: "Signal") -> str:
    if signal.choices:
        return ", ".join(f"{number} {word}" for number, word in sorted(signal.choices.items()))
    return f"{signal.minimum:.10g} to {signal.maximum:.10g}"
