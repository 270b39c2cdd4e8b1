"""Plans as files: JSON as the page saves it, or TOML."""

import json
from pathlib import Path
from typing import Any

from stommel.errors import FileError, Problem
from stommel.files.opening import TOML_MIB, read_text
from stommel.files.sentences import validated
from stommel.files.toml_reader import parse_toml
from stommel.plans.plan import StationPlan


def read_plan(path: str | Path) -> StationPlan:
    """Read a plan from a file, JSON unless its name ends with .toml.

    Raises
    ------
    FileError
        The file cannot be read, or one problem for each wrong key, with what is allowed.
    """
    text, origin = read_text(path, TOML_MIB), str(path)
    document = parse_toml(text, origin) if origin.lower().endswith(".toml") else _parsed(text, origin)
    return validated(document, StationPlan, origin)


def plan_text(document: dict[str, Any]) -> str:
    """A plan as the text of its file."""
    return json.dumps(document, indent=2, allow_nan=False, ensure_ascii=False) + "\n"


def _parsed(text: str, origin: str) -> Any:
    try:
        return json.loads(text, parse_constant=_refused)
    except RecursionError:
        raise FileError([Problem(origin, "", "is nested too deeply")]) from None
    except ValueError as error:
        raise FileError([Problem(origin, "", f"is not valid JSON: {error}")]) from None


def _refused(word: str) -> float:
    raise ValueError(f"{word} is no number of JSON")
