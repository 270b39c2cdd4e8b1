"""What a form needs of each value of a plan: words, unit, range, what it is if left out."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, get_args

from annotated_types import Ge, Le
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from stommel.control.orders_tables import SAMPLES
from stommel.control.vehicle_limits import BEYOND_RATING, VehicleLimits
from stommel.files.docstrings import attribute_docstrings
from stommel.files.ranges import ZeroOr
from stommel.files.table_keys import models_in
from stommel.files.units import unit_of
from stommel.plans.plan import StationPlan

OWN = "sampling.every_s"
"""Key that the vehicle's configuration has a value for where a plan has none."""
LISTS = ("waypoints", "geofence")
"""Keys of places, which are drawn on a map."""


@dataclass(frozen=True)
class PlanField:
    """One value of a plan."""

    key: str
    """Dotted."""
    words: str
    unit: str
    low: float | None
    high: float | None
    or_zero: bool
    """Whether 0 is allowed beside the range."""
    choices: tuple[str, ...]
    several: bool
    """Whether it is a list of them."""
    required: bool
    default: Any
    """What it is if left out; null: it follows from others, or is the vehicle's own affair."""


def plan_fields(limits: VehicleLimits | None = None) -> list[PlanField]:
    """Every value of a plan but the places, in the order of the file; narrowed to what a vehicle can do."""
    highest = {} if limits is None else _highest(limits)
    return [
        replace(field, high=min(highest[field.key], field.high)) if field.key in highest and field.high else field
        for field in _fields(StationPlan, "")
        if not field.key.startswith(LISTS)
    ]


def _highest(limits: VehicleLimits) -> dict[str, float]:
    """Greatest value of some fields, by the limits that the vehicle's software holds its orders against."""
    ballast = limits.ballast_ml
    found = {
        "dives.depth_m": limits.depth_rating_m,
        "dives.turn_depth_m": limits.depth_rating_m,
        OWN: SAMPLES[1],
        "dives.ballast_ml": 0.5 * (ballast[1] - ballast[0]),
        "surface.ballast_ml": ballast[1],
        "abort.depth_m": BEYOND_RATING * limits.depth_rating_m,
        "heading_control.limit_deg": limits.steering_deg,
    }
    if limits.internal_pressure_kpa is not None:
        found["abort.internal_pressure_kpa"] = limits.internal_pressure_kpa
    return found


def _fields(model: type[BaseModel], above: str) -> Iterator[PlanField]:
    words = attribute_docstrings(model)
    for name, field in model.model_fields.items():
        inside = models_in(field.annotation)
        if inside:
            yield from _fields(inside[0], f"{above}{name}.")
        else:
            yield _field(f"{above}{name}", words.get(name, ""), field)


def _field(key: str, words: str, field: FieldInfo) -> PlanField:
    said = [*field.metadata, *_said(field.annotation)]
    zero = next((one for one in said if isinstance(one, ZeroOr)), None)
    low = next((one.ge for one in said if isinstance(one, Ge)), None) if zero is None else zero.low
    high = next((one.le for one in said if isinstance(one, Le)), None) if zero is None else zero.high
    choices = tuple(_choices(field.annotation))
    default = (
        None if field.is_required() or key == OWN else field.get_default(call_default_factory=True, validated_data={})
    )
    return PlanField(
        key, words, unit_of(key) or "", _number(low), _number(high), zero is not None, choices,
        isinstance(default, tuple), field.is_required(), list(default) if isinstance(default, tuple) else default,
    )  # fmt: skip


def _said(annotation: Any) -> Iterator[Any]:
    """What an annotation says of its value, however deep in alternatives."""
    for argument in get_args(annotation):
        for extra in getattr(argument, "__metadata__", ()):
            yield from getattr(extra, "metadata", [extra])
        yield from _said(argument)


def _choices(annotation: Any) -> Iterator[str]:
    for argument in get_args(annotation):
        if isinstance(argument, str):
            yield argument
        else:
            yield from _choices(argument)


def _number(limit: Any) -> float | None:
    return float(limit) if isinstance(limit, int | float) else None
