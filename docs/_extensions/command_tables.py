"""Commands by radio as tables, from `stommel.link.commands`."""

from collections.abc import Iterator

from stommel.link.commands.states import MEANINGS, WHEN_WORDS
from stommel.link.commands.table import COMMANDS


def command_table() -> Iterator[str]:
    """Lines of the table of commands, in Markdown."""
    yield "| number | command | what the vehicle does | parameters | asked before, because |\n|---|---|---|---|---|\n"
    for row in COMMANDS:
        parameters = "; ".join(f"`{p.name}`: {p.words}, {p.allowed}" for p in row.parameters) or "-"
        yield f"| {row.number} | `{row.name}` | {row.words} | {parameters} | {row.confirm or '-'} |\n"


def time_table() -> Iterator[str]:
    """Lines of the table of when a command may be executed, in Markdown."""
    yield "| number | when | executed |\n|---|---|---|\n"
    for when, words in WHEN_WORDS.items():
        yield f"| {int(when)} | `{when.name}` | {words} |\n"


def state_table() -> Iterator[str]:
    """Lines of the table of what can become of a command, in Markdown."""
    yield "| number | state | words | meaning | last word | not executed for sure |\n|---|---|---|---|---|---|\n"
    for state, meaning in MEANINGS.items():
        marks = ("yes" if mark else "-" for mark in (state.is_last, state.is_not_executed))
        yield f"| {int(state)} | `{state.name}` | {state.words} | {meaning} | {' | '.join(marks)} |\n"
