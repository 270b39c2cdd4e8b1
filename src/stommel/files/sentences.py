"""Validates what a file says; errors are sentences that name the key, the value and what is allowed."""

import re
from collections.abc import Iterator, Sequence
from typing import Any, TypeVar, get_args

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from stommel.errors import FileError, Problem
from stommel.files.kinds import OWN_WORDS
from stommel.files.nearest import nearest
from stommel.files.ranges import OUT_OF_RANGE, ZeroOr
from stommel.files.table_keys import keys_of, models_in
from stommel.files.units import unit_of

Model = TypeVar("Model", bound=BaseModel)

_RANGES = {
    "greater_than": ("gt", "greater than {}"),
    "greater_than_equal": ("ge", "at least {}"),
    "less_than": ("lt", "less than {}"),
    "less_than_equal": ("le", "at most {}"),
}


PRINTABLE = r"^[^\x00-\x1f\x7f]*$"
"""A name without control characters: no system opens the first of them, and the others are not seen."""
_PATTERNS = {
    r"^[A-Za-z]\w*$": "must begin with a letter, and go on with letters, digits and _",
    "^[A-Za-z][A-Za-z0-9_-]*$": "must begin with a letter, and go on with letters, digits, _ and -",
    "^[0-9a-f]{64}$": "must be a SHA-256 digest, 64 digits and letters a to f",
    PRINTABLE: "must not have control characters",
    r"\S": "must not be blank",
    "^[A-Z0-9_]{1,16}$": "must be the name of a parameter, 1 to 16 capital letters, digits and _",
    "^[0-9a-f]{16}$": "must be the id of a command, 16 digits and letters a to f",
    "^[0-9a-f]+$": "must be digits and letters a to f, as the station has told it",
    "^[A-Za-z0-9.:_-]+$": "must be the name or address of a computer: letters, digits, and . : _ -",
}
"""What each pattern of a text means: nobody is shown one."""


def pattern_of(pattern: str, meaning: str) -> str:
    """Return a pattern, whose meaning is told to whoever writes what it does not allow."""
    _PATTERNS[pattern] = meaning
    return pattern


_PLAIN = {
    **dict.fromkeys(("bool_type", "bool_parsing"), "must be true or false"),
    "finite_number": "must be a finite number",
    **dict.fromkeys(("float_type", "float_parsing"), "must be a number"),
    **dict.fromkeys(
        ("int_type", "int_parsing", "int_from_float", "int_parsing_size", "multiple_of"), "must be a whole number"
    ),
    **dict.fromkeys(("list_type", "tuple_type"), "must be a list"),
    "string_type": "must be text",
    "path_type": "must be the name of a file or folder, as text",
    "string_too_long": "must be text of at most {max_length} characters",
    "string_too_short": "must not be empty",
    "too_long": "must be a list of at most {max_length}",
    "too_short": "must be a list of at least {min_length}",
}
"""What is allowed, by kind of error."""


MOST_PROBLEMS = 100
"""Sentences about one file; the rest are counted."""
_LONGEST_KEY = 120


def validated(document: Any, model: type[Model], origin: str) -> Model:
    """Validate what a file says; `origin` names it in messages.

    Raises
    ------
    FileError
        One problem for each wrong key, with what is allowed.
    """
    try:
        return model.model_validate(document)
    except ValidationError as error:
        raise FileError([Problem(origin, key, text) for key, text in sentences(error, model)]) from None


def sentences(error: ValidationError, model: type[BaseModel]) -> list[tuple[str, str]]:
    """Return (key, sentence) for each of the errors, unknown keys first: they often explain the missing ones."""
    details = sorted(error.errors(include_url=False), key=lambda detail: detail["type"] != "extra_forbidden")
    found = [
        (dotted(detail["loc"]), line)
        for detail in details[:MOST_PROBLEMS]
        for line in sentence(detail, model).splitlines()
    ]
    if len(details) > MOST_PROBLEMS:
        found.append(("", f"and {len(details) - MOST_PROBLEMS} more problems"))
    return list({words: (key, words) for key, words in found}.values())  # a short list misses several entries


def dotted(location: Sequence[str | int]) -> str:
    """Key as a user writes it, cut to a readable length."""
    key = ".".join(str(part) for part in location)
    return key if len(key) <= _LONGEST_KEY else f"{key[:_LONGEST_KEY]}..."


def sentence(detail: ErrorDetails, model: type[BaseModel]) -> str:
    """Say what is wrong with one value and what is allowed; `model` describes what it stands in."""
    key, value, kind = dotted(detail["loc"]), detail["input"], detail["type"]
    if kind == "extra_forbidden":
        return _unknown(detail["loc"], model)
    if kind == "missing":
        return _missing(detail, model)
    if kind == "value_error":
        prefix = f"{key}: " if key else ""
        return "\n".join(f"{prefix}{line}" for line in str(detail["ctx"]["error"]).splitlines())
    if kind in _RANGES:
        constraint, words = _RANGES[kind]
        crossed = words.format(detail["ctx"][constraint])
        return f"{key} = {shown(value)}: must be {_with_unit(allowed_range(detail['loc'], model) or crossed, key)}"
    if kind == OUT_OF_RANGE:
        return f"{key} = {shown(value)}: {_with_unit(detail['msg'], key)}"
    if kind in _PLAIN:
        return f"{key} = {shown(value)}: {_PLAIN[kind].format(**detail.get('ctx', {}))}"
    if kind in ("missing_keyword", "model_type", "dict_type", "model_attributes_type"):
        return f"{key} = {shown(value)}: must be a table, [{key}]" if key else f"{shown(value)}: must be a table"
    return f"{key} = {shown(value)}: {_rarely(detail)}"


