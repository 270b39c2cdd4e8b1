"""The page of faults. Oracle: the table of faults, the flags that its text names, and its example, read as files."""

import importlib
import re
import sys
import tomllib
from pathlib import Path

import pytest

from stommel.sitl.faults.fault import faults_from
from stommel.sitl.faults.table import KINDS, SENSORS

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs/guide/faults.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def tables() -> list[str]:
    sys.path.insert(0, str(ROOT / "docs" / "_extensions"))
    try:
        return "".join(importlib.import_module("fault_tables").fault_tables()).splitlines()
    finally:
        sys.path.pop(0)


def test_every_kind_and_sensor_has_a_row(tables: list[str]) -> None:
    for row in KINDS:
        (line,) = (line for line in tables if line.startswith(f"| `{row.name}` |"))
        assert line.endswith(f"| {row.words} |")
        assert all(f"`{target}`" in line for target in row.targets)
    for name in SENSORS:
        assert sum(line.startswith(f"| `{name}` |") for line in tables) == 1


def test_rows_have_as_many_cells_as_their_heading(tables: list[str]) -> None:
    cells = 0
    for line in tables:
        if line.startswith("|---"):
            cells = line.count("|")
        elif line and cells and not line.startswith(("| kind |", "| sensor |")):
            assert line.count("|") == cells


def test_the_examples_are_scenarios() -> None:
    examples = re.findall(r"```toml\n(.*?)```", PAGE, re.S)
    assert len(examples) == 2
    for text in examples:
        assert faults_from(tomllib.loads(text)["faults"], "page")
