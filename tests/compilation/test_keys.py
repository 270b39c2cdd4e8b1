"""The key of machine code: every edit that can change it changes the key, and no other edit does."""

import shutil
from collections.abc import Callable, Iterator
from importlib import import_module
from pathlib import Path
from types import CodeType, FunctionType
from typing import Any

import pytest

import stommel
from stommel.compilation.sources import Sources

ROOT = Path(stommel.__file__).parent

TREE = {
    "__init__.py": "",
    "compilation/__init__.py": "from small.compilation.decorators import compiled, inlined\n",
    "compilation/decorators.py": "def compiled(function): return function\ndef inlined(function): return function\n",
    "compilation/flags.py": "COMPILED = {'error_model': 'numpy'}\n",
    "physics/__init__.py": '"""Names are imported late."""\nfrom typing import TYPE_CHECKING\n'
    "if TYPE_CHECKING:\n    from small.physics.drag import drag\n"
    "def __getattr__(name): return getattr(import_module(f'small.physics.{name}'), name)\n",
    "physics/drag.py": "from small.compilation import inlined\nfrom small.water import Water\n"
    "@inlined\ndef drag(water, v): return water.rho * v\n"
    "@inlined\ndef lift(water, v): return 2 * v\n",
    "water.py": "from typing import NamedTuple\nfrom small.tables import fitted\n"
    "class Water(NamedTuple):\n    rho: float\n    T: float\nDENSITY = fitted()\nUNUSED = 3\n",
    "tables.py": "def fitted():\n    from small.late import SLOPE\n    return SLOPE\n",
    "late.py": "SLOPE = 2.0\n",
    "elementary.py": "import numba\nfrom small.rules import rule\ndef sqrt(x): return x\n"
    "@numba.extending.overload(sqrt)\ndef _sqrt(x): return rule\n",
    "rules.py": "rule = 1\n",
    "loop.py": '"""A loop."""\nfrom typing import TYPE_CHECKING\nfrom small import elementary\n'
    "from small.compilation import compiled\nfrom small.physics import drag\nfrom small.water import DENSITY, Water\n"
    "from small.report import write\nif TYPE_CHECKING:\n    from small.vehicle import Vehicle\n"
    "def fly(vehicle: 'Vehicle'): return write(_fly(1.0))\n"
    "@compiled\ndef _fly(v):\n    return drag(Water(DENSITY, 4.0), elementary.sqrt(v))\n",
    "report.py": "def write(x): return str(x)\n",
    "vehicle.py": "class Vehicle: pass\n",
}


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    """A small package of the house's kind: a compiled loop, what it needs, and what it does not need."""
    root = tmp_path / "small"
    for path, text in TREE.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(text)
    return root


def key(tree: Path, module: str = "small.loop") -> str:
    return Sources(tree).key_of(module)


def edit(tree: Path, path: str, old: str, new: str) -> None:
    text = (tree / path).read_text()
    assert old in text
    (tree / path).write_text(text.replace(old, new, 1))


@pytest.mark.parametrize(
    ("path", "old", "new"),
    [
        ("loop.py", "4.0", "5.0"),
        ("physics/drag.py", "water.rho * v", "water.rho * v * v"),
        ("water.py", "rho: float\n    T: float", "T: float\n    rho: float"),
        ("water.py", "fitted()\n", "fitted() + 1\n"),
        ("tables.py", "return SLOPE", "return -SLOPE"),
        ("late.py", "2.0", "3.0"),
        ("elementary.py", "return rule", "return 2 * rule"),
        ("rules.py", "1", "2"),
        ("compilation/flags.py", "numpy", "python"),
    ],
)
def test_what_machine_code_is_made_of_changes_the_key(tree: Path, path: str, old: str, new: str) -> None:
    before = key(tree)
    edit(tree, path, old, new)
    assert key(tree) != before


@pytest.mark.parametrize(
    ("path", "old", "new"),
    [
        ("report.py", "def write", "# a comment\ndef write"),
        ("report.py", "str(x)", "repr(x)"),
        ("loop.py", "A loop.", "A longer loop,\nin two lines."),
        ("loop.py", "    return drag", "    # why\n    return drag"),
        ("loop.py", "    return drag", '    """Tell."""\n    return drag'),
        ("loop.py", "def _fly(v)", "def _fly(v: float) -> float"),
        ("loop.py", "write(_fly(1.0))", "write(_fly(2.0))"),
        ("physics/drag.py", "2 * v", "3 * v"),
        ("water.py", "UNUSED = 3", "UNUSED = 4"),
        ("vehicle.py", "pass", "mass = 3.0"),
        ("compilation/decorators.py", "return function", "return print(function) or function"),
    ],
)
def test_what_leaves_no_trace_in_machine_code_leaves_the_key(tree: Path, path: str, old: str, new: str) -> None:
    before = key(tree)
    edit(tree, path, old, new)
    assert key(tree) == before


