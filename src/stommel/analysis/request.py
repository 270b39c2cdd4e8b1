"""What every question about steady flight checks before anything is computed."""

from math import isfinite

from stommel.errors import StommelError
from stommel.vehicle import Vehicle
from stommel.vehicle.missing_table import missing_table


class RequestError(StommelError):
    """A question with an impossible or missing number in it."""


def check_speed(speed_m_s: float) -> None:
    """Refuse a speed that no glider has."""
    if not (isfinite(speed_m_s) and 0.0 < speed_m_s <= 10.0):
        raise RequestError(f"speed = {speed_m_s:g} m/s: must be greater than 0 and at most 10 m/s")


def check_angle(name: str, angle_deg: float) -> None:
    """Refuse an angle at which the moving mass has no lever."""
    if not abs(angle_deg) < 90.0:
        raise RequestError(
            f"{name} = {angle_deg:g} deg: must be between -90 and 90 deg, both excluded: "
            "straight up or down the moving mass has no lever"
        )


def check_roll(vehicle: Vehicle) -> None:
    """Refuse a vehicle that cannot roll its moving mass."""
    d = vehicle.description
    if d.moving_mass.offset_m == 0.0:
        raise RequestError(f"{vehicle.name} cannot roll its moving mass: moving_mass.offset_m is 0")
    if d.actuators.roll is None:
        raise RequestError(
            f"{vehicle.name} cannot roll its moving mass; its file has no table [actuators.roll]; "
            f"{missing_table('actuators.roll')}"
        )
