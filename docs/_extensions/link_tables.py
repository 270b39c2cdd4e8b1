"""The messages that gliders add to MAVLink 2, and their enumerations, as tables, both from `glider.xml`."""

from collections.abc import Iterator
from typing import Any

from pymavlink.generator.mavparse import MAVXML

from stommel.messages.mavlink import DIALECT


def link_tables() -> Iterator[str]:
    """Lines of the tables, in Markdown: all messages, the fields of each, and the enumerations."""
    dialect = MAVXML(str(DIALECT), "2.0")
    yield "## Messages of gliders\n\n| number | message | bytes | what it says |\n|---|---|---|---|\n"
    for message in dialect.message:
        name = message.name
        yield f"| {message.id} | [{name}](#link-{name.lower()}) | {message.wire_length} | {_line(message.description)} |\n"
    yield "\n## Fields\n"
    for message in dialect.message:
        yield f"\n(link-{message.name.lower()})=\n### {message.name}, {message.id}\n\n{_line(message.description)}\n\n"
        yield "| field | type | unit | meaning |\n|---|---|---|---|\n"
        for field in message.fields:
            yield _row(field)
    yield "\n## Enumerations\n"
    for enum in dialect.enum:
        yield f"\n(link-{enum.name.lower()})=\n### {enum.name}\n\n{_line(enum.description)}\n\n"
        yield "| value | name | meaning |\n|---|---|---|\n"
        for entry in enum.entry:
            if not entry.end_marker:
                yield f"| {entry.value} | `{entry.name}` | {_line(entry.description)} |\n"


def _row(field: Any) -> str:
    kind = f"`{field.type}`" + (f" x {field.array_length}" if field.array_length else "")
    own = field.enum and not field.enum.startswith("MAV_")
    meaning = _line(field.description) + (f" See [{field.enum}](#link-{field.enum.lower()})." if own else "")
    return f"| `{field.name}` | {kind} | {field.units.strip('[]')} | {meaning} |\n"


def _line(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")
