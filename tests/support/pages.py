"""Pages of the documentation: their blocks of code, and the commands that they print."""

import re
import shlex
from pathlib import Path

ROOT = Path(__file__).parents[2]
"""The checkout."""

DOCS = ROOT / "docs"


def guide(name: str) -> str:
    """Text of a page of the user guide."""
    return (DOCS / "guide" / f"{name}.md").read_text(encoding="utf-8")


def blocks(text: str, language: str) -> list[str]:
    """Contents of the blocks of code in a language."""
    return re.findall(rf"^```{language}\n(.*?)^```", text, re.DOTALL | re.MULTILINE)


def commands(text: str, verb: str = "") -> list[list[str]]:
    """Arguments of every call of `stommel` that stands on a line of its own, with or without a prompt before it.

    With a verb, only the calls of that verb.
    """
    calls = re.findall(r"^(?:\$ )?stommel (.+)$", text, re.MULTILINE)
    found = [shlex.split(call, comments=True) for call in calls]
    return [arguments for arguments in found if not verb or arguments[0] == verb]
