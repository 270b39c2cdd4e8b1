"""Limits of telemetry channels, as people set them."""

from collections.abc import Callable
from typing import Annotated, Literal, NamedTuple, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

from stommel.files.ranges import between
from stommel.station.alarms.severity import Severity
from stommel.station.alarms.threshold import Threshold

Value = Annotated[float, between(-1e9, 1e9)]
Side = Literal["low", "high"]


class ChannelWords(NamedTuple):
    """What people call a channel."""

    words: str
    unit: str


Naming = Callable[[str], ChannelWords]
"""From the key of a channel to what people call it."""


class LimitValues(BaseModel):
    """What a channel may be, and when somebody is told that it is not."""

    model_config = ConfigDict(extra="forbid", frozen=True, json_schema_serialization_defaults_required=True)

    low: Value | None = None
    """Least value that is allowed, in the channel's unit."""
    high: Value | None = None
    """Greatest value that is allowed, in the channel's unit."""
    hysteresis: Annotated[float, between(0, 1e9)] = 0.0
    """How far inside the limit a value must be to clear the alarm, in the channel's unit."""
    delay_s: Annotated[float, between(0, 86_400)] = 0.0
    """For how long values must be beyond the limit before the alarm is raised."""
    severity: Severity = "warning"

    @model_validator(mode="after")
    def _can_be_kept(self) -> Self:
        if self.low is None and self.high is None:
            raise ValueError("give low, high, or both")
        if self.low is not None and self.high is not None:
            if not self.low < self.high:
                raise ValueError(f"low = {self.low:g}: must be less than high = {self.high:g}")
            if self.hysteresis > self.high - self.low:
                raise ValueError(f"hysteresis = {self.hysteresis:g}: must be at most high - low")
        return self


class Limit(LimitValues):
    """A limit of a channel."""

    channel: Annotated[str, Field(min_length=1, max_length=80)]

    def sides(self) -> dict[Side, float]:
        """The limits that are set."""
        ends: dict[Side, float | None] = {"low": self.low, "high": self.high}
        return {side: end for side, end in ends.items() if end is not None}

    def threshold(self, side: Side, *, raised: bool = False) -> Threshold:
        """What watches one side of it."""
        return Threshold(
            self.sides()[side], above=side == "high", hysteresis=self.hysteresis, delay=self.delay_s, raised=raised
        )


class SetLimit(NamedTuple):
    """A limit as the archive has it."""

    limit: Limit
    changed: float
    """When somebody set it, by the station's clock [s since 1970]."""
    changed_by: str
    """Who did."""


def limit_key(channel: str, side: Side) -> str:
    """Key of the alarm of one side of a channel's limit."""
    return f"limit:{channel}:{side}"


def limit_words(limit: Limit, side: Side, naming: Naming) -> str:
    """What the alarm of one side says; nothing is `above` a depth, which to a sailor is shallower."""
    words, unit = naming(limit.channel)
    than = f"{limit.sides()[side]:.10g} {unit}".rstrip()
    return f"{words[:1].upper()}{words[1:]} {'less' if side == 'low' else 'greater'} than {than}"
