"""The page of commands by radio. Oracle: the dialect `glider.xml`, read here as a file."""

import importlib
import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs/guide/link-commands.md").read_text(encoding="utf-8")
DIALECT = ElementTree.parse(ROOT / "src/stommel/messages/glider.xml")


def entries(name: str) -> list[tuple[str, str]]:
    """Number and word of each entry of an enumeration."""
    found = DIALECT.findall(f".//enum[@name='{name}']/entry")
    return [(entry.attrib["value"], entry.attrib["name"].removeprefix(f"{name}_")) for entry in found]


@pytest.mark.parametrize(
    ("function", "enumeration"),
    [
        ("command_table", "GLIDER_CMD"),
        ("time_table", "GLIDER_COMMAND_WHEN"),
        ("state_table", "GLIDER_COMMAND_STATE"),
    ],
)
def test_every_entry_has_a_row(function: str, enumeration: str) -> None:
    sys.path.insert(0, str(ROOT / "docs" / "_extensions"))
    try:
        lines = list(getattr(importlib.import_module("command_tables"), function)())
    finally:
        sys.path.pop(0)
    rows = [tuple(cell.strip(" `") for cell in line.split("|")[1:3]) for line in lines[1:]]
    assert [(number, word.replace("-", "_").upper()) for number, word in rows] == entries(enumeration)
    assert len({line.count("|") for line in "".join(lines).splitlines()}) == 1


def test_messages_of_the_page_are_those_of_the_dialect() -> None:
    messages = {message.attrib["name"] for message in DIALECT.findall(".//message")}
    named = set(re.findall(r"`(GLIDER_COMMAND\w*)`", PAGE))
    assert named == {message for message in messages if message.startswith("GLIDER_COMMAND")}


def test_numbers_of_the_page_are_those_of_the_code() -> None:
    from stommel.link.commands import ledger, standard, states

    assert f"remembers {ledger.MOST} commands" in PAGE
    assert f"keeps {ledger.FOR_ABORTS} places" in PAGE
    assert f"At most {states.MOST_AHEAD // 86_400_000} days" in PAGE
    assert f"within {standard.COUNTED_WITHIN:g} s" in PAGE
    assert f"within {standard.SAME_WITHIN:g} s" in PAGE
    own = [int(number) for number, _ in entries("GLIDER_CMD")]
    assert f"| {min(own)} to {max(own)} |" in PAGE
