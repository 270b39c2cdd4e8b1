"""Pages that follow the code: the tables of vehicle and mission files, and one page of reference a package.

They are written to docs/_generated before Sphinx reads its sources, so that they cannot disagree with the code.
"""

import ast
import inspect
import os
import pkgutil
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from functools import cache
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any, Literal, get_args, get_origin

import can_tables
import command_tables
import dive_cycle
import fault_tables
import link_tables
import log_tables
import node_tables
import vehicle_software
from docutils import nodes
from pydantic import BaseModel, BeforeValidator
from sphinx.application import Sphinx
from sphinx.util import logging
from sphinx.util.inspect import signature as sphinx_signature
from sphinx.util.inspect import stringify_signature

import stommel
from stommel.files.docstrings import attribute_docstrings
from stommel.files.sentences import allowed_range
from stommel.files.table_keys import models_in
from stommel.files.units import unit_of
from stommel.onboard.coordination.compass.calibration_file import CalibrationFile
from stommel.onboard.coordination.config.configuration_file import ConfigurationFile
from stommel.onboard.nodes.acquisition_settings import AcquisitionSettings
from stommel.onboard.nodes.motion_settings import MotionSettings
from stommel.simulation.scenario.scenario_file import ScenarioFile
from stommel.vehicle.schema import VehicleFile

logger = logging.getLogger(__name__)


def tables(model: type[BaseModel], prefix: str = "") -> Iterator[tuple[str, str, type[BaseModel]]]:
    """Yield (dotted name, heading as in TOML, model) of every table of a file, the head of the file first."""
    many = prefix.endswith("[]")
    name = prefix.removesuffix("[]")
    yield name, f"[[{name}]]" if many else f"[{name}]" if name else "Head of the file", model
    for key, field in model.model_fields.items():
        for inner in models_in(field.annotation):
            repeated = any(get_origin(a) is tuple for a in (field.annotation, *get_args(field.annotation)))
            yield from tables(inner, f"{name}.{key}".lstrip(".") + ("[]" if repeated else ""))


def _choices(annotation: Any) -> list[str | int]:
    if get_origin(annotation) is Literal:
        return [choice for choice in get_args(annotation) if isinstance(choice, str | int)]
    return [choice for argument in get_args(annotation) for choice in _choices(argument)]


def _kind(field: Any) -> str:
    """What a value looks like, where it is not one number."""
    annotation = field.annotation
    text = str(annotation).replace("strict", "")
    diagonal = any(isinstance(extra, BeforeValidator) for extra in field.metadata)
    if choices := _choices(annotation):
        words = " or ".join(f"`{choice!r}`".replace("'", '"') for choice in choices)
        return f"list of {words}" if get_origin(annotation) is tuple else words
    shapes = (
        ("datetime" in text, "date and time with a time zone"),
        ("dict[str, str]" in text, "table of text"),
        ("dict" in text, "table of numbers"),
        (text.count("tuple") >= 3, "three rows" + ", or `[xx, yy, zz]` for a diagonal" * diagonal),
        ("str | tuple[str" in text, "text, or list of text"),
        ("tuple[str" in text, "list of text"),
        ("bool" in text, "`true` or `false`"),
        ("str" in text, "text"),
    )
    for holds, words in shapes:
        if holds:
            return words
    numbers = next((a for a in (annotation, *get_args(annotation)) if get_origin(a) is tuple), None)
    if numbers is None:
        return ""
    if get_args(numbers)[-1] is Ellipsis:
        return "list of numbers"
    return {2: "[low, high]", 3: "[x, y, z]", 4: "four numbers"}[len(get_args(numbers))]


def _default(field: Any) -> str:
    if field.is_required():
        return "required"
    default = field.get_default(call_default_factory=True)
    if default is None:
        return "not given"
    if default in ((), "", {}):
        return "empty"
    if isinstance(default, tuple):
        if all(isinstance(item, str) for item in default):
            return "all" if default == tuple(_choices(field.annotation)) else ", ".join(default)
        rows = default if isinstance(default[0], tuple) else (default,)
        return "unit matrix" if any(any(row) for row in rows) else "zero"
    if isinstance(default, bool):
        return f"`{default}`".lower()
    return (
        f"`{default:g}`"
        if isinstance(default, float) and not default.is_integer()
        else f"`{default!r}`".replace("'", '"')
    )


