"""Every field of every kind of file, mutated one at a time: refused in short lines that name it, or read, and quickly.

Of a list of tables the first stands for all. What then comes of numbers that are read is asked of the verbs for a drawn
share; `python -m tests.support.mutation_run` and `option_run` run them all.
"""

import random
import tempfile
import time
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from unittest.mock import patch

import pytest

from stommel.bench.column_map import EngineLogMap
from stommel.bench.holding_description import HoldingDescription
from stommel.errors import FileError, StommelError
from stommel.files.provenance import separate
from stommel.files.sentences import validated
from stommel.machinery.engine.files import engine_from_text
from stommel.machinery.hull.materials import materials_from_text
from stommel.simulation.scenario.loading import mission_from
from stommel.studies.study_file import StudyFile
from stommel.vehicle import load_vehicle, vehicle_from_text
from stommel.vehicle.plausible import implausible
from tests.support.command import run_here
from tests.support.mutation_run import counts, finite_answer
from tests.support.mutations import Mutation, mutations, toml_text
from tests.support.shipped_files import COLUMN_MAP, SHIPPED, Shipped

LONGEST_LINE = 500
SLOWEST_S = 2.0
KINDS = ("absent", "negative", "zero", "x1000", "/1000", "1e30", "1e308", "1e-30", "nan", "text", "number", "long text")
NAMED = ("1e30", "1e308", "nan", "text")
"""Kinds whose refusal is about the key itself."""
ZJU = load_vehicle("zju")


def read_vehicle(document: dict[str, Any], name: str) -> None:
    with patch("stommel.vehicle.loading.parse_toml", lambda _text, _origin: document):
        list(implausible(vehicle_from_text("", name).description))


def read_engine(document: dict[str, Any], name: str) -> None:
    with patch("stommel.machinery.engine.files.parse_toml", lambda _text, _origin: document):
        engine_from_text("", name)


def read_materials(document: dict[str, Any], name: str) -> None:
    with patch("stommel.machinery.hull.materials.parse_toml", lambda _text, _origin: document):
        materials_from_text("", name)


READERS: dict[str, Callable[[dict[str, Any], str], object]] = {
    "vehicle": read_vehicle,
    "engine": read_engine,
    "materials": read_materials,
    "mission": lambda document, name: mission_from(document, name, Path(), vehicle=ZJU),
    "study": lambda document, name: validated(document, StudyFile, name),
    "bench": lambda document, name: validated(separate(document, name)[0], HoldingDescription, name),
    "column map": lambda document, name: validated(document, EngineLogMap, name),
}
FILES = (*SHIPPED, Shipped("column map", "log.toml", COLUMN_MAP, ()))


def firsts(shipped: Shipped) -> Iterator[Mutation]:
    """Mutations, of a list of tables those of the first."""
    document = tomllib.loads(shipped.text)
    for mutation in mutations(document):
        here: Any = document
        for part in mutation.path:
            if isinstance(part, int) and part > 0 and isinstance(here[part], dict):
                break
            here = here[part]
        else:
            if mutation.kind in KINDS:
                yield mutation


def refusal(shipped: Shipped, mutation: Mutation) -> StommelError | None:
    """How a mutated file is refused; None if it is read."""
    try:
        READERS[shipped.kind](mutation.document, shipped.name)
    except StommelError as error:
        return error
    return None


@pytest.mark.parametrize("shipped", FILES, ids=lambda one: one.name)
def test_every_field_is_read_or_refused_in_short_lines(shipped: Shipped) -> None:
    READERS[shipped.kind](tomllib.loads(shipped.text), shipped.name)
    for mutation in firsts(shipped):
        began = time.process_time()
        error = refusal(shipped, mutation)
        assert time.process_time() - began < SLOWEST_S, (mutation.key, mutation.kind)
        if error is None:
            continue
        lines = str(error).splitlines()
        assert max(map(len, lines)) <= LONGEST_LINE, (mutation.key, mutation.kind, lines)
        assert "alue error" not in str(error), (mutation.key, mutation.kind, lines)
        if isinstance(error, FileError) and not mutation.key.startswith("changes"):
            assert all(line.startswith(f"{shipped.name}: ") for line in lines), lines
        if mutation.kind in NAMED:
            name = next(part for part in reversed(mutation.key.split(".")) if not part.isdigit())
            assert name in str(error), (mutation.key, mutation.kind, lines)


@pytest.mark.parametrize("kind", ["1e30", "1e308", "nan", "text"])
@pytest.mark.parametrize("shipped", FILES, ids=lambda one: one.name)
def test_no_number_may_be_anything(shipped: Shipped, kind: str) -> None:
    """Both ends are stated: what is beyond all of them is refused in every field of every kind of file."""
    read = []
    for mutation in firsts(shipped):
        if mutation.kind != kind or mutation.key == "format" or isinstance(mutation.value, bool):
            continue
        if refusal(shipped, mutation) is None:
            read.append(mutation.key)
    assert read == []


@pytest.mark.parametrize("shipped", [one for one in SHIPPED if one.kind == "vehicle"], ids=lambda one: one.name)
def test_a_slip_of_three_digits_is_told(shipped: Shipped) -> None:
    """Of numbers times a thousand, and of sizes over a thousand, at most one in twenty is taken without a word."""
    asked, silent = 0, []
    for mutation in firsts(shipped):
        if not counts(mutation):
            continue
        asked += 1
        try:
            with patch("stommel.vehicle.loading.parse_toml", lambda _text, _origin, it=mutation: it.document):
                found = list(implausible(vehicle_from_text("", shipped.name).description))
        except StommelError:
            continue
        if not found:
            silent.append(mutation.key)
    assert asked > 20
    assert len(silent) <= 0.05 * asked, silent


def test_a_drawn_share_through_the_verbs() -> None:
    """What is read is answered with finite numbers or a refusal; nothing ends as a defect."""
    shipped = next(one for one in SHIPPED if one.name == "zju.toml")
    scales = [one for one in firsts(shipped) if one.kind in ("zero", "negative", "/1000", "x1000", "1e-30", "absent")]
    for mutation in random.Random(1).sample(scales, 40):
        with tempfile.TemporaryDirectory() as name:
            (Path(name) / shipped.name).write_text(toml_text(mutation.document), encoding="utf-8")
            for verb in shipped.verbs[:-1]:
                found = run_here(Path(name), *verb)
                assert found.status in (0, 2), (mutation.key, mutation.kind, verb)
                assert found.status == 2 or finite_answer(found.out), (mutation.key, mutation.kind, verb)
                if found.status == 2 and verb[0] == "vehicle":
                    break
