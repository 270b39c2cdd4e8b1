"""Numbers for JSON, which has no NaN: what is not known is null."""

from collections.abc import Mapping
from math import isfinite
from typing import Any


def finite(content: Any) -> Any:
    """The same with None for each number that is not finite."""
    if isinstance(content, float):
        return content if isfinite(content) else None
    if isinstance(content, Mapping):
        return {key: finite(value) for key, value in content.items()}
    if isinstance(content, (list, tuple)):
        return [finite(value) for value in content]
    return content
