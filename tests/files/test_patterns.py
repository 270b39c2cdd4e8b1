"""No regular expression is shown to people. Oracle: every `pattern` that the sources give to a text."""

import ast
import importlib
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated

import pytest
from pydantic import Field, TypeAdapter, ValidationError

import stommel
from stommel.files.sentences import value_sentence

SOURCES = Path(stommel.__file__).parent
SIGNS = re.compile(r"[\\^$\[\]{}|*+?]")


def patterns() -> Iterator[tuple[str, str]]:
    """Every pattern of a field, with its file."""
    for path in sorted(SOURCES.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.keyword) and node.arg == "pattern":
                if isinstance(node.value, ast.Constant):
                    yield path.name, str(node.value.value)
                else:
                    name = ".".join(("stommel", *path.relative_to(SOURCES).with_suffix("").parts))
                    yield path.name, str(vars(importlib.import_module(name))[ast.unparse(node.value)])


FOUND = sorted(set(patterns()))


def words(pattern: str) -> str:
    """What is said of a text that does not match."""
    with pytest.raises(ValidationError) as error:
        TypeAdapter(Annotated[str, Field(pattern=pattern)]).validate_python("\x01" if "x00" in pattern else " ")
    return value_sentence(error.value.errors()[0]).partition(": ")[2]


def test_there_are_patterns() -> None:
    assert len(FOUND) > 10


@pytest.mark.parametrize(("file", "pattern"), FOUND)
def test_what_a_pattern_means_is_said_in_words(file: str, pattern: str) -> None:
    told = words(pattern)
    assert told.startswith("must ")
    assert not SIGNS.search(told)


def test_a_pattern_that_nobody_has_described_is_not_shown_either() -> None:
    assert not SIGNS.search(words("^[q-z]{3}$"))
