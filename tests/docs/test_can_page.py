"""The tables of the CAN page are the database. Oracle: the lines of `glider.dbc`, read here as text."""

import importlib
import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
DBC = (ROOT / "src/stommel/messages/glider.dbc").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def page() -> str:
    sys.path.insert(0, str(ROOT / "docs" / "_extensions"))
    try:
        return "".join(importlib.import_module("can_tables").can_tables())
    finally:
        sys.path.pop(0)


def test_every_message_and_signal_is_on_the_page(page: str) -> None:
    messages = re.findall(r"^BO_ (\d+) (\w+): 8 (\w+)$", DBC, re.M)
    assert len(messages) > 20
    for identifier, name, sender in messages:
        comment = re.search(rf'CM_ BO_ {identifier} "([^"]*)"', DBC)
        assert comment is not None
        begin = f"| 0x{int(identifier):03X} | [{name}](#can-{name.lower()}) | {sender} | "
        rows = [line for line in page.splitlines() if line.startswith(begin)]
        assert len(rows) == 1
        assert rows[0].endswith(f"| {comment[1]} |")
        assert f"\n(can-{name.lower()})=\n### {name}, 0x{int(identifier):03X}\n" in page
    signals = re.findall(r'^ SG_ (\w+) : (\d+)\|(\d+)@1[+-] \(([^,]+),[^)]*\) \[[^]]*\] "(\w*|S/m)"', DBC, re.M)
    rows = [line.split(" | ") for line in page.splitlines() if line.startswith("| `")]
    assert len(rows) == len(signals) == DBC.count("\n SG_ ")
    told = sorted((row[0].strip("|` "), row[1], row[2].strip()) for row in rows)
    expected = [
        (name, start if length == "1" else f"{start} to {int(start) + int(length) - 1}", unit)
        for name, start, length, _, unit in signals
    ]
    assert told == sorted(expected)


def test_every_word_of_an_enumeration_is_on_the_page(page: str) -> None:
    enumerations = re.findall(r'^VAL_ \d+ \w+ ((?:\d+ "\w+" )+);$', DBC, re.M)
    assert len(enumerations) > 20
    for enumeration in enumerations:
        words = sorted((int(number), word) for number, word in re.findall(r'(\d+) "(\w+)"', enumeration))
        assert f"| {', '.join(f'{number} {word}' for number, word in words)} |" in page


def test_the_guide_includes_the_tables() -> None:
    assert "```{include} ../_generated/can-messages.md" in (ROOT / "docs/guide/can-bus.md").read_text(encoding="utf-8")
    written = (ROOT / "docs/_extensions/generated_pages.py").read_text(encoding="utf-8")
    assert '"can-messages.md", "".join(can_tables.can_tables())' in written
