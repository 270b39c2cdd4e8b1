"""The keys of a table in one sentence, for whoever left the table out."""

from typing import Any, get_args

from pydantic import BaseModel


def models_in(annotation: Any) -> list[type[BaseModel]]:
    """Tables that the annotation of a field holds."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [model for argument in get_args(annotation) for model in models_in(argument)]


def keys_of(model: type[BaseModel]) -> str:
    """Every key of a table: those that it needs, and those that it may have; tables inside it in brackets."""
    needed: list[str] = []
    allowed: list[str] = []
    for name, field in model.model_fields.items():
        key = field.alias or name
        (needed if field.is_required() else allowed).append(f"[{key}]" if models_in(field.annotation) else key)
    words = [f"needs {', '.join(needed)}"] if needed else []
    if allowed:
        words.append(f"may have {', '.join(allowed)}")
    return "; ".join(words)


def model_at(model: type[BaseModel], dotted: str) -> type[BaseModel]:
    """The table that a dotted name means inside a file, such as `drives.pitch`."""
    for name in dotted.split("."):
        (model,) = models_in(model.model_fields[name].annotation)
    return model
