"""The page of commands names every verb of the program, and no other."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from typer.main import get_command

from stommel.cli.app import app

PAGE = Path(__file__).parents[2] / "docs" / "guide" / "commands.md"


def verbs(group: Any, before: str = "") -> Iterator[str]:
    """Every verb with all its words."""
    for name, command in group.commands.items():
        if hasattr(command, "commands"):
            yield from verbs(command, f"{before}{name} ")
        else:
            yield f"{before}{name}"


def test_every_verb_of_the_program_is_on_the_page() -> None:
    text = PAGE.read_text(encoding="utf-8")
    program: Any = get_command(app)
    known = set(verbs(program))
    assert len(known) > 30
    assert [verb for verb in known if not re.search(rf"(?:^|[`(])stommel {verb}\b", text, re.M)] == []
    first = set(re.findall(r"(?:^|[`(])stommel ([a-z][a-z-]*)", text, re.M))
    assert first == set(program.commands)
