"""How much each number matters: elasticity of the endurance, its span, and the value that would reach a target."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import isfinite
from typing import Any

from stommel.design.endurance.endurance import Endurance
from stommel.design.endurance.varied import Case
from stommel.errors import StommelError
from stommel.files.units import unit_of
from stommel.machinery.power.actuator_models import ACTUATORS, PLAN_KEYS, Actuator
from stommel.vehicle import Physics, Provenance, Vehicle
from stommel.vehicle.schema import Consumer, EnergyPlan

STEP = 0.01
"""Relative step of an elasticity."""
SPAN_OF_SOURCED, SPAN_WITHOUT_RANGE = 0.10, 0.30
"""How far a number is varied that has a source, and one that has neither a source nor a range of its own."""
RANGE_OF_MODEL = (0.7, 1.3)
"""Factors between which the computed energy of an actuator is taken to lie; an assumption of the model."""
TEMPERATURE_SPAN = 5.0
"""How far the water's temperature is varied where its range is not stated [K]."""

CHOICES = frozenset(
    {"water.temperature_c", "energy.surface_session_s", "energy.dives_per_surfacing", "energy.upper_turn_m"}
)
"""Numbers that a mission chooses: they have a range, and are no uncertainty of the vehicle."""

_NUMBERS_OF_CONSUMERS = ("power_w", "standby_w", "duty", "sample_s", "sample_every_s", "seconds_per_surfacing")
_SHARES = {"usable_fraction", "self_discharge_per_month", "regulator_efficiency", "pump_efficiency",
           "pitch_drive_efficiency", "duty"}  # fmt: skip
_ACTUATOR_WORDS: dict[Actuator, str] = {"pump": "buoyancy engine", "pitch": "pitch drive", "rudder": "rudder drive"}


@dataclass(frozen=True)
class Assumption:
    """A number that the endurance rests on."""

    key: str
    """Dotted key of the vehicle file; `works.NAME` is a factor on an actuator's energy, `dive.NAME` is the flight."""
    what: str
    value: float
    unit: str
    origin: Provenance


@dataclass(frozen=True)
class Sensitivity:
    """What an assumption does to the endurance."""

    assumption: Assumption
    low: float
    """Lowest value tried."""
    high: float
    """Highest value tried."""
    days_at_low: float | None
    """Endurance there [days]; None if it cannot be flown."""
    days_at_high: float | None
    elasticity: float
    """Relative change of endurance over relative change of the number; for a temperature, per kelvin."""
    needed: float | None
    """Value that alone would reach the target; None if none does, or if the target is met."""

    @property
    def uncertain(self) -> bool:
        """Whether nobody knows the number: it is no printed source, no pilot's choice, and not the sea's."""
        return self.assumption.origin.kind not in ("source", "chosen") and self.assumption.key not in CHOICES

    @property
    def favourable(self) -> float:
        """End of the span at which the endurance is longer."""
        return self.low if (self.days_at_low or 0.0) > (self.days_at_high or 0.0) else self.high

    @property
    def unfavourable(self) -> float:
        """The other end."""
        return self.high if self.favourable == self.low else self.low

    @property
    def span_days(self) -> float:
        """Distance between the endurances at both ends [days]."""
        ends = [days for days in (self.days_at_low, self.days_at_high) if days is not None]
        return max(ends) - min(ends) if len(ends) > 1 else 0.0

    def as_row(self) -> dict[str, Any]:
        """The result in words with units."""
        a = self.assumption
        return {
            "key": a.key,
            "what": a.what,
            "value": a.value,
            "unit": a.unit,
            "kind": a.origin.kind,
            "range_stated": a.origin.range is not None,
            "origin": a.origin.text,
            "elasticity": self.elasticity,
            "low": self.low,
            "high": self.high,
            "endurance_days_at_low": self.days_at_low,
            "endurance_days_at_high": self.days_at_high,
            "needed_for_target": self.needed,
        }


def assumptions(vehicle: Vehicle, result: Endurance) -> Iterator[Assumption]:
    """Yield every number that the endurance rests on, with its origin."""
    model, wanted = result.model, result.wanted

    def of(key: str, what: str, value: float) -> Assumption:
        return Assumption(key, what, float(value), unit_of(key) or "1", vehicle.provenance_of(key))

    chosen = Provenance("chosen", "the dive that is asked about")
    yield Assumption("dive.speed_m_s", "speed along the path", wanted.speed_m_s, "m/s", chosen)
    yield Assumption("dive.pitch_deg", "pitch of the dive", wanted.pitch_deg, "degrees", chosen)
    yield Assumption("dive.depth_m", "depth of the dive", wanted.depth_m, "m", chosen)
    yield of("hydrodynamics.drag_kg_m", "drag at zero angle of attack", vehicle.description.hydrodynamics.drag_kg_m)
    yield of("water.temperature_c", "temperature of the water", model.temperature_c)
    for name in ("capacity_ah", "voltage_v", "usable_fraction", "self_discharge_per_month", "internal_resistance_ohm"):
        if value := getattr(model.battery, name):
            yield of(f"battery.{name}", f"battery: {_words(name)}", value)
    described = model.actuators.described
    unused = {"slowest_speed_m_s", *(("upper_turn_m",) if model.plan.dives_per_surfacing == 1 else ())}.union(
        *(PLAN_KEYS[actuator] for actuator in described)
    )
    for name in EnergyPlan.model_fields:
        value = getattr(model.plan, name)
        if value and name not in unused:
            yield of(f"energy.{name}", _words(name), value)
    for actuator in ACTUATORS:
        if actuator in described:
            origin = Provenance("derived", f"computed from {getattr(model.works, actuator).origin}", RANGE_OF_MODEL)
            what = f"{_ACTUATOR_WORDS[actuator]}: factor on its energy"
            yield Assumption(f"works.{actuator}", what, 1.0, "1", origin)
    for i, consumer in enumerate(model.consumers):
        yield from (
            of(f"consumers.{i}.{name}", f"{consumer.name}: {_words(name)}", value)
            for name, value in _stated(consumer)
            if value
        )


