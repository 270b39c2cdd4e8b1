"""Positions, and which of them are believed."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

from stommel.geometry.earth import MEAN_RADIUS

_ORIGIN = math.radians(1e-5)
"""A metre around 0,0, where receivers without a position say that they are."""


class Fix(NamedTuple):
    """A position of the receiver; radians."""

    t: float
    """When its bytes came, by the vehicle's clock [s]."""
    utc: float
    """When it held, seconds since 1970; not a number while the receiver does not know UTC."""
    latitude: float
    longitude: float
    sigma: float
    """Standard deviation of the horizontal position [m]."""
    age: float = 0.0
    """How long it had held when its bytes came [s]."""
    speed: float = math.nan
    """Over ground [m/s]."""
    course: float = math.nan
    """Over ground, from true north."""
    satellites: int = 0
    """Used for it."""


class Refusal(StrEnum):
    """Why a position is no fix."""

    NO_SOLUTION = "no solution"
    """The receiver says that it has none."""
    OLD = "old"
    ORIGIN = "0,0"
    JUMP = "jump"
    SUBMERGED = "submerged"
    IMPOSSIBLE = "impossible"
    """No place on earth."""


class NoFix(NamedTuple):
    """A position that is not believed."""

    t: float
    reason: Refusal
    detail: str
    """In words."""


@dataclass(frozen=True)
class FixLimits:
    """Bounds of what is believed."""

    age: float = 2.0
    """Oldest position [s]."""
    depth: float = 1.0
    """Deepest place at which satellites are heard [m]."""
    speed: float = 10.0
    """Fastest that the vehicle moves between two fixes [m/s]: as fast as a ship that carries it."""
    slack: float = 100.0
    """Jump that is no speed [m]: of two fixes by other satellites."""
    agreeing: int = 10
    """Fixes in a row that agree with each other, after which they are believed against the one before the jump."""


def distance(fix: Fix, other: Fix) -> float:
    """Along the sphere [m]."""
    half_lat, half_lon = (fix.latitude - other.latitude) / 2.0, (fix.longitude - other.longitude) / 2.0
    h = math.sin(half_lat) ** 2 + math.cos(fix.latitude) * math.cos(other.latitude) * math.sin(half_lon) ** 2
    return 2.0 * MEAN_RADIUS * math.asin(min(1.0, math.sqrt(h)))


class FixRules:
    """Holds positions against the limits, each against the last that was believed."""

    def __init__(self, limits: FixLimits | None = None) -> None:
        self.limits = limits or FixLimits()
        self._last: Fix | None = None
        self._doubted: Fix | None = None
        self._agreeing = 0

    def judge(self, fix: Fix, t: float, depth: float = 0.0) -> Fix | NoFix:
        """Return the fix, or why it is none at a time and a depth; a depth that is not a number forbids nothing."""
        for rule in _RULES:
            refusal = rule(self, fix, t, depth)
            if refusal:
                return NoFix(t, *refusal)
        self._last = fix
        return fix

    def _impossible(self, fix: Fix, t: float, depth: float) -> tuple[Refusal, str] | None:  # noqa: ARG002
        if abs(fix.latitude) <= math.pi / 2.0 and abs(fix.longitude) <= math.pi and fix.sigma >= 0.0:
            return None
        place = f"{math.degrees(fix.latitude):g}, {math.degrees(fix.longitude):g}"
        return Refusal.IMPOSSIBLE, f"{place} +- {fix.sigma:g} m is no place"

    def _origin(self, fix: Fix, t: float, depth: float) -> tuple[Refusal, str] | None:  # noqa: ARG002
        if abs(fix.latitude) > _ORIGIN or abs(fix.longitude) > _ORIGIN:
            return None
        return Refusal.ORIGIN, "0,0 is what receivers without a position say"

    def _submerged(self, fix: Fix, t: float, depth: float) -> tuple[Refusal, str] | None:  # noqa: ARG002
        if not depth > self.limits.depth:
            return None
        return Refusal.SUBMERGED, f"heard at {depth:.1f} m, deeper than {self.limits.depth:g} m"

    def _old(self, fix: Fix, t: float, depth: float) -> tuple[Refusal, str] | None:  # noqa: ARG002
        age = fix.age + max(0.0, t - fix.t)
        if age <= self.limits.age:
            return None
        return Refusal.OLD, f"{age:.1f} s old, more than {self.limits.age:g} s"

    def _jump(self, fix: Fix, t: float, depth: float) -> tuple[Refusal, str] | None:  # noqa: ARG002
        if self._last is None or self._near(fix, self._last):
            self._agreeing, self._doubted = 0, None
            return None
        agrees = self._doubted is not None and self._near(fix, self._doubted)
        self._agreeing = self._agreeing + 1 if agrees else 1
        self._doubted = fix
        if self._agreeing >= self.limits.agreeing:
            self._agreeing, self._doubted = 0, None
            return None
        way, span = distance(fix, self._last), fix.t - self._last.t
        return Refusal.JUMP, f"{way:.0f} m in {span:.0f} s, faster than {self.limits.speed:g} m/s"

    def _near(self, fix: Fix, other: Fix) -> bool:
        reach = self.limits.speed * max(0.0, fix.t - other.t) + self.limits.slack + 3.0 * (fix.sigma + other.sigma)
        return distance(fix, other) <= reach


_Rule = Callable[[FixRules, Fix, float, float], tuple[Refusal, str] | None]
_RULES: tuple[_Rule, ...] = (
    FixRules._impossible,
    FixRules._submerged,
    FixRules._origin,
    FixRules._old,
    FixRules._jump,
)
