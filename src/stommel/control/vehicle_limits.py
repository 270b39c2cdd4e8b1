"""What a vehicle can do, and which missions it therefore refuses, however whole they arrive."""

from collections.abc import Iterator
from math import degrees, isfinite, isnan
from typing import Annotated, NamedTuple, Self

from pydantic import Field, model_validator

from stommel.control.orders import Orders
from stommel.control.orders_file import OrdersHeader
from stommel.control.orders_tables import SAMPLES
from stommel.errors import Problem
from stommel.files.fields import Table, ordered
from stommel.files.ranges import Depth, Position, SignedVolume, between

BEYOND_RATING = 1.1
"""How far beyond the rating of the hull a dive may be broken off: plans have it so for a dive to the rating itself."""
_SLACK = 1e-9
"""Share by which a limit may be passed: numbers are sums of others."""


class VehicleLimits(Table):
    """Limits of a vehicle, as the configuration of its software states them; what is left out limits nothing."""

    vehicle_sha256: Annotated[str, Field(pattern="^[0-9a-f]{64}$")]
    """Hash of the vehicle's file: missions are made for it alone."""
    ballast_ml: tuple[SignedVolume, SignedVolume]
    """Least and greatest volume of the buoyancy engine."""
    moving_mass_mm: tuple[Position, Position]
    """Aft and forward limit switch of the moving mass."""
    steering_deg: Annotated[float, between(0, 180)]
    """Greatest angle of the rudder, or of the rolling mass, to either side."""
    depth_rating_m: Depth
    """That the hull is rated for."""
    internal_pressure_kpa: Annotated[float, between(0.1, 1000)] | None = None
    """Greatest pressure in the hull, absolute, at which an alarm makes sense: that of air at the surface."""
    battery_wh: Annotated[float, between(0.1, 1e7)] | None = None
    """Energy of the charged battery."""

    @model_validator(mode="after")
    def _are_intervals(self) -> Self:
        ordered("ballast_ml", self.ballast_ml)
        ordered("moving_mass_mm", self.moving_mass_mm)
        return self


class _Limit(NamedTuple):
    """One number of the orders, and what it may be."""

    key: str
    value: float
    low: float
    high: float
    unit: str
    source: str
    """What limits it."""


def refusals(orders: Orders, header: OrdersHeader, limits: VehicleLimits, origin: str) -> list[Problem]:
    """Everything in a mission that this vehicle cannot do or must not; `origin` names the mission in messages."""
    found = []
    if header.vehicle_sha256 != limits.vehicle_sha256:
        text = (
            f"vehicle_sha256 = {header.vehicle_sha256[:12]}...: the orders are for another vehicle than "
            f"{limits.vehicle_sha256[:12]}..."
        )
        found.append(Problem(origin, "vehicle_sha256", text))
    for limit in (*_limits(orders, limits), *_sampling(header)):
        slack = _SLACK * max(abs(limit.low), abs(limit.high))
        if not limit.low - slack <= limit.value <= limit.high + slack:
            text = (
                f"{limit.key} = {limit.value:.6g}: must be between {limit.low:.6g} and {limit.high:.6g} {limit.unit}, "
                f"{limit.source}"
            )
            found.append(Problem(origin, limit.key, text))
    return found


def _sampling(header: OrdersHeader) -> Iterator[_Limit]:
    if header.sample_every_s is not None:
        low, high = SAMPLES
        yield _Limit("sample_every_s", header.sample_every_s, low, high, "s", "what the CTD can be told")


def _limits(orders: Orders, limits: VehicleLimits) -> Iterator[_Limit]:
    dives, alarms = orders.dives, orders.alarms
    for when in ("dive", "climb", "surface", "drift"):
        volume = float(getattr(dives, f"V_b_{when}"))
        low, high = (volume_ml / 1e6 for volume_ml in limits.ballast_ml)
        yield _Limit(f"dives.ballast_{when}_m3", volume, low, high, "m3", "what the buoyancy engine moves")
    for when in ("drift", "surface"):
        place = float(getattr(dives, f"r_px_{when}"))
        low, high = (position_mm / 1e3 for position_mm in limits.moving_mass_mm)
        if not isnan(place):  # where the ascent left it
            yield _Limit(f"dives.moving_mass_{when}_m", place, low, high, "m", "between the limit switches")
    steering = degrees(orders.laws.heading.limit)
    yield _Limit("heading_control.limit", steering, 0.0, limits.steering_deg, "deg", "what the steering reaches")
    rating = limits.depth_rating_m
    yield _Limit("dives.depth_m", dives.depth, 0.0, rating, "m", "what the hull is rated for")
    deepest = BEYOND_RATING * rating
    yield _Limit("dives.abort_depth_m", dives.abort_depth, dives.depth, deepest, "m", "dives.depth_m and 1.1 ratings")
    yield _Limit("dives.surfaced_depth_m", dives.shallow_depth, 0.0, dives.depth, "m", "dives.depth_m")
    if dives.dives_per_surfacing > 1.0:
        yield _Limit("dives.turn_depth_m", dives.turn_depth, 0.0, dives.depth, "m", "dives.depth_m")
    if isfinite(alarms.energy) and limits.battery_wh is not None:
        yield _Limit("alarms.energy_j", alarms.energy, 0.0, limits.battery_wh * 3600.0, "J", "what the battery holds")
    if isfinite(alarms.internal_pressure) and limits.internal_pressure_kpa is not None:
        most = limits.internal_pressure_kpa * 1e3
        yield _Limit("alarms.internal_pressure_pa", alarms.internal_pressure, 0.0, most, "Pa", "air at the surface")
