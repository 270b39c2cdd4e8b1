"""Sizes, masses and depths of the file against its specification and against each other."""

from collections.abc import Iterator
from math import pi

from stommel.design.named_warning import NamedWarning
from stommel.vehicle import Vehicle

SLACK = 1e-6
"""Relative difference that counts as none."""
FULLNESS = 0.75
"""Share of a plain tube that a hull with tapered ends displaces at the least."""
PRESSURE_SLACK = 0.05
"""Relative shortfall of the design pressure below the weight of the water that is worth a warning."""


def sizes(vehicle: Vehicle) -> Iterator[NamedWarning]:
    """Length, diameter, mass, oil and rudder against the specification; the hull's volume against the mass."""
    d = vehicle.description
    spec, hull, engine = d.specification, d.hull, d.actuators.buoyancy
    pairs: list[tuple[str, float, float | None, str, int]] = []
    if spec is not None:
        pairs.append(("mass_kg", d.mass_kg, spec.mass_kg, "rigid body, moving mass and ballast have {:g} kg", -1))
        if hull is not None:
            overall = hull.nose_length_m + hull.length_m + hull.tail_length_m
            pairs += [
                ("body_length_m", hull.length_m, spec.body_length_m, "hull.length_m = {:g}", -1),
                ("overall_length_m", overall, spec.overall_length_m, "nose, hull and tail are {:g} m long", -1),
                ("diameter_mm", hull.outer_diameter_mm, spec.diameter_mm, "hull.outer_diameter_mm = {:g}", -1),
            ]
        if engine is not None:
            volume = engine.volume_ml[1] - engine.volume_ml[0]
            pairs.append(("oil_volume_ml", volume, spec.oil_volume_ml, "actuators.buoyancy.volume_ml spans {:g} ml", 1))
        if d.actuators.rudder is not None:
            travel = d.actuators.rudder.travel_deg
            pairs.append(("rudder_deg", travel, spec.rudder_deg, "actuators.rudder.travel_deg = {:g}", 1))
    for key, found, wanted, words, sign in pairs:
        if wanted is not None and sign * (found - wanted) < -SLACK * wanted:
            bound = "at least" if sign > 0 else "at most"
            yield NamedWarning(
                "specification_not_met", f"{words.format(found)}; specification.{key} asks {bound} {wanted:g}"
            )
    yield from _hull_volume(vehicle)


def _hull_volume(vehicle: Vehicle) -> Iterator[NamedWarning]:
    """A sealed hull that displaces more than the whole vehicle weighs leaves nothing to sink with, tapered or not."""
    d = vehicle.description
    if d.hull is None or d.parts:  # with parts the budget sums volumes one by one
        return
    engine = d.actuators.buoyancy
    least = engine.volume_m3[0] if engine is not None else 0.0
    volume = FULLNESS * pi / 4 * (d.hull.outer_diameter_mm / 1e3) ** 2 * d.hull.length_m
    surplus = d.water.density_kg_m3 * (volume + least) - d.mass_kg
    if surplus > 0.0:
        yield NamedWarning(
            "does_not_sink",
            f"a sealed hull of this length and diameter displaces {volume * 1e3:.2f} l at the least; with "
            f"{d.mass_kg:g} kg and the least ballast volume the vehicle is {surplus:.2f} kg too light for water of "
            f"{d.water.density_kg_m3:g} kg/m3",
        )


def depths(vehicle: Vehicle) -> Iterator[NamedWarning]:
    """The specified depth against the rating, and the design pressure against the weight of the water."""
    d = vehicle.description
    hull, spec = d.hull, d.specification
    if hull is None or hull.depth_rating_m is None:
        return
    if spec is not None and spec.depth_m > hull.depth_rating_m * (1.0 + SLACK):
        yield NamedWarning(
            "depth_beyond_rating",
            f"specification.depth_m = {spec.depth_m:g} is deeper than hull.depth_rating_m = {hull.depth_rating_m:g}",
        )
    if hull.design_pressure_mpa is not None:
        weight = d.water.density_kg_m3 * d.water.gravity_m_s2 * hull.depth_rating_m / 1e6
        if hull.design_pressure_mpa < weight * (1.0 - PRESSURE_SLACK):
            yield NamedWarning(
                "design_pressure_low",
                f"hull.design_pressure_mpa = {hull.design_pressure_mpa:g}; {hull.depth_rating_m:g} m of the reference "
                f"water weigh {weight:.3g} MPa",
            )
