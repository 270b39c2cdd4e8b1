"""The guide's commands run, its mission files are accepted, and its Python prints what it should."""

import ast
import inspect
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any, get_args

import pytest
from pydantic import BaseModel

from stommel.mission.loading import load_plan
from stommel.simulation.flight import fly_mission
from stommel.simulation.scenario.loading import load_mission, mission_from
from stommel.simulation.scenario.mission import Mission
from stommel.simulation.scenario.scenario_file import ScenarioFile
from stommel.simulation.scenario.shipped import mission_path
from tests.support.command import Command

DOCS = Path(__file__).parents[2] / "docs"
GUIDE = (DOCS / "guide" / "missions.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{re.escape(language)}\n(.*?)```", GUIDE, re.S)


WHOLE, *ADDITIONS = blocks("toml")


def test_command_writes_what_it_says(stommel: Command, tmp_path: Path) -> None:
    for line in blocks("console")[0].splitlines():
        done = stommel(*line.removeprefix("$ stommel ").split())
        assert done.status == 0, done.err
    assert (tmp_path / "pool.nc").stat().st_size > 0
    assert {path.stem for path in (tmp_path / "pool").glob("*.png")} == {
        "trial", "sawtooth", "map", "energy", "actuators", "ctd",
    }  # fmt: skip


@pytest.fixture
def mission(tmp_path: Path) -> Mission:
    path = tmp_path / "mine.toml"
    path.write_text(WHOLE)
    return load_mission(path)


def test_mission_file_is_accepted(mission: Mission) -> None:
    assert mission.scenario.duration_days == 3.0
    assert mission.ocean.name == "east_china_sea"


def test_python_prints_the_depth() -> None:
    done = subprocess.run([sys.executable, "-c", blocks("python")[0]], capture_output=True, text=True, check=True)
    assert 2.4 < float(done.stdout) < 3.2


@pytest.mark.parametrize("addition", ADDITIONS, ids=lambda text: re.sub(r"\W+", "-", text).strip("-")[:40])
def test_additions_are_accepted(addition: str) -> None:
    document, added = tomllib.loads(WHOLE), tomllib.loads(addition)
    for table, keys in added.items():
        document[table] = document.get(table, {}) | keys
    plan = mission_from(document, "guide", Path()).scenario
    for table, keys in added.items():
        for key, value in keys.items():
            found = getattr(getattr(plan, table), key)
            assert (list(found) if isinstance(value, list) else found) == value


def test_there_is_an_example_of_every_feature() -> None:
    assert {table for text in ADDITIONS for table in tomllib.loads(text)} == {
        "dives", "surface", "sensors", "waves", "leak", "abort", "sampling", "ocean",
    }  # fmt: skip


def test_every_key_of_a_mission_file_has_a_meaning() -> None:
    """The guide's tables are generated from the schema; what has no docstring there needs a line in meanings.toml."""
    meanings = tomllib.loads((DOCS / "guide" / "meanings.toml").read_text(encoding="utf-8"))["mission"]
    undescribed = []
    for name, table in tables_of(ScenarioFile):
        body = ast.parse(inspect.getsource(table)).body[0]
        assert isinstance(body, ast.ClassDef)
        for before, after in zip(body.body, [*body.body[1:], ast.Pass()], strict=True):
            if isinstance(before, ast.AnnAssign) and isinstance(before.target, ast.Name):
                key = before.target.id
                described = isinstance(after, ast.Expr) and isinstance(after.value, ast.Constant)
                is_table = bool(models_in(table.model_fields[key].annotation))
                if not described and not is_table and f"{name}.{key}".lstrip(".") not in meanings:
                    undescribed.append(f"{name}.{key}")
    assert not undescribed


def test_meanings_name_keys_that_there_are() -> None:
    meanings = tomllib.loads((DOCS / "guide" / "meanings.toml").read_text(encoding="utf-8"))["mission"]
    known = {f"{name}.{key}".lstrip(".") for name, table in tables_of(ScenarioFile) for key in table.model_fields}
    assert set(meanings) <= known


def models_in(annotation: Any) -> list[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [model for argument in get_args(annotation) for model in models_in(argument)]


def tables_of(model: type[BaseModel], name: str = "") -> Iterator[tuple[str, type[BaseModel]]]:
    yield name, model
    for key, field in model.model_fields.items():
        for inner in models_in(field.annotation):
            yield from tables_of(inner, f"{name}.{key}".lstrip("."))


def test_plan_of_the_guide_is_a_plan(tmp_path: Path) -> None:
    (plan,) = blocks("{code-block} toml")
    (tmp_path / "buoy.toml").write_text(plan)
    assert load_plan(tmp_path / "buoy.toml").name == "To the buoy and back"


def test_controller_of_the_guide_flies() -> None:
    (code,) = blocks("{code-block} python")
    namespace: dict[str, Any] = {}
    exec(code, namespace)
    found = fly_mission(load_mission(mission_path("pool_trial")), controller=namespace["steady_rudder"])
    assert (found.record["rudder"] == 0.0).all()
