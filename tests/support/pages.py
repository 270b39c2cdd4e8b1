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


def edited(text: str, block: str) -> str:
    """A vehicle file after the edits of a page's block of TOML.

    `# in [table]` and `# in the part "name"` head keys that are there already, `# at the end` what is added.
    """
    for place, lines in re.findall(r"^# (in [^\n]*|at the end)\n(.*?)(?=\n# |\Z)", block, re.DOTALL | re.MULTILINE):
        if place == "at the end":
            text += f"\n{lines}\n"
            continue
        head = f"name = {found[1]}" if (found := re.search(r'part (".*")', place)) else place.removeprefix("in ")
        for key, value in re.findall(r"^(\w+) = (.*)$", lines, re.MULTILINE):
            pattern = rf"(^{re.escape(head)}.*?^{key} = )[^#\n]*"
            text, changed = re.subn(pattern, lambda m, v=value: m[1] + v, text, count=1, flags=re.DOTALL | re.MULTILINE)
            assert changed == 1, (place, key)
    return text
