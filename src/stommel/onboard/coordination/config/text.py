"""Text of a configuration: every key with what it means above it, from the tables themselves."""

from textwrap import wrap
from typing import Any

from pydantic import BaseModel

from stommel.files.docstrings import attribute_docstrings
from stommel.onboard.coordination.config.configuration_file import ConfigurationFile

_WIDTH = 100
_HEAD = (
    "What the software of this vehicle is set up with. `stommel vehicle run` reads it; numbers out of range are named."
)


def configuration_text(file: ConfigurationFile) -> str:
    """Text of the file of a configuration, with a comment above every key; keys without a value are comments."""
    import tomlkit  # noqa: PLC0415 - only who writes a configuration needs it

    document = tomlkit.document()
    _comment(document, _HEAD)
    document.add(tomlkit.nl())
    _fill(document, file)
    return tomlkit.dumps(document)


def _fill(container: Any, model: BaseModel) -> None:
    """Write the keys of a table, then the tables in it."""
    import tomlkit  # noqa: PLC0415 - as above

    meanings = attribute_docstrings(type(model))
    tables = []
    for key in type(model).model_fields:
        value = getattr(model, key)
        if isinstance(value, BaseModel):
            tables.append((key, value))
            continue
        if key in meanings:
            _comment(container, meanings[key])
        if value is None:
            container.add(tomlkit.comment(f"{key} ="))
        else:
            container.add(key, _written(value))
    for key, value in tables:
        table = tomlkit.table()
        container.add(tomlkit.nl())
        _comment(table, (type(value).__doc__ or "").split("\n\n")[0])
        table.add(tomlkit.nl())
        _fill(table, value)
        container.add(key, table)


def _written(value: Any) -> Any:
    import tomlkit  # noqa: PLC0415 - as above

    if isinstance(value, dict):
        table = tomlkit.inline_table()
        table.update(value)
        return table
    return list(value) if isinstance(value, tuple) else value


def _comment(container: Any, text: str) -> None:
    import tomlkit  # noqa: PLC0415 - as above

    for line in wrap(" ".join(text.split()), _WIDTH):
        container.add(tomlkit.comment(line))