def file_tables(model: type[BaseModel], meanings: dict[str, str], what: str) -> Iterator[str]:
    """Yield the lines of a page: a table of keys for each table of a file; `what` it is, for messages."""
    unused = set(meanings)
    for name, heading, table in tables(model):
        yield f"\n## {heading if not name else f'`{heading}`'}\n\n{inspect.getdoc(table)}\n\n"
        keys = [key for key, field in table.model_fields.items() if not models_in(field.annotation)]
        yield "| key | unit | meaning | allowed | if left out |\n|---|---|---|---|---|\n"
        written = attribute_docstrings(table)
        for key in keys:
            field = table.model_fields[key]
            dotted = f"{name}.{key}".lstrip(".")
            meaning = written.get(key) or meanings.get(dotted)
            unused.discard(dotted)
            if meaning is None:
                logger.warning("docs/guide/meanings.toml says nothing about the key %s of a %s", dotted, what)
            allowed = [_kind(field), allowed_range((key,), table)]
            words = ", ".join(word for word in allowed if word) or "any number"
            unit = (unit_of(key) or "").replace("2", "²").replace("3", "³")
            yield f"| `{key}` | {unit} | {meaning} | {words} | {_default(field)} |\n"
    for dotted in sorted(unused):
        logger.warning("docs/guide/meanings.toml describes %s, which no %s has", dotted, what)


def _summary(thing: Any) -> str:
    """First paragraph of a docstring, on one line; nothing for a constant, whose docstring is that of its type."""
    text = inspect.getdoc(thing) if inspect.ismodule(thing) or hasattr(thing, "__qualname__") else ""
    return " ".join((text or "").split("\n\n")[0].split()).replace("|", "\\|")


@cache
def _homes(package: ModuleType) -> dict[str, str]:
    """Where each name that a package passes on is described: module and name; the package's own names are left out."""
    tree = ast.parse(inspect.getsource(package))
    imports = [node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.module]
    named = {alias.name: f"{node.module}.{alias.name}" for node in imports for alias in node.names}
    homes = {}
    for name in getattr(package, "__all__", ()):
        thing = getattr(package, name)
        is_constant = not hasattr(thing, "__qualname__")
        home = named.get(name, "") if is_constant else f"{thing.__module__}.{thing.__qualname__}"
        if home.startswith("stommel.") and home != f"{package.__name__}.{name}":
            homes[name] = home
    return homes


def reference_page(package: str) -> str:
    """One page: the package's own docstring, what it passes on, its packages by links and its modules in full.

    Sphinx's recursive autosummary cannot write it: for a name that is both a module and a function that its package
    passes on, as `stommel.analysis.trim`, it describes the function only.
    """
    module = import_module(package)
    homes = _homes(module)
    page = [package, "=" * len(package), "", f".. automodule:: {package}", "   :ignore-module-all:", ""]
    if package == "stommel":
        page += ["The names of the front door stand on the page :doc:`/reference`.", ""]
    elif homes:
        page += [".. rubric:: Names that the package passes on", ""]
        page += [f":py:obj:`{name} <{home}>`\n   {_summary(getattr(module, name))}\n" for name, home in homes.items()]
    inner = sorted(pkgutil.iter_modules(module.__path__, f"{package}."), key=lambda info: not info.ispkg)
    if packages := [info.name for info in inner if info.ispkg]:
        page += [".. rubric:: Packages inside", ""]
        page += [f":doc:`{name}`\n   {_summary(import_module(name))}\n" for name in packages]
        page += [".. toctree::", "   :hidden:", "", *[f"   {name}" for name in packages], ""]
    for name in [info.name for info in inner if not info.ispkg]:
        page += [name, "-" * len(name), "", f".. automodule:: {name}", ""]
    return "\n".join(page)


