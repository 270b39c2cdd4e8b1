"""The nomenclature and the tables "In the code" of the theory pages name what exists, and all of it."""

import ast
import inspect
import re
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

import pytest

from stommel.dynamics import parameters, state
from stommel.dynamics.parameters import VEHICLE_RECORD
from stommel.dynamics.state import Actuation, State
from stommel.seawater import water
from stommel.seawater.water import Water

THEORY = Path(__file__).parents[2] / "docs" / "theory"


class Row(NamedTuple):
    page: str
    name: str
    module: str
    unit: str | None


def rows_of(page: Path) -> list[Row]:
    """Rows of all tables that have the columns `name in code` and `module`; one row for each name."""
    found, header = [], []
    for line in page.read_text(encoding="utf-8").splitlines():
        if not line.startswith("|"):
            header = []
            continue
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if not header:
            header = cells
        elif {"name in code", "module"} <= set(header) and not set(line) <= set("|-: "):
            cell = dict(zip(header, cells, strict=True))
            names = re.findall(r"`([^`]+)`", cell["name in code"])
            assert names, f"{page.name}: no name in code in {line}"
            found += [Row(page.name, name, cell["module"].strip("`"), cell.get("unit")) for name in names]
    return found


ROWS = [row for page in sorted(THEORY.glob("*.md")) for row in rows_of(page)]
NOMENCLATURE = [row for row in ROWS if row.page == "nomenclature.md"]


@cache
def tree_of(module: str) -> ast.Module:
    spec = find_spec(module)
    assert spec is not None, f"there is no module {module}"
    assert spec.origin is not None, f"{module} has no source"
    return ast.parse(Path(spec.origin).read_text(encoding="utf-8"))


def identifiers(tree: ast.AST) -> set[str]:
    found = set()
    for node in ast.walk(tree):
        match node:
            case ast.FunctionDef(name=name) | ast.ClassDef(name=name) | ast.Name(id=name) | ast.arg(arg=name):
                found.add(name)
    return found


def members(tree: ast.Module, class_name: str) -> set[str]:
    found = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.ClassDef) and node.name == class_name:
            for item in node.body:
                match item:
                    case ast.AnnAssign(target=ast.Name(id=name)) | ast.FunctionDef(name=name):
                        found.add(name)
    return found


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row.page}:{row.name}")
def test_every_row_names_something_in_its_module(row: Row) -> None:
    tree = tree_of(row.module)
    owner, _, name = row.name.rpartition(".")
    if owner == "vehicle":
        assert row.module == parameters.__name__
        assert name in (VEHICLE_RECORD.names or ())
    elif owner:
        assert name in members(tree, owner), f"{row.module} has no class {owner} with {name}"
    else:
        assert name in identifiers(tree), f"{row.module} does not contain {name}"


REQUIRED = {
    **{f"vehicle.{field}": parameters for field in VEHICLE_RECORD.names or ()},
    **{f"{kind.__name__}.{field}": state for kind in (State, Actuation) for field in kind._fields},
    **{f"Water.{field}": water for field in Water._fields},
}


@pytest.mark.parametrize("name", REQUIRED)
def test_every_field_has_one_row_with_its_unit_and_module(name: str) -> None:
    rows = [row for row in NOMENCLATURE if row.name == name]
    assert len(rows) == 1, f"{name} needs exactly one row in docs/theory/nomenclature.md, has {len(rows)}"
    assert rows[0].unit, f"{name} has no unit; a pure number has the unit 1"
    assert rows[0].module == REQUIRED[name].__name__


def stated_units() -> dict[str, str]:
    """Units in brackets in the source: comments of the record's fields, docstrings of the other fields."""
    found = {}
    for field, unit in re.findall(r'\("(\w+)", "f8".*\),?\s+#.*\[([^\]]+)\]', inspect.getsource(parameters)):
        found[f"vehicle.{field}"] = unit
    for kind in (State, Actuation, Water):
        pattern = r'^    (\w+): .*\n    """[^"]*\[([^\]]+)\]'
        for field, unit in re.findall(pattern, inspect.getsource(kind), re.MULTILINE):
            found[f"{kind.__name__}.{field}"] = unit
    return found


def test_units_agree_with_the_source() -> None:
    stated = stated_units()
    assert len(stated) > 30, "the units in the source are no longer found"
    table = {row.name: (row.unit or "").translate(str.maketrans("²³", "23")) for row in NOMENCLATURE}
    assert {name: table[name] for name in stated} == stated
