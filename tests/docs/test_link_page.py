"""The tables of the page on the radio link are the dialect. Oracles: `glider.xml`, read here as text; its program."""

import importlib
import re
import sys
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest

from stommel.link.channel.settings import ChannelSettings
from stommel.link.transports.address import FORMS, read_address

ROOT = Path(__file__).parents[2]
GUIDE = (ROOT / "docs/guide/radio-link.md").read_text(encoding="utf-8")
DIALECT = ElementTree.parse(ROOT / "src/stommel/messages/glider.xml").getroot()


@pytest.fixture(scope="module")
def page() -> str:
    sys.path.insert(0, str(ROOT / "docs" / "_extensions"))
    try:
        return "".join(importlib.import_module("link_tables").link_tables())
    finally:
        sys.path.pop(0)


def test_every_message_and_field_is_on_the_page(page: str) -> None:
    messages = DIALECT.findall("messages/message")
    assert len(messages) >= 8
    rows = [line for line in page.splitlines() if line.startswith("| `")]
    for message in messages:
        name, description = message.attrib["name"], message.findtext("description")
        assert f"| {message.attrib['id']} | [{name}](#link-{name.lower()}) | " in page
        assert f"\n(link-{name.lower()})=\n### {name}, {message.attrib['id']}\n\n{description}\n" in page
        for field in message.findall("field"):
            kind, _, count = field.attrib["type"].partition("[")
            told = f"`{kind}`" + (f" x {count.rstrip(']')}" if count else "")
            begin = f"| `{field.attrib['name']}` | {told} | {field.attrib.get('units', '')} | {field.text}"
            assert any(row.startswith(begin) for row in rows), begin
    entries = len(DIALECT.findall("enums/enum/entry"))
    assert len(re.findall(r"^\| \d+ \| `\w+` \|", page, re.M)) == entries


def test_links_lead_somewhere(page: str) -> None:
    wanted = set(re.findall(r"\]\(#(link-\w+)\)", page))
    assert wanted <= set(re.findall(r"^\((link-\w+)\)=$", page, re.M))


def test_the_guide_includes_the_tables() -> None:
    assert "```{include} ../_generated/link-messages.md" in GUIDE
    written = (ROOT / "docs/_extensions/generated_pages.py").read_text(encoding="utf-8")
    assert '"link-messages.md", "".join(link_tables.link_tables())' in written


def test_every_setting_of_the_channel_is_on_the_page() -> None:
    section = GUIDE[GUIDE.index("## Channel") : GUIDE.index("## Measured")]
    told = set(re.findall(r"`(\w+)`", section))
    assert set(ChannelSettings.__dataclass_fields__) - {"reordering_delay"} <= told


def test_every_kind_of_address_is_on_the_page() -> None:
    section = GUIDE[GUIDE.index("## Ports") : GUIDE.index("## Channel")]
    told = re.findall(r"^\| `([^`]+)` \|", section, re.M)
    assert tuple(told) == FORMS
    for form in told:
        assert read_address(form.replace("HOST", "localhost").replace("PORT", "5760")).kind == form.partition(":")[0]


def test_the_program_of_the_page_does_what_it_says(capsys: pytest.CaptureFixture[str]) -> None:
    program = re.search(r"```python\n(.*?)```", GUIDE, re.S)
    assert program is not None
    found: dict[str, Any] = {}
    exec(program[1], found)
    low, high = map(float, re.findall(r"(?:low|high)=([\d.]+)", capsys.readouterr().out))
    assert low <= 3.0 <= high
    assert 90.0 <= found["talk"].t <= 95.0