def _stated(consumer: Consumer) -> Iterator[tuple[str, float | None]]:
    return ((name, getattr(consumer, name)) for name in _NUMBERS_OF_CONSUMERS)


def _words(name: str) -> str:
    """Key without its unit, as words."""
    for suffix in ("_m_s", "_ah", "_deg", "_mm", "_ml", "_v", "_w", "_s", "_m", "_j"):
        name = name.removesuffix(suffix)
    return name.replace("_", " ")


def sensitivity(
    vehicle: Vehicle, result: Endurance, *, physics: Physics, target_days: float | None = None
) -> list[Sensitivity]:
    """Vary every assumption alone, about its value; the ones with the widest span of endurance come first.

    A number that is derived or assumed is varied over its own range; without one by 30 %, the temperature by 5 K. A
    number with a source is varied by 10 %. Of a share above one half, such as an efficiency, the remainder is varied.

    Parameters
    ----------
    target_days
        Endurance to reach [days]; where it is missed, the value of each assumption that alone would reach it is sought.
    """
    missed = target_days is not None and result.days < target_days
    found, case = [], Case(vehicle, result.model, result.wanted, physics, result)
    for assumption in assumptions(vehicle, result):
        days = _Varied(case, assumption.key)
        slope = _elasticity(days, assumption, result.days)
        low, high = _span(assumption, result.model.deepest_m)
        found.append(
            Sensitivity(
                assumption=assumption,
                low=low,
                high=high,
                days_at_low=days(low),
                days_at_high=days(high),
                elasticity=slope,
                needed=_needed(days, assumption, slope, result, target_days) if missed and target_days else None,
            )
        )
    return sorted(found, key=lambda one: -one.span_days)


class _Varied:
    """Endurance [days] as a function of one number; None where it cannot be flown."""

    def __init__(self, case: Case, key: str) -> None:
        self.case, self.key = case, key

    def __call__(self, value: float) -> float | None:
        try:
            days = self.case.changed(self.key, value).endurance().days
        except StommelError:
            return None
        return days if isfinite(days) else None


def _span(assumption: Assumption, deepest_m: float) -> tuple[float, float]:
    """Ends between which a number is varied: its own range, or a share of it."""
    key, value = assumption.key, assumption.value
    if assumption.origin.range is not None:
        return assumption.origin.range
    name = key.rsplit(".", 1)[-1]
    if name == "temperature_c":
        return value - TEMPERATURE_SPAN, value + TEMPERATURE_SPAN
    if name == "dives_per_surfacing":
        return max(1.0, value - 1.0), value + 1.0
    span = SPAN_OF_SOURCED if assumption.origin.kind in ("source", "chosen") else SPAN_WITHOUT_RANGE
    # of an efficiency it is the loss that is uncertain
    change = span * (1.0 - value if name in _SHARES and value > 0.5 else abs(value))
    low, high = value - change, value + change
    return low, min(high, deepest_m) if key == "dive.depth_m" else high


def _elasticity(days: Callable[[float], float | None], assumption: Assumption, here: float) -> float:
    """d ln(endurance) / d ln(value) by a difference about the value; per kelvin for a temperature."""
    value = assumption.value
    per_kelvin = assumption.key == "water.temperature_c"
    step = 1.0 if per_kelvin else STEP * abs(value)
    below, above = days(value - step), days(value + step)
    width = (above is not None) + (below is not None)
    if not width:
        return 0.0
    change = ((here if above is None else above) - (here if below is None else below)) / here
    sign = 1.0 if value >= 0.0 else -1.0
    return change / width if per_kelvin else sign * change / (width * STEP)


def _needed(
    days: Callable[[float], float | None], assumption: Assumption, slope: float, result: Endurance, target: float
) -> float | None:
    """Value between the present one and the best allowed that alone gives the target; None if there is none."""
    if slope == 0.0 or assumption.key == "battery.voltage_v":  # the machines are made for the voltage
        return None
    low, high = _allowed(assumption, result)
    rising = slope > 0.0 if assumption.value > 0.0 else slope < 0.0
    best = high if rising else low
    reached = days(best)
    if reached is None or reached < target:
        return None
    from scipy.optimize import brentq  # noqa: PLC0415 - slow to import, seldom wanted

    def short(value: float) -> float:
        """Relative time that is missing; what cannot be flown lasts no time."""
        return target / (days(value) or 1e-3) - 1.0

    found: float = brentq(short, assumption.value, best, rtol=1e-9)
    return found


def _allowed(assumption: Assumption, result: Endurance) -> tuple[float, float]:
    """Values that the search for a target may take."""
    key, value = assumption.key, assumption.value
    name = key.rsplit(".", 1)[-1]
    least = result.model.plan.slowest_speed_m_s
    ranges = {
        "dive.speed_m_s": (min(least, value), value),
        "dive.pitch_deg": (value, -5.0),
        "dive.depth_m": (value, result.model.deepest_m),
        "water.temperature_c": (value, 30.0),
        "energy.dives_per_surfacing": (value, 20.0),
    }
    if key in ranges:
        return ranges[key]
    least_share = 1e-6 if name in {"sample_every_s", "drag_kg_m", "capacity_ah", "voltage_v"} else 0.0
    most = 1.0 if name in _SHARES else 5.0 * value
    return (max(least_share, 1e-3 if name.endswith("efficiency") or name == "usable_fraction" else 0.0), most)