def value_sentence(detail: ErrorDetails) -> str:
    """Say what is allowed instead of one value that stands for itself, as behind an option."""
    value, kind, context = shown(detail["input"]), detail["type"], detail.get("ctx", {})
    if kind in _RANGES:
        constraint, words = _RANGES[kind]
        return f"{value}: must be {words.format(context[constraint])}"
    if kind in _PLAIN:
        return f"{value}: {_PLAIN[kind].format(**context)}"
    if kind == "value_error":
        said = str(context["error"])
        _, choice, expected = said.partition(" is not one of ")
        return f"{value}: {_one_of(detail['input'], f'one of {expected.rstrip(chr(46))}') if choice else said}"
    return f"{value}: {_rarely(detail)}"


def _rarely(detail: ErrorDetails) -> str:
    """What is allowed, for the kinds of error that are not common to many keys; never in pydantic's words."""
    kind, context = detail["type"], detail.get("ctx", {})
    if kind == OWN_WORDS:
        return detail["msg"]
    if kind in ("literal_error", "enum"):
        return _one_of(detail["input"], context["expected"])
    if kind == "string_pattern_mismatch":
        return _PATTERNS.get(context["pattern"], "has characters that do not belong here")
    return "is not what belongs here"


def _one_of(value: object, expected: str) -> str:
    """What is allowed of a few words, and which of them may be meant; `expected` is pydantic's list of them."""
    words = re.findall(r"'([^']*)'", expected)
    near = nearest(value, words) if isinstance(value, str) else None
    return f"must be {expected}{f'; did you mean {near}?' if near else ''}"


def _with_unit(words: str, key: str) -> str:
    return f"{words} {unit_of(key) or ''}".rstrip()


def _missing(detail: ErrorDetails, model: type[BaseModel]) -> str:
    *parents, name = detail["loc"]
    key = dotted(detail["loc"])
    if isinstance(name, int):
        return f"{dotted(parents)} = {shown(detail['input'])}: the list is too short"
    field = _fields(_table_at(parents, model)).get(name)
    inside = models_in(field.annotation) if field is not None else []
    if inside:
        return f"the table [{key}] is missing; it {keys_of(inside[0])}"
    unit = unit_of(key)
    return f"{key} is missing; add {name}{f' = <number in {unit}>' if unit else ''}"


def shown(value: object) -> str:
    """A value as the file might write it, cut to a readable length."""
    text = str(value).lower() if isinstance(value, bool) else repr(value) if isinstance(value, str) else str(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def _unknown(location: Sequence[str | int], model: type[BaseModel]) -> str:
    *parents, name = location
    known = list(_fields(_table_at(parents, model)))
    where = f"in [{dotted(parents)}]" if parents else "at the top of the file"
    near = next((key for key in known if key.startswith(f"{name}_")), None) or nearest(str(name), known)
    unit = unit_of(near) if near else None
    hint = f"; did you mean {near}{f' (in {unit})' if unit else ''}?" if near else ";"
    return f"{dotted(location)}: unknown key {where}{hint} known keys: {', '.join(known)}"


def _fields(model: type[BaseModel]) -> dict[str, FieldInfo]:
    """Fields of a table by the keys that a file has for them."""
    return {field.alias or name: field for name, field in model.model_fields.items()}


def _table_at(location: Sequence[str | int], model: type[BaseModel]) -> type[BaseModel]:
    """Follow a location down through nested tables."""
    for part in location:
        if isinstance(part, int):
            continue
        inside = models_in(_fields(model)[part].annotation)
        if not inside:
            break
        model = inside[0]
    return model


def allowed_range(location: Sequence[str | int], model: type[BaseModel]) -> str:
    """The range that the field at `location` allows, in words; empty where it has none."""
    *parents, name = [part for part in location if not isinstance(part, int)]
    field = _fields(_table_at(parents, model)).get(str(name))
    if field is None:
        return ""
    constraints = [*field.metadata, *_constraints(field.annotation)]
    for constraint in constraints:
        if isinstance(constraint, ZeroOr):
            return constraint.words()
    ends = {attribute: _limit(constraints, attribute) for attribute, _ in _RANGES.values()}
    if ends["ge"] is not None and ends["le"] is not None:
        return f"between {_plain(ends['ge'])} and {_plain(ends['le'])}"
    return " and ".join(
        text.format(_plain(ends[attribute])) for attribute, text in _RANGES.values() if ends[attribute] is not None
    )


def _constraints(annotation: Any) -> Iterator[Any]:
    """What an annotation says of numbers, however deep in lists and alternatives."""
    for argument in get_args(annotation):
        for extra in getattr(argument, "__metadata__", ()):
            yield from getattr(extra, "metadata", [extra])
        yield from _constraints(argument)


def _limit(constraints: Sequence[Any], attribute: str) -> float | None:
    return next((limit for one in constraints if (limit := getattr(one, attribute, None)) is not None), None)


def _plain(limit: float | None) -> str:
    """A limit as a file might write it: 1000000, 0.5, 1e-05."""
    assert limit is not None
    return str(limit) if isinstance(limit, int) else f"{limit:.12g}"