def test_a_package_that_is_added_counts_from_its_first_use(tree: Path) -> None:
    before = key(tree)
    (tree / "waves").mkdir()
    (tree / "waves" / "__init__.py").write_text("HEIGHT = 1.0\n")
    assert key(tree) == before
    edit(
        tree, "loop.py", "from small import elementary", "from small import elementary\nfrom small.waves import HEIGHT"
    )
    edit(tree, "loop.py", "4.0", "HEIGHT")
    used = key(tree)
    assert used != before
    edit(tree, "waves/__init__.py", "1.0", "2.0")
    assert key(tree) != used


@pytest.mark.parametrize(
    "text",
    [
        "from .waves import HEIGHT",
        "from small.waves import *",
        "import small.waves\nHEIGHT = small.waves.HEIGHT",
        "import small.waves as sea\nHEIGHT = sea.HEIGHT",
        "try:\n    from small.waves import HEIGHT\nexcept ImportError:\n    HEIGHT = 0",
    ],
)
def test_every_form_of_import_is_followed(tree: Path, text: str) -> None:
    (tree / "waves.py").write_text("HEIGHT = 1.0\n")
    edit(tree, "loop.py", "from small import elementary", f"from small import elementary\n{text}")
    edit(tree, "loop.py", "4.0", "HEIGHT")
    before = key(tree)
    edit(tree, "waves.py", "1.0", "2.0")
    assert key(tree) != before


@pytest.fixture(scope="module")
def copy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of stommel's own sources."""
    return Path(shutil.copytree(ROOT, tmp_path_factory.mktemp("copy") / "stommel", ignore=lambda *_: {"__pycache__"}))


LOOP = "stommel.simulation.mission_loop"


@pytest.mark.parametrize("package", ["design", "report", "cli", "studies", "figures", "vehicle", "files"])
def test_the_mission_loop_is_not_compiled_anew_after_a_change_of_what_it_does_not_call(
    copy: Path, package: str
) -> None:
    before, edited = key(copy, LOOP), 0
    for path in (copy / package).rglob("*.py"):
        path.write_text(path.read_text() + "\n\nONE_MORE = 1\n\n\ndef one_more() -> int:\n    return ONE_MORE\n")
        edited += 1
    assert edited > 1
    assert key(copy, LOOP) == before


@pytest.mark.parametrize("path", ["dynamics/equations.py", "geometry/vectors.py", "seawater/table.py"])
def test_the_mission_loop_is_compiled_anew_after_a_change_of_its_physics(copy: Path, path: str) -> None:
    before = key(copy, LOOP)
    text = (copy / path).read_text()
    (copy / path).write_text(text.replace("return ", "return 2 * ").replace("2 * None", "None"))
    assert key(copy, LOOP) != before
    (copy / path).write_text(text)
    assert key(copy, LOOP) == before


def test_the_mission_loop_is_compiled_anew_after_a_change_of_what_numba_is_told(copy: Path) -> None:
    before = key(copy, LOOP)
    path = copy / "geometry" / "elementary_compiled.py"
    text = path.read_text()
    edit(copy, "geometry/elementary_compiled.py", "0.5 * x.imag", "0.6 * x.imag")
    assert key(copy, LOOP) != before
    path.write_text(text)


def functions_of(code: CodeType, names: dict[str, Any]) -> Iterator[FunctionType]:
    """Yield the functions that a function's own globals give it, as Python holds them once all is imported."""
    for name in code.co_names:
        value = names.get(name)
        function = getattr(value, "py_func", value)
        if isinstance(function, FunctionType) and function.__module__.startswith("stommel."):
            yield function
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from functions_of(constant, names)


def test_the_functions_that_python_finds_in_the_globals_of_compiled_ones_are_in_their_keys() -> None:
    sources = Sources(ROOT)
    checked = 0
    for name in sources.compiled_modules():
        if name.startswith("stommel.compilation"):
            continue
        module = import_module(name)
        reached = {where for where, _ in sources._reach(name)}
        todo: list[Callable[..., Any]] = [
            value.py_func for value in vars(module).values() if hasattr(value, "py_func") and value.__module__ == name
            and value.py_func.__name__ in sources._module(name).compiled
        ]  # fmt: skip
        seen: set[Any] = set()
        while todo:
            function: Any = todo.pop()
            if function not in seen:
                seen.add(function)
                assert function.__module__ in reached, (name, function)
                todo += functions_of(function.__code__, function.__globals__)
        checked += len(seen)
    assert checked > 300
