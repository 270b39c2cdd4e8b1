"""What documentation and docstrings name is there: modules and their names, files, commands, options, keys, JSON."""

import re
import shlex
from collections.abc import Iterator
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any, get_args

import pytest
from pydantic import BaseModel
from typer.main import get_command

from stommel.cli.app import app
from stommel.cli.sitl import FLY
from stommel.control.orders_tables import OrdersFile
from stommel.plans.plan import StationPlan
from stommel.simulation.scenario.scenario_file import ScenarioFile
from stommel.vehicle.schema import VehicleFile
from tests.conftest import Command

ROOT = Path(__file__).parents[2]
PAGES = sorted(path for path in (ROOT / "docs").rglob("*.md") if "_generated" not in path.parts)
PROSE = [*PAGES, ROOT / "README.md", ROOT / "CONTRIBUTING.md"]
CODE = sorted(path for folder in ("src", "tests", "benchmarks", "examples") for path in (ROOT / folder).rglob("*.py"))


def named(pattern: str, files: list[Path]) -> dict[str, str]:
    """Every match of a pattern, with the last file that has it."""
    return {
        match: str(path.relative_to(ROOT)) for path in files for match in re.findall(pattern, path.read_text("utf-8"))
    }


@cache
def module(name: str) -> Any:
    try:
        return import_module(name) if find_spec(name) else None
    except ModuleNotFoundError:  # its parent is no package
        return None


def is_there(dotted: str) -> bool:
    """Whether a module of this name exists, or a name in a module, or a field of a class there."""
    parts = dotted.split(".")
    cut = next(n for n in range(len(parts), 0, -1) if module(".".join(parts[:n])))
    thing = module(".".join(parts[:cut]))
    for name in parts[cut:]:
        if not hasattr(thing, name):
            return name in getattr(thing, "__annotations__", {}) or name in getattr(thing, "model_fields", {})
        thing = getattr(thing, name)
    return True


def test_every_dotted_name_resolves() -> None:
    """In pages, docstrings, comments and imports."""
    names = named(r"(?<![\w./-])(stommel(?:\.[A-Za-z_]\w*)+)", [*PROSE, *CODE])
    assert len(names) > 200
    assert not {name: page for name, page in names.items() if not is_there(name)}


def test_every_file_that_is_named_exists() -> None:
    paths = named(r"(?<![\w/\"])((?:src|docs|tests|benchmarks|examples)/[\w./-]*\w)", [*PROSE, *CODE])
    assert len(paths) > 30
    built = ("docs/index.html",)  # of build/docs
    missing = {
        path: page
        for path, page in paths.items()
        # a page may be named without its ending, a decision by its number
        if path not in built
        and not (ROOT / path).exists()
        and not list((ROOT / path).parent.glob(f"{Path(path).name}[.-]*"))
    }
    assert not missing


def command_lines() -> Iterator[tuple[str, str]]:
    """Every command line of the pages, in blocks and within sentences, with the name of its page."""
    for path in PROSE:
        text = path.read_text("utf-8")
        blocks = re.findall(r"```(?:console|sh)\n(.*?)```", text, re.S)
        lines = [line for block in blocks for line in re.findall(r"^(?:\$ )?(stommel .*)$", block, re.M)]
        lines += re.findall(r"`(stommel [a-z][^`]*)`", text)
        yield from ((path.name, line.split(" #")[0].strip()) for line in lines)


def parse(line: str) -> None:
    """Parse a command line without running it; an unknown verb or option, or a missing argument, raises."""
    program, *arguments = shlex.split(line)
    command: Any = get_command(app)
    sitl = command.commands["sitl"]
    while arguments and hasattr(command, "commands") and not arguments[0].startswith("-"):
        if arguments[0] not in command.commands and command is sitl:
            arguments.insert(0, FLY)  # what is no verb of this group is a scenario to fly
        command = command.commands[arguments.pop(0)]
    if arguments and arguments != ["--help"]:  # a verb alone is named, not called
        command.make_context(program, arguments)


@pytest.mark.parametrize(("page", "line"), sorted(set(command_lines())), ids=lambda text: text)
def test_every_command_line_parses(monkeypatch: pytest.MonkeyPatch, page: str, line: str) -> None:
    if any(
        "STOMMEL_LINK" in path.read_text("utf-8") for path in PROSE if path.name == page
    ):  # stands for --to on pages that say so
        monkeypatch.setenv("STOMMEL_LINK", "tcp:127.0.0.1:5760")
    parse(line.replace("COMMAND", "trim").replace("VEHICLE", "zju"))


@pytest.mark.parametrize(
    "line",
    ["stommel trimm zju", "stommel trim zju --sped 0.4", "stommel table zju --speed", "stommel sitl zju --sped 1"],
)
def test_a_wrong_command_line_does_not(line: str) -> None:
    with pytest.raises(Exception, match=r"trimm|--sped|--speed"):
        parse(line)


def options(command: Any) -> set[str]:
    """Options of a command and of those below it."""
    own = {flag for parameter in command.params for flag in (*parameter.opts, *parameter.secondary_opts)}
    return own.union(*(options(inner) for inner in getattr(command, "commands", {}).values()))


def test_every_option_of_a_sentence_exists() -> None:
    foreign = {"--only"}  # of benchmarks/run.py
    written = set(named(r"`(--[a-z][a-z-]*)", PAGES))
    assert len(written) > 30
    assert written - foreign <= options(get_command(app)) | {"--help"}


def models_in(annotation: Any) -> list[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [model for argument in get_args(annotation) for model in models_in(argument)]


def keys_of(model: type[BaseModel], name: str = "") -> Iterator[str]:
    """Dotted keys of a file and of its tables."""
    for key, field in model.model_fields.items():
        yield f"{name}{key}"
        for inner in models_in(field.annotation):
            yield from keys_of(inner, f"{name}{key}.")


def test_every_dotted_key_of_a_file_exists() -> None:
    keys = {*keys_of(VehicleFile), *keys_of(ScenarioFile), *keys_of(OrdersFile), *keys_of(StationPlan)}
    tables = {key.split(".")[0] for key in keys if "." in key}
    written = named(rf"`\[*((?:{'|'.join(tables)})(?!\.toml)(?:\.[a-z_]\w*)+)", PAGES)
    assert len(written) > 10
    fields = "vehicle."  # of the parameter record, see test_nomenclature
    assert not {key: page for key, page in written.items() if key not in keys and not key.startswith(fields)}


def keys_in(answer: Any) -> set[str]:
    match answer:
        case dict():
            return set(answer).union(*map(keys_in, answer.values()))
        case list():
            return set().union(*map(keys_in, answer))
    return set()


@pytest.mark.parametrize(
    ("page", "question"),
    [
        ("engine", "engine zju --pressure-mpa 2 --inflate-ml 500"),
        ("hull", "hull zju"),
        ("endurance", "endurance zju"),
    ],
)
def test_every_key_of_a_table_of_json_is_answered(page: str, question: str, stommel: Command) -> None:
    found, column = set(), None
    for line in (ROOT / "docs" / "guide" / f"{page}.md").read_text("utf-8").splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")] if line.startswith("|") else []
        if not cells:
            column = None
        elif "JSON" in cells:
            column = cells.index("JSON")
        elif column is not None:
            found |= set(re.findall(r"`([^`]+)`", cells[column]))
    assert len(found) > 5
    assert found <= keys_in(stommel(*question.split(), "--json").json)
