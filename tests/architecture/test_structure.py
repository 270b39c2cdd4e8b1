"""Oracle: the sources themselves. No circle of files, no room that outgrows the house, nothing that needs scrolling."""

import ast
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import grimp
import pytest

import stommel

SOURCES = Path(stommel.__file__).parent
FILES = sorted(SOURCES.rglob("*.py"))

Function = ast.FunctionDef | ast.AsyncFunctionDef


def circle_in(package: str) -> list[str]:
    """One circle of files that import each other, empty if there is none.

    Imports within functions count. Those of type checkers do not: they never run.
    """
    graph = grimp.build_graph(package, exclude_type_checking_imports=True, cache_dir=None)
    try:
        TopologicalSorter({m: graph.find_modules_directly_imported_by(m) for m in graph.modules}).prepare()
    except CycleError as error:
        circle: list[str] = error.args[1]
        return circle
    return []


def lines(path: Path) -> int:
    return len(path.read_text(encoding="utf-8").splitlines())


def functions(path: Path) -> Iterator[Function]:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, Function):
            yield node


def statements(function: Function) -> int:
    """Lines of a function's body, without signature and docstring."""
    body = function.body[1:] if ast.get_docstring(function) else function.body
    return (body[-1].end_lineno or 0) - body[0].lineno + 1 if body else 0


def test_no_circle_of_files() -> None:
    assert not circle_in("stommel")


@pytest.mark.parametrize(
    ("first", "is_circle"),
    [
        ("from ring.second import b", True),
        ("def a():\n    from ring.second import b", True),
        ("from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from ring.second import b", False),
    ],
)
def test_circles_are_found(first: str, is_circle: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    package = tmp_path / "ring"
    package.mkdir()
    (package / "__init__.py").touch()
    (package / "first.py").write_text(first)
    (package / "second.py").write_text("import ring.third")
    (package / "third.py").write_text("import ring.first")
    monkeypatch.syspath_prepend(tmp_path)
    assert ({"ring.first", "ring.second", "ring.third"} <= set(circle_in("ring"))) is is_circle


def test_no_room_is_more_than_15_percent_of_the_house() -> None:
    rooms = {room.name: sum(map(lines, room.rglob("*.py"))) for room in SOURCES.iterdir() if room.is_dir()}
    house = sum(map(lines, FILES))
    assert {room: f"{size / house:.1%}" for room, size in rooms.items() if size > 0.15 * house} == {}


def test_no_file_is_longer_than_400_lines() -> None:
    assert {str(path.relative_to(SOURCES)): lines(path) for path in FILES if lines(path) > 400} == {}


def test_no_function_is_longer_than_60_lines() -> None:
    """Also not the compiled loop of a mission, the longest of all."""
    long = [
        f"{path.relative_to(SOURCES)}: {function.name} has {statements(function)} lines"
        for path in FILES
        for function in functions(path)
        if statements(function) > 60
    ]
    assert long == []


def test_every_package_says_what_it_is() -> None:
    packages = {path.parent for path in FILES}
    silent = [
        folder.relative_to(SOURCES)
        for folder in packages
        if not ast.get_docstring(ast.parse((folder / "__init__.py").read_text(encoding="utf-8")))
    ]
    assert silent == []