def validation_report() -> str:
    """Measure the validation report, in a process where the equations are compiled."""
    program = Path(__file__).with_name("write_validation.py")
    environment = {name: value for name, value in os.environ.items() if name != "NUMBA_DISABLE_JIT"}
    done = subprocess.run([sys.executable, program], env=environment, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        logger.warning("the validation report could not be measured: %s", done.stderr)
    return done.stdout


def _write(path: Path, text: str) -> None:
    """Write only what changed, so that Sphinx need not read it again."""
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def write_pages(app: Sphinx) -> None:
    """Write all generated pages."""
    folder = Path(app.srcdir) / "_generated"
    meanings = tomllib.loads((Path(app.srcdir) / "guide" / "meanings.toml").read_text(encoding="utf-8"))
    _write(folder / "vehicle-file.md", "".join(file_tables(VehicleFile, meanings["meaning"], "vehicle file")))
    _write(folder / "mission-file.md", "".join(file_tables(ScenarioFile, meanings["mission"], "mission file")))
    _write(
        folder / "vehicle-configuration.md",
        "".join(file_tables(ConfigurationFile, meanings["configuration"], "vehicle configuration")),
    )
    _write(
        folder / "compass-calibration.md",
        "".join(file_tables(CalibrationFile, meanings["calibration"], "compass calibration")),
    )
    _write(folder / "validation.md", validation_report())
    _write(folder / "can-messages.md", "".join(can_tables.can_tables()))
    _write(folder / "link-messages.md", "".join(link_tables.link_tables()))
    _write(folder / "log-records.md", "".join(log_tables.log_tables()))
    _write(folder / "faults.md", "".join(fault_tables.fault_tables()))
    _write(folder / "link-commands.md", "".join(command_tables.command_table()))
    _write(folder / "link-command-times.md", "".join(command_tables.time_table()))
    _write(folder / "link-command-states.md", "".join(command_tables.state_table()))
    _write(folder / "dive-cycle.md", "".join(dive_cycle.transition_table()))
    _write(folder / "dive-cycle.svg", dive_cycle.diagram())
    _write(folder / "executive.md", "".join(vehicle_software.executive_table()))
    _write(folder / "executive.svg", vehicle_software.executive_diagram())
    _write(folder / "failsafes.md", "".join(vehicle_software.failsafe_table()))
    _write(folder / "start-checks.md", "".join(vehicle_software.start_check_table()))
    _write(folder / "conditions.md", "".join(vehicle_software.condition_table()))
    _write(folder / "node-states.md", "".join(node_tables.transition_table()))
    _write(folder / "node-states.svg", node_tables.diagram())
    _write(folder / "motion-parameters.md", "".join(node_tables.parameter_table(MotionSettings())))
    _write(folder / "acquisition-parameters.md", "".join(node_tables.parameter_table(AcquisitionSettings())))
    reference = folder / "reference"
    walked = pkgutil.walk_packages(stommel.__path__, "stommel.")
    packages = ["stommel", *(info.name for info in walked if info.ispkg)]
    for package in packages:
        _write(reference / f"{package}.rst", reference_page(package))
    for stale in set(reference.glob("*.rst")) - {reference / f"{package}.rst" for package in packages}:
        stale.unlink()


_COLON = "\ue000"


def _keep_bars(_app: Sphinx, what: str, _name: str, _object: Any, _options: Any, lines: list[str]) -> None:
    """In a docstring |x| is a magnitude, not a substitution, and an attribute's colon does not follow a type."""
    lines[:] = [line.replace("|", "\\|") for line in lines]
    if what in ("attribute", "data", "property"):
        lines[:] = [line.replace(":", _COLON) for line in lines]


def _show_colons(_app: Sphinx, _what: str, _name: str, _object: Any, _options: Any, lines: list[str]) -> None:
    """Undo the hiding of colons from napoleon."""
    lines[:] = [line.replace(_COLON, ":") for line in lines]


def _type_front_door(
    _app: Sphinx, what: str, name: str, thing: Any, _options: Any, signature: str | None, returns: str | None
) -> tuple[str | None, str | None]:
    """Show types at the front door; inside, docstrings tell units and shapes better than the types of arrays do."""
    if what != "function" or name.removeprefix("stommel.") not in stommel.__all__:
        return signature, returns
    text = stringify_signature(sphinx_signature(thing), unqualified_typehints=True)
    signature, _, returns = text.partition(" -> ")
    return signature, returns


_PAGE_NAMED = re.compile(r"\bdocs/((?:theory|guide|decisions)/[\w-]*\w)")
_RAISES = re.compile(r"\b(StommelError|UnreachableFlightError)\b")


def _link_to_page(found: re.Match[str]) -> str:
    """Turn docs/theory/engine, or the number of a decision, into a link; a page that is not there is a warning."""
    decisions = (Path(__file__).parents[1] / "decisions").glob(f"{found[1].removeprefix('decisions/')}-*.md")
    return f":doc:`/{next((f'decisions/{page.stem}' for page in decisions), found[1])}`"


def _link(_app: Sphinx, _what: str, _name: str, _object: Any, _options: Any, lines: list[str]) -> None:
    """Link pages, and errors of the front door to their modules: they are described at both places."""
    homes = _homes(stommel)
    for number, line in enumerate(lines):
        linked = _PAGE_NAMED.sub(_link_to_page, line)
        if linked.startswith(":raises "):
            linked = _RAISES.sub(lambda found: f"~{homes[found[1]]}", linked)
        lines[number] = linked


def _set_dashes(_app: Sphinx, doctree: nodes.document) -> None:
    """Set the dash between a parameter and its meaning, which Sphinx leaves to smart quotes."""
    for dash in [text for text in doctree.findall(nodes.Text) if text == " -- "]:
        dash.parent.replace(dash, nodes.Text(" – "))


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the generator."""
    app.connect("builder-inited", write_pages)
    app.connect("autodoc-process-docstring", _keep_bars, priority=400)  # napoleon has 500
    app.connect("autodoc-process-docstring", _show_colons, priority=600)
    app.connect("autodoc-process-docstring", _link, priority=600)
    app.connect("autodoc-process-signature", _type_front_door)
    app.connect("doctree-read", _set_dashes)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
