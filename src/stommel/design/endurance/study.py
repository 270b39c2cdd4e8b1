"""The whole energy question in one value: endurance, best flights, sensitivities, and what would close a gap."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import hypot
from typing import Any

import numpy as np

from stommel.design.endurance.best_flights import BestFlights, best_flights
from stommel.design.endurance.endurance import DAY, Endurance, endurance
from stommel.design.endurance.sea import Sea
from stommel.design.endurance.sensitivity import Sensitivity, sensitivity
from stommel.design.endurance.varied import Case
from stommel.errors import StommelError
from stommel.vehicle import PAPER, Physics, Vehicle

LEAST_SPAN_DAYS = 0.1
"""An assumption that adds less to the endurance is no step towards closing a gap."""


@dataclass(frozen=True)
class GapStep:
    """One assumption moved to the end of its span that favours endurance, after those before it."""

    sensitivity: Sensitivity
    value: float
    days: float
    """Endurance with this and all earlier steps [days]."""

    def as_row(self) -> dict[str, Any]:
        """The step in words with units."""
        a = self.sensitivity.assumption
        return {"key": a.key, "what": a.what, "unit": a.unit, "from": a.value, "to": self.value,
                "endurance_days": self.days}  # fmt: skip


@dataclass(frozen=True)
class Gap:
    """A target of endurance that is missed, and what would close the gap."""

    target_days: float
    allowed_power_w: float
    """Mean power at which the battery would last to the target, self-discharge left out [W]."""
    missing_power_w: float
    """What the vehicle takes beyond it [W]."""
    steps: tuple[GapStep, ...]
    """Assumptions taken at their favourable ends, the weightiest first, until the target is reached."""
    closed: bool
    """Whether the steps reach the target."""
    alone: tuple[Sensitivity, ...]
    """Assumptions of which another value alone would reach it."""

    def as_row(self) -> dict[str, Any]:
        """The gap in words with units."""
        return {
            "target_days": self.target_days,
            "allowed_power_w": self.allowed_power_w,
            "missing_power_w": self.missing_power_w,
            "closed_by_favourable_assumptions": self.closed,
            "favourable_assumptions": [step.as_row() for step in self.steps],
            "closed_alone_by": [
                {"key": one.assumption.key, "from": one.assumption.value, "to": one.needed, "unit": one.assumption.unit}
                for one in self.alone
            ],
        }


@dataclass(frozen=True)
class Interval:
    """Between what the endurance lies, by the ranges of the numbers that nobody knows [days]."""

    least: float | None
    """All of them at their unfavourable ends; None if this cannot be flown."""
    likely_least: float
    """As if each were off by itself: the root of the sum of the squares of what each alone takes away."""
    likely_most: float
    """As `likely_least`, of what each alone adds."""
    most: float | None
    """All of them at their favourable ends."""

    def as_row(self) -> dict[str, Any]:
        """The interval in words with units."""
        return {
            "all_unfavourable": self.least,
            "likely_least": self.likely_least,
            "likely_most": self.likely_most,
            "all_favourable": self.most,
        }


@dataclass(frozen=True)
class EnergyStudy:
    """Everything that the energy balance says about a vehicle and a dive."""

    vehicle: Vehicle
    physics: Physics
    result: Endurance
    interval: Interval
    best: BestFlights
    sensitivities: tuple[Sensitivity, ...]
    target_days: float | None
    """Endurance that the specification asks for [days]."""
    gap: Gap | None
    """None where the target is met, or where there is none."""

    def as_json(self) -> dict[str, Any]:
        """The study in words with units, as `stommel endurance --json` prints it."""
        longest, farthest = self.best.longest, self.best.farthest
        return self.result.as_row() | {
            "interval_days": self.interval.as_row(),
            "target_days": self.target_days,
            "target_met": None if self.target_days is None else self.gap is None,
            "gap": self.gap.as_row() if self.gap is not None else None,
            "best_speed_for_endurance_m_s": longest.speed_m_s,
            "best_depth_for_endurance_m": longest.depth_m,
            "best_speed_for_range_m_s": farthest.speed_m_s,
            "best_depth_for_range_m": farthest.depth_m,
            "best_for_endurance": longest.as_row(),
            "best_for_range": farthest.as_row(),
            "sensitivity": [one.as_row() for one in self.sensitivities],
            "assumptions": [
                {"key": one.assumption.key, "value": one.assumption.value, "unit": one.assumption.unit,
                 "kind": one.assumption.origin.kind, "range": [one.low, one.high],
                 "range_stated": one.assumption.origin.range is not None, "why": one.assumption.origin.text}
                for one in self.sensitivities
                if one.uncertain
            ],
            "unstated_effects": list(MODEL_ASSUMPTIONS),
        }  # fmt: skip


MODEL_ASSUMPTIONS = (
    "Still water; of one density, unless an ocean is given. The best dives are sought in water of one density.",
    "Steady flight from turn to turn; in a turn, which lasts as long as its slower actuator, no depth is won or lost.",
    "The climb mirrors the dive: the same speed, and the same pitch upwards.",
    "At the surface the mass goes to its dive position, so that the tail with the antenna stands out of the water.",
    "Capacity does not depend on the current, and the cells neither warm themselves nor age.",
    "Drift at the surface is no range.",
)
"""What the model itself assumes, beside its numbers."""


@np.errstate(divide="ignore", invalid="ignore")  # what is infinite is refused by name
def energy_study(
    vehicle: Vehicle,
    *,
    speed_m_s: float | None = None,
    pitch_deg: float | None = None,
    depth_m: float | None = None,
    temperature_c: float | None = None,
    sea: Sea | None = None,
    physics: Physics = PAPER,
) -> EnergyStudy:
    """Answer the whole energy question for one dive.

    Parameters and errors are those of `endurance`, and `NoDiveError` where no flight at all is possible.
    """
    result = endurance(
        vehicle,
        speed_m_s=speed_m_s,
        pitch_deg=pitch_deg,
        depth_m=depth_m,
        temperature_c=temperature_c,
        sea=sea,
        physics=physics,
    )
    if sea is not None:
        vehicle = sea.trimmed(vehicle, physics, result.wanted.depth_m)
    spec = vehicle.description.specification
    target = spec.endurance_days if spec else None
    deepest = min(result.model.deepest_m, max(spec.depth_m if spec else 0.0, result.wanted.depth_m))
    best = best_flights(vehicle, result.model, physics=physics, deepest_m=deepest)
    found = sensitivity(vehicle, result, physics=physics, target_days=target)
    case = Case(vehicle, result.model, result.wanted, physics, result)
    interval = _interval(case, [one for one in found if one.uncertain])
    gap = _gap(case, found, target) if target is not None and result.days < target else None
    return EnergyStudy(vehicle, physics, result, interval, best, tuple(found), target, gap)


def _interval(case: Case, uncertain: list[Sensitivity]) -> Interval:
    """All uncertain numbers at one end each; and as if they were independent, their shares added in squares."""
    here = case.reached.days
    below = [here - min(one.days_at_low or 0.0, one.days_at_high or 0.0, here) for one in uncertain]
    above = [max(one.days_at_low or 0.0, one.days_at_high or 0.0, here) - here for one in uncertain]
    return Interval(
        least=_days({one.assumption.key: one.unfavourable for one in uncertain}, case),
        likely_least=max(0.0, here - hypot(*below)),
        likely_most=here + hypot(*above),
        most=_days({one.assumption.key: one.favourable for one in uncertain}, case),
    )


def _days(values: Mapping[str, float], case: Case) -> float | None:
    """Endurance with many numbers changed [days]; None where this cannot be flown."""
    for key, value in values.items():
        case = case.changed(key, value)
    try:
        return case.endurance().days
    except StommelError:
        return None


def _gap(case: Case, sensitivities: list[Sensitivity], target: float) -> Gap:
    stored = case.reached.stored
    allowed = stored.usable_j / (target * DAY) - stored.self_discharge_w
    steps: list[GapStep] = []
    days = case.reached.days
    for one in sensitivities:
        best = max(one.days_at_low or 0.0, one.days_at_high or 0.0)
        if days >= target or not (one.uncertain and best > case.reached.days + LEAST_SPAN_DAYS):
            continue
        case = case.changed(one.assumption.key, one.favourable)
        days = case.endurance().days
        steps.append(GapStep(one, one.favourable, days))
    return Gap(
        target_days=target,
        allowed_power_w=allowed,
        missing_power_w=case.reached.mean_power_w - allowed,
        steps=tuple(steps),
        closed=days >= target,
        alone=tuple(one for one in sensitivities if one.needed is not None),
    )
