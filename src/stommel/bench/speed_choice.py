"""The most economical motor speed under a limit on inflating time (section 5.1.2 of the paper: 7000 r/min)."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite, pi

from stommel.bench.failures import BenchRequestError
from stommel.bench.performance import OperatingPoint, levels, nearest

MARGIN = 0.05
"""Of speeds whose consumption differs by no more than this share, the slowest is chosen."""


@dataclass(frozen=True)
class TimeLimit:
    """How long an inflation may take."""

    longest: float
    """[s]"""
    volume: float
    """Oil to inflate [m3]."""
    pressure: float
    """Pressure at which the limit holds [Pa]."""


def time_limit_of(*, longest_s: float, volume_ml: float, pressure_mpa: float) -> TimeLimit:
    """Return a limit from words and units.

    Raises
    ------
    BenchRequestError
        Time or volume is not greater than zero, or the pressure less than zero.
    """
    for name, value, possible in (
        ("time limit", longest_s, longest_s > 0.0),
        ("volume", volume_ml, volume_ml > 0.0),
        ("pressure of the limit", pressure_mpa, pressure_mpa >= 0.0),
    ):
        if not (possible and isfinite(value)):
            allowed = "at least 0" if name.startswith("pressure") else "greater than 0"
            raise BenchRequestError(f"{name} = {value:g}: must be {allowed}")
    return TimeLimit(longest_s, volume_ml / 1e6, pressure_mpa * 1e6)


@dataclass(frozen=True)
class SpeedCandidate:
    """One motor speed over the pressures that every speed was run at."""

    motor_speed: float
    """[rad/s]"""
    K: float
    """Energy per metre of piston travel, averaged over those pressures [J/m]."""
    inflating_time: float
    """At the pressure of the limit [s]."""
    refused_because: str
    """Why this speed cannot be chosen; empty if it can."""

    def as_row(self) -> dict[str, float | str | bool | None]:
        """Words and units for JSON and tables."""
        return {
            "motor_speed_rpm": self.motor_speed * 60 / (2 * pi),
            "mean_consumption_j_per_mm": self.K / 1e3 if isfinite(self.K) else None,
            "inflating_time_s": self.inflating_time if isfinite(self.inflating_time) else None,
            "admissible": not self.refused_because,
            "refused_because": self.refused_because,
        }


@dataclass(frozen=True)
class SpeedChoice:
    """The chosen speed and what it was chosen from."""

    chosen: SpeedCandidate | None
    candidates: tuple[SpeedCandidate, ...]
    pressures: tuple[float, ...]
    """Pressures that the consumption is averaged over [Pa]."""
    limit: TimeLimit
    margin: float
    """Consumptions within this share count as equal."""

    def as_row(self) -> dict[str, object]:
        """Words and units for JSON; no speed where none is fast enough."""
        return {
            "motor_speed_rpm": None if self.chosen is None else self.chosen.motor_speed * 60 / (2 * pi),
            "reason": self.reason(),
            "time_limit_s": self.limit.longest,
            "inflate_ml": self.limit.volume * 1e6,
            "limit_pressure_mpa": self.limit.pressure / 1e6,
            "margin_percent": self.margin * 100,
            "pressures_mpa": [P / 1e6 for P in self.pressures],
            "candidates": [one.as_row() for one in self.candidates],
        }

    def reason(self) -> str:
        """Say in one sentence why this speed."""
        volume, longest = f"{self.limit.volume * 1e6:g} ml", f"{self.limit.longest:g} s"
        at = f"{self.limit.pressure / 1e6:.3g} MPa"
        if self.chosen is None:
            fastest = min(self.candidates, key=lambda one: one.inflating_time)
            return (
                f"no speed inflates {volume} at {at} within {longest}; the quickest is {_rpm(fastest)} r/min with "
                f"{fastest.inflating_time:.1f} s"
            )
        frugal = min(self.candidates, key=lambda one: one.K)
        words = (
            f"{_rpm(self.chosen)} r/min takes least, within {self.margin:.0%}, of the speeds that inflate {volume} "
            f"at {at} within {longest}"
        )
        if frugal is not self.chosen:
            share = 1 - frugal.K / self.chosen.K
            but = (
                frugal.refused_because or "that is within the margin, and the slower motor is kinder to pump and supply"
            )
            words += f"; {_rpm(frugal)} r/min would take {share:.1%} less, but {but}"
        return words


def choose_speed(
    points: Sequence[OperatingPoint], limit: TimeLimit, piston_area: float, margin: float = MARGIN
) -> SpeedChoice:
    """Choose the speed of least consumption K that inflates in time; of nearly equal ones, the slowest.

    Parameters
    ----------
    points
        Runs, or points of the model, at several speeds and pressures.
    limit
        Longest time, for which volume, at which pressure.
    piston_area
        S [m2].
    margin
        Share of consumption that counts as equal.

    Raises
    ------
    BenchRequestError
        The margin is negative, the speeds share no pressure, or none near that of the limit.
    """
    if not 0.0 <= margin < 1.0:
        raise BenchRequestError(f"margin = {margin * 100:g} %: must be at least 0 and less than 100 %")
    pressures = levels([point.pressure for point in points])
    speeds = levels([point.motor_speed for point in points])
    table: dict[tuple[int, int], list[OperatingPoint]] = {}
    for point in points:
        table.setdefault((nearest(point.motor_speed, speeds), nearest(point.pressure, pressures)), []).append(point)
    shared = [j for j in range(len(pressures)) if all((i, j) in table for i in range(len(speeds)))]
    if not shared:
        raise BenchRequestError("no pressure was run at every motor speed: their consumption cannot be compared")
    at = min(shared, key=lambda j: abs(pressures[j] - limit.pressure))
    if abs(pressures[at] - limit.pressure) > 0.05 * max(limit.pressure, 1e6):
        known = ", ".join(f"{pressures[j] / 1e6:.3g}" for j in shared)
        raise BenchRequestError(
            f"limit at {limit.pressure / 1e6:g} MPa: every motor speed was run at {known} MPa; choose one of these"
        )
    candidates = tuple(
        _candidate(speeds[i], [table[i, j] for j in shared], table[i, at], limit, piston_area)
        for i in range(len(speeds))
    )
    able = [one for one in candidates if not one.refused_because]
    least = min((one.K for one in able), default=0.0)
    chosen = next((one for one in able if one.K - least <= margin * least), None)
    return SpeedChoice(chosen, candidates, tuple(pressures[j] for j in shared), limit, margin)


def _candidate(
    speed: float,
    by_pressure: Sequence[Sequence[OperatingPoint]],
    at_limit: Sequence[OperatingPoint],
    limit: TimeLimit,
    piston_area: float,
) -> SpeedCandidate:
    """Average repeated points first, so that each pressure weighs the same."""
    K = sum(sum(p.K for p in points) / len(points) for points in by_pressure) / len(by_pressure)
    moving = [p for p in at_limit if p.piston_speed > 0.0]
    time = sum(p.inflating_time(limit.volume, piston_area) for p in moving) / len(moving) if moving else float("inf")
    out_of_reach = [p for points in by_pressure for p in points if not p.attainable]
    reason = ""
    if out_of_reach:
        worst = max(p.pressure for p in out_of_reach)
        reason = f"the supply does not allow it at {worst / 1e6:.3g} MPa"
    elif time > limit.longest:
        reason = f"it needs {time:.1f} s"
    return SpeedCandidate(speed, K, time, reason)


def _rpm(candidate: SpeedCandidate) -> str:
    return f"{candidate.motor_speed * 60 / (2 * pi):.0f}"
