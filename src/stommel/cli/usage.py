"""Sentences of usage errors: the option, its value, and what is allowed; in the words that files get."""

from collections.abc import Callable
from typing import Any

import typer


def usage_message(error: Exception) -> str:
    """Return the sentence of a usage error, with the option it is about."""
    problems: Callable[..., list[Any]] | None = getattr(error.__cause__, "errors", None)
    if isinstance(error, typer.BadParameter) and problems is not None:
        from stommel.files.sentences import value_sentence

        return f"{_option(error)} = {value_sentence(problems(include_url=False)[0])}"
    write: Callable[[], str] | None = getattr(error, "format_message", None)
    return write() if write is not None else str(error)


def _option(error: typer.BadParameter) -> str:
    """The option as users write it, without quotes."""
    hint = error.param.get_error_hint() if error.param is not None else error.param_hint or "value"
    return hint.strip("'") if isinstance(hint, str) else str(hint[0])
