"""Limits that a vehicle begins with: what its file says it can do."""

from stommel.station.alarms.limits import Limit
from stommel.vehicle import Vehicle

_LOW_BATTERY, _RESERVE = 0.3, 0.1
"""Of the battery: when to go home, and what is left when nothing is known of its usable part."""
_LOOSE_PITCH_DEG = 10.0
"""Beyond the steepest pitch of the specification: overshoot."""


def default_limits(vehicle: Vehicle | None) -> list[Limit]:
    """Limits of the depth, the pitch and the battery, as far as the vehicle's file has them; none without a file."""
    low_battery = Limit(channel="battery_left_share", low=_LOW_BATTERY, hysteresis=0.02, delay_s=60.0)
    if vehicle is None:
        return [low_battery]
    file, limits = vehicle.description, [low_battery]
    if file.battery is not None and file.battery.usable_fraction is not None:
        reserve = max(_LOW_BATTERY, round(1.0 - file.battery.usable_fraction + _RESERVE, 3))
        limits = [low_battery.model_copy(update={"low": min(reserve, 0.9)})]
    rating = file.hull.depth_rating_m if file.hull is not None else None
    allowed = [depth for depth in (rating, file.specification and file.specification.depth_m) if depth]
    if allowed:
        limits.append(Limit(channel="depth_m", high=min(allowed), hysteresis=2.0, severity="critical"))
    if file.specification is not None:
        steep = min(file.specification.pitch_deg + _LOOSE_PITCH_DEG, 90.0)
        limits.append(Limit(channel="pitch_deg", low=-steep, high=steep, hysteresis=5.0, delay_s=20.0))
    return limits
