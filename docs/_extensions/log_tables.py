"""The records of a vehicle's log as tables, from `stommel.onboard.coordination.logbook.records`."""

from collections.abc import Iterator

from stommel.messages.log.layout import SERIES
from stommel.onboard.coordination.logbook.records import KINDS, Field


def log_tables() -> Iterator[str]:
    """Lines of the tables, in Markdown: all kinds of records, then the fields of each."""
    yield "| number | record | series | what it says |\n|---|---|---|---|\n"
    for kind in KINDS:
        yield f"| {kind.number} | {kind.name} | {SERIES[kind.series]} | {kind.meaning} |\n"
    for kind in KINDS:
        yield f"\n### {kind.name}\n\n| field | format | unit | meaning |\n|---|---|---|---|\n"
        for field in kind.fields:
            yield f"| `{field.name}` | `{field.format}` | {field.unit} | {_meaning(field)} |\n"


def _meaning(field: Field) -> str:
    words = ", ".join(f"{number} {word}" for number, word in enumerate(field.words))
    return f"{field.meaning}: {words}" if words else field.meaning
