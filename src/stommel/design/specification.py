"""Holds a vehicle against its specification (Table 3 of the paper)."""

from dataclasses import dataclass

from stommel.analysis import UnreachableFlightError, flight_envelope, trim_table
from stommel.design.endurance import endurance
from stommel.errors import StommelError
from stommel.vehicle import Physics, Vehicle


@dataclass(frozen=True)
class SpecificationRow:
    """One requirement beside what the vehicle has."""

    name: str
    unit: str
    required: float
    found: float | None
    """None where nothing in the file answers, and where there is none, which does not meet the requirement."""
    met: bool | None
    """None where it cannot be told."""
    how: str
    """Where the found number comes from."""


def specification_check(vehicle: Vehicle, physics: Physics) -> tuple[SpecificationRow, ...]:
    """Hold every requirement of the table [specification] against the vehicle; empty without that table."""
    d = vehicle.description
    spec = d.specification
    if spec is None:
        return ()
    rows: list[SpecificationRow] = []

    def at_most(name: str, unit: str, required: float, found: float | None, how: str) -> None:
        rows.append(SpecificationRow(name, unit, required, found, _compare(found, required, -1), how))

    def at_least(name: str, unit: str, required: float | None, found: float | None, how: str) -> None:
        if required is not None:
            rows.append(SpecificationRow(name, unit, required, found, _compare(found, required, +1), how))

    hull, engine, rudder = d.hull, d.actuators.buoyancy, d.actuators.rudder
    overall = hull.length_m + hull.nose_length_m + hull.tail_length_m if hull else None
    volume = engine.range_ml[1] - engine.range_ml[0] if engine else None
    at_most("Body length", "m", spec.body_length_m, hull.length_m if hull else None, "hull.length_m")
    at_most("Overall length", "m", spec.overall_length_m, overall, "hull with nose and tail")
    at_most("Diameter", "mm", spec.diameter_mm, hull.outer_diameter_mm if hull else None, "hull.outer_diameter_mm")
    at_most("Mass", "kg", spec.mass_kg, d.mass_kg, "sum of rigid body, moving mass and ballast")
    at_least("Oil volume", "ml", spec.oil_volume_ml, volume, "range of actuators.buoyancy.volume_ml")
    at_least("Depth", "m", spec.depth_m, hull.depth_rating_m if hull else None, "hull.depth_rating_m")
    for name, side, word in (("Pitch, diving", -1.0, "dive"), ("Pitch, climbing", +1.0, "climb")):
        rows.append(_searched(name, "deg", spec.pitch_deg, *_steepest(vehicle, side, word, physics)))
    at_least("Rudder", "deg", spec.rudder_deg, rudder.travel_deg if rudder else None, "actuators.rudder.travel_deg")
    if spec.speed_m_s is not None:
        rows.append(_searched("Speed", "m/s", spec.speed_m_s, *_greatest_speed(vehicle, physics)))
    at_least("Endurance", "days", spec.endurance_days, *_endurance(vehicle, physics))
    return tuple(rows)


def _compare(found: float | None, required: float, sign: int) -> bool | None:
    slack = 1e-9 * abs(required)
    return None if found is None else sign * (found - required) >= -slack


_Found = tuple[float | None, bool, str]
"""What a search found, whether it could be made at all, and where the number comes from or why there is none."""


def _searched(name: str, unit: str, required: float, found: float | None, asked: bool, how: str) -> SpecificationRow:
    """A requirement that a search answers: one that finds nothing is not met."""
    met = False if asked and found is None else _compare(found, required, +1)
    return SpecificationRow(name, unit, required, found, met, how)


def _steepest(vehicle: Vehicle, sign: float, word: str, physics: Physics) -> _Found:
    """Steepest pitch magnitude [deg] within the limits at the design speed."""
    spec = vehicle.description.specification
    if spec is None or spec.design_speed_m_s is None:
        return None, False, "needs specification.design_speed_m_s"

    def works(pitch: float) -> bool:
        try:
            (row,) = trim_table(vehicle, speeds_m_s=[speed], pitches_deg=[sign * pitch], physics=physics)
        except UnreachableFlightError:
            return False
        return not row.beyond

    speed = spec.design_speed_m_s
    grid = [float(pitch) for pitch in range(1, 90)]
    reached = [pitch for pitch in grid if works(pitch)]
    if not reached:
        return None, True, f"no {word} at {speed:g} m/s is within the limits of the file"
    low = max(reached)
    high = low + 1.0
    while high - low > 1e-3:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if works(middle) else (low, middle)
    return low, True, f"steepest reachable {word}"


def _greatest_speed(vehicle: Vehicle, physics: Physics) -> _Found:
    """Greatest speed [m/s] within the limits, diving at the design pitch."""
    spec = vehicle.description.specification
    if spec is None or spec.design_pitch_deg is None or vehicle.description.actuators.buoyancy is None:
        return None, False, "needs specification.design_pitch_deg and the table [actuators.buoyancy]"
    (row,) = flight_envelope(vehicle, pitches_deg=[-spec.design_pitch_deg], physics=physics)
    if row.fastest is None:
        return (
            None,
            True,
            f"no dive at -{spec.design_pitch_deg:g} deg is within the limits of the file: {row.limited_by}",
        )
    return row.fastest.V, True, "fastest at the design pitch"


def _endurance(vehicle: Vehicle, physics: Physics) -> tuple[float | None, str]:
    """Endurance [days] at the design flight and depth, and how it was found, or why not."""
    d = vehicle.description
    if d.battery is None or d.energy is None or not d.consumers:
        return None, "needs the tables [battery], [energy] and [[consumers]]"
    try:
        found = endurance(vehicle, physics=physics)
    except StommelError as error:
        return None, str(error)
    wanted = found.wanted
    return found.days, f"dives to {wanted.depth_m:g} m at {wanted.speed_m_s:g} m/s, pitch {wanted.pitch_deg:g} deg"
