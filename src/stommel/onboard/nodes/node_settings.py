"""Settings of a node: each with its limits, and those that can be set over the bus with their number."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from math import inf
from typing import Any, NamedTuple, TypeVar, cast

from stommel.errors import StommelError
from stommel.files.nearest import did_you_mean
from stommel.messages.parameters import Parameter, ParameterServer, ParameterType


class SettingsError(StommelError):
    """A setting of a node is beyond its limits."""


class _Limits(NamedTuple):
    words: str
    low: float
    high: float
    unit: str
    number: int | None
    factor: float


def setting(
    words: str, default: float, low: float, high: float, unit: str = "", number: int | None = None, factor: float = inf
) -> Any:
    """Return a field of a settings class: its meaning, limits, unit, and number as a parameter where it has one.

    The meaning is what a pilot ashore reads beside the parameter.

    Over the bus a setting changes by no more than a factor from what the vehicle was given: a mistyped speed must not
    keep it down.
    """
    return field(default=default, metadata={"limits": _Limits(words, low, high, unit, number, factor)})


@dataclass(frozen=True)
class NodeSettings:
    """Settings that are checked as they are made.

    Raises
    ------
    SettingsError
        A value is beyond its limits.
    """

    def __post_init__(self) -> None:
        for each, (_, low, high, unit, _, _) in _limits(self).items():
            value = getattr(self, each)
            if not low <= value <= high:  # not a number, too
                raise SettingsError(f"{type(self).__name__}.{each} = {value}: must be {_span(low, high, unit)}")

    def require_order(self, low: str, high: str) -> None:
        """Hold one setting below another.

        Raises
        ------
        SettingsError
            It is not.
        """
        if not getattr(self, low) < getattr(self, high):
            least = getattr(self, high)
            raise SettingsError(
                f"{type(self).__name__}.{low} = {getattr(self, low)}: must be less than {high}, {least}"
            )


Settings = TypeVar("Settings", bound=NodeSettings)


def _span(low: float, high: float, unit: str) -> str:
    return f"between {low:g} and {high:g} {unit}".rstrip()


def _limits(settings: NodeSettings) -> Mapping[str, _Limits]:
    return {each.name: each.metadata["limits"] for each in fields(settings) if "limits" in each.metadata}


def _kind(value: float) -> ParameterType:
    if isinstance(value, bool):
        return ParameterType.bool
    return ParameterType.int32 if isinstance(value, int) else ParameterType.float32


def parameters_of(settings: NodeSettings) -> list[Parameter]:
    """What can be set of a node over the bus; the settings given are the defaults."""
    found = []
    for name, (words, low, high, unit, number, factor) in _limits(settings).items():
        if number is not None:
            value = getattr(settings, name)
            if factor < inf:
                low, high = max(low, value / factor), min(high, value * factor)  # noqa: PLW2901 - the narrower ones
            found.append(Parameter(number, name, _kind(value), value, low, high, unit, words))
    return found


def objection_to(settings: type[NodeSettings], name: str, value: float) -> str:
    """What is wrong with a value for a parameter of whatever vehicle, in words; empty if nothing is."""
    known = {each: limits for each, limits in _limits(settings()).items() if limits.number is not None}
    if name not in known:
        return f"is no parameter of the node{did_you_mean(name, known)} known: {', '.join(known)}"
    _, low, high, unit, _, _ = known[name]
    kind = _kind(getattr(settings(), name))
    if not low <= value <= high:
        return f"must be {_span(low, high, unit)}"
    whole = kind is ParameterType.float32 or value == int(value)
    return "" if whole else "must be a whole number"


def settings_with(settings: Settings, server: ParameterServer) -> Settings:
    """Return settings with a parameter server's values."""
    values = {}
    for name, (_, low, high, _, number, _) in _limits(settings).items():
        if number is not None:
            # a limit that 32 bits hold a little too large is the limit
            values[name] = min(max(server[name], low), high)
    return replace(settings, **cast(dict[str, Any], values))
