"""What a CTD sends while it samples: lines of numbers, by variant.

The command chapter of the GPCTD's manual was not to be had. These are layouts that others have met, and two plain ones
of stommel's simulated instrument; none is claimed to be what a certain firmware sends. A new one is a row.
"""

import re
from dataclasses import dataclass
from functools import cached_property

from stommel.instruments.gpctd.reading import CtdReading, checked


@dataclass(frozen=True)
class Column:
    """A value of a line."""

    name: str
    """One of a `CtdReading`; empty for one that is passed over."""
    decimals: int | None = None
    """Digits after the point; None for any. Where the number is known, a line cut within a value shows."""
    factor: float = 1.0
    """To the unit of the reading."""


@dataclass(frozen=True)
class Variant:
    """A layout of lines."""

    columns: tuple[Column, ...]

    @cached_property
    def pattern(self) -> re.Pattern[bytes]:
        """A whole line of it, each value a group."""
        values = (
            rb" {0,8}(-?\d{1,6}\.\d{%b}|-?9{3,6}|NaN|\*{1,8})" % (b"%d" % c.decimals if c.decimals else b"1,8")
            for c in self.columns
        )
        return re.compile(b",".join(values) + b" {0,8}")


_BAR = 10.0
_OTHER = Column("")
VARIANTS: dict[str, Variant] = {
    "plain": Variant((Column("pressure", 3), Column("temperature", 4), Column("conductivity", 5))),
    "plain_oxygen": Variant(
        (Column("pressure", 3), Column("temperature", 4), Column("conductivity", 5), Column("oxygen", 1))
    ),
    "slocum_converted": Variant(
        (
            *(Column("pressure", factor=_BAR), Column("temperature"), Column("conductivity")),
            *(_OTHER, _OTHER, _OTHER),  # temperature, pressure and humidity within
        )
    ),
    "slocum_raw": Variant(
        (
            *(Column("pressure", factor=_BAR), Column("temperature"), Column("conductivity")),
            *(_OTHER, _OTHER, _OTHER, _OTHER),  # interval, temperature, pressure and humidity within
        )
    ),
}
"""Layouts by name. Those of Slocum's payload CTD V1.3.1 are after ctdsampler, pressure in bar."""


def live_reading(line: bytes, variant: Variant, t: float) -> CtdReading | None:
    """Return the reading of a line; None if it is not one of the variant."""
    match = variant.pattern.fullmatch(line)
    if match is None:
        return None
    values = {}
    for column, text in zip(variant.columns, match.groups(), strict=True):
        if column.name:
            values[column.name] = float(text) * column.factor if b"." in text else float("nan")  # a bare 999 is none
    good, refused = checked(values)
    return CtdReading(t, **good, refused=refused)


def live_line(variant: Variant, values: dict[str, float]) -> bytes:
    """Line of a variant, without its end; a value that is not a number is written as 9999."""
    texts = []
    for column in variant.columns:
        value = values.get(column.name, 0.0) / column.factor
        texts.append("9999" if value != value else f"{value:.{column.decimals or 4}f}")  # noqa: PLR0124 - NaN
    return ",".join(texts).encode("ascii")
