"""Every field of every kind of file takes its own kind alone: a date is a date, a number a number, a flag a flag.

Oracle: the annotation of the field, and words that no sentence of ours has.
"""

import importlib
import pkgutil
from collections.abc import Iterator
from datetime import UTC, date, datetime, time
from pathlib import Path
from typing import Any, Literal, get_args, get_origin

import pytest
from pydantic import BaseModel
from pydantic.fields import FieldInfo

import stommel
from stommel.errors import FileError
from stommel.files.sentences import validated
from stommel.simulation.scenario.loading import mission_from
from tests.simulation.conftest import mission_document

NOON = datetime(2026, 7, 1, 12, tzinfo=UTC)
VALUES: tuple[Any, ...] = (
    True, 1, 1.5, 1.0, "x", "1", "1.5", "yes", "1e3", "20260701", [], {}, [1], ["a"], [[1]], {"a": 1}, float("nan"),
    float("inf"), date(2026, 7, 1), time(1, 2), NOON, -1, 0, 10**30, [1, 2, 3], [True, False, True], [1.0, "x", 2],
    [[1, 2, 3]] * 4, [{}], "a" * 1000, "a\nb",
)  # fmt: skip
FOREIGN = ("nput", "alue error", "instance", "unable to", "should", "tuple", "string", "pydantic", "dict", "boolean")
"""Words of pydantic."""


def models() -> Iterator[type[BaseModel]]:
    for module in pkgutil.walk_packages(stommel.__path__, "stommel."):
        importlib.import_module(module.name)
    waiting, seen = [BaseModel], set()
    while waiting:
        for model in waiting.pop().__subclasses__():
            if model not in seen and model.__module__.startswith(("stommel.", "pydantic.")):
                seen.add(model)
                waiting.append(model)
                if model.__module__.startswith("stommel."):
                    yield model


MODELS = sorted(
    # answers and questions of the web door are no files; its own tests try them
    (model for model in models() if not model.__module__.startswith("stommel.station.web.")),
    key=lambda model: f"{model.__module__}.{model.__name__}",
)


def refusals(model: type[BaseModel], key: str, value: Any) -> list[str]:
    """What is said about one key when it has this value, and every other is missing."""
    try:
        validated({key: value}, model, "x.toml")
    except FileError as error:
        return [p.message for p in error.problems if p.key == key or p.key.startswith(f"{key}.")]
    return []


def kinds(annotation: Any) -> set[Any]:
    if get_origin(annotation) is Literal:
        return {type(word) for word in get_args(annotation)}
    inside = [part for part in get_args(annotation) if not isinstance(part, FieldInfo)]
    return {kind for part in inside for kind in kinds(part)} if inside else {annotation}


def key_of(name: str, field: FieldInfo) -> str:
    return field.alias or name


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.__name__)
def test_a_field_takes_its_own_kind_alone(model: type[BaseModel]) -> None:
    for name, field in model.model_fields.items():
        allowed = kinds(field.annotation)
        if Any in allowed:  # values of a sweep, which the study checks by the field that they are for
            continue
        for value in (True, 1, 1.5, 1.0, "1", "1.5", "yes", 20260701):
            fits = type(value) in allowed or (type(value) is int and float in allowed)
            if isinstance(value, str) and (datetime in allowed or Path in allowed):
                fits = True
            if not fits:
                assert refusals(model, key_of(name, field), value), f"{model.__name__}.{name} takes {value!r}"


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.__name__)
def test_no_refusal_is_in_the_words_of_a_library(model: type[BaseModel]) -> None:
    for name, field in model.model_fields.items():
        key = key_of(name, field)
        for value in VALUES:
            for said in refusals(model, key, value):
                own = said.replace(repr(value), "").split("known keys:")[0]
                assert not any(word in own for word in FOREIGN), said
                assert "is not what belongs here" not in own, said
                assert len(said) < 2000
                assert "\n" not in said


@pytest.mark.parametrize("given", [20260701, 20260701.0, 1.78e9, True, "soon", "12:00", date(2026, 7, 1), time(12, 0)])
def test_a_start_is_a_date(given: Any) -> None:
    """A number flew in 1970 before."""
    with pytest.raises(FileError, match=r"test\.toml: start_time(:| = .*:) (must be a date|needs a time zone)"):
        mission_from(mission_document(start_time=given), "test.toml", Path())


@pytest.mark.parametrize("given", [NOON, "2026-07-01T12:00:00Z", "2026-07-01 14:00:00+02:00", "20260701T120000Z"])
def test_a_date_is_a_start(given: Any) -> None:
    mission = mission_from(mission_document(start_time=given), "test.toml", Path())
    assert mission.scenario.start_time == NOON


def test_a_word_that_is_nearly_allowed_is_asked_for() -> None:
    with pytest.raises(FileError, match=r"physics = 'papr': must be 'paper' or 'full'; did you mean paper\?"):
        mission_from(mission_document(physics="papr"), "test.toml", Path())
