"""Speed and pitch where a verb is given none: those of the vehicle file's [specification]."""

from typing import TYPE_CHECKING

from stommel.errors import StommelError

if TYPE_CHECKING:
    from stommel.vehicle import Vehicle


def design_speed(vehicle: "Vehicle", given: float | None, option: str = "--speed") -> float:
    """Speed along the path [m/s]: what was given, or the specification's.

    Raises
    ------
    StommelError
        There is neither.
    """
    spec = vehicle.description.specification
    return _chosen(vehicle, given, spec.design_speed_m_s if spec else None, option, "design_speed_m_s")


def design_pitch(vehicle: "Vehicle", given: float | None, option: str = "--pitch") -> float:
    """Pitch [deg], negative in a dive: what was given, or the specification's, whose magnitude the file has.

    Raises
    ------
    StommelError
        There is neither.
    """
    spec = vehicle.description.specification
    asked = spec.design_pitch_deg if spec else None
    return _chosen(vehicle, given, None if asked is None else -asked, option, "design_pitch_deg")


def _chosen(vehicle: "Vehicle", given: float | None, asked: float | None, option: str, key: str) -> float:
    if given is not None:
        return given
    if asked is None:
        raise StommelError(f"{vehicle.name}: give {option}; its file has no specification.{key}")
    return asked
