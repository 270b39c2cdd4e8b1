"""The page of the log tells what a log says of itself. Oracle: the header of a file, as it is read back."""

import importlib
import re
import sys
from pathlib import Path

import pytest

from stommel.messages.log.layout import HEAD, MAGIC, SERIES, SYNC, TAIL
from stommel.messages.log.reader import read_log
from stommel.onboard.coordination.logbook.framing import LogIdentity, header

ROOT = Path(__file__).parents[2]
GUIDE = (ROOT / "docs/guide/vehicle-log.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def page() -> str:
    sys.path.insert(0, str(ROOT / "docs" / "_extensions"))
    try:
        return "".join(importlib.import_module("log_tables").log_tables())
    finally:
        sys.path.pop(0)


def test_every_field_of_every_kind_is_on_the_page(page: str) -> None:
    fields = 0
    for series, name in enumerate(SERIES):
        for number, kind in read_log(header(LogIdentity("0", 1), 0, series, 0)).kinds.items():
            assert f"| {number} | {kind.name} | {name} | {kind.meaning} |" in page
            section = page.split(f"\n### {kind.name}\n")[1].split("\n### ", maxsplit=1)[0]
            for field in kind.fields:
                fields += 1
                assert f"| `{field['name']}` | `{field['format']}` | {field.get('unit', '')} | " in section
                assert all(f"{i} {word}" in section for i, word in enumerate(field.get("words", ())))
    assert fields == len(re.findall(r"^\| `", page, re.M)) > 60


def test_the_format_on_the_page_is_that_of_the_bytes() -> None:
    sizes = [int(size) for size in re.findall(r"^\| (\d) \| ", GUIDE.split("## Format")[1], re.M)]
    assert sizes == [len(SYNC), 1, 2, 4, TAIL.size]
    assert sum(sizes[:4]) == HEAD.size
    assert f"the {len(MAGIC)} bytes" in GUIDE
    assert f"`{SYNC.hex(' ')}`" in GUIDE
    told = read_log(header(LogIdentity("0", 1), 0, 0, 0)).header
    assert all(f"`{key}`" in GUIDE for key in told)


def test_the_guide_includes_the_tables() -> None:
    assert "```{include} ../_generated/log-records.md" in GUIDE
    written = (ROOT / "docs/_extensions/generated_pages.py").read_text(encoding="utf-8")
    assert '"log-records.md", "".join(log_tables.log_tables())' in written
