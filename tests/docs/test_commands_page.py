"""The page of commands names every verb of the program, and no other."""

import re
from pathlib import Path

from typer.main import get_command

from stommel.cli.app import app

PAGE = Path(__file__).parents[2] / "docs" / "guide" / "commands.md"


def test_every_verb_of_the_program_is_on_the_page() -> None:
    written = re.findall(r"(?:^|[`(])stommel ([a-z][a-z-]*)", PAGE.read_text(encoding="utf-8"), re.M)
    verbs = set(getattr(get_command(app), "commands"))  # noqa: B009 - a group, which its type does not say
    assert len(verbs) > 15
    assert set(written) == verbs
