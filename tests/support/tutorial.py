"""The tutorial, followed step by step: its edits made, its commands run, its mission file written."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from tests.support.pages import commands, edited, guide

PAGE = guide("your-own-glider")

Answer = TypeVar("Answer")


def follow(folder: Path, run: Callable[..., Answer]) -> list[tuple[list[str], Answer]]:
    """Do in a folder what the page says; returns each command with what `run` returned for it."""
    answers, vehicle = [], folder / "shelf.toml"
    for language, content in re.findall(r"^```(console|toml|\{code-block\} toml)\n(.*?)^```", PAGE, re.S | re.M):
        if language == "console":
            answers += [(arguments, run(*arguments)) for arguments in commands(content)]
        elif language == "toml":
            vehicle.write_text(edited(vehicle.read_text("utf-8"), content), "utf-8")
        else:
            (folder / "first.toml").write_text(content, "utf-8")
    return answers
