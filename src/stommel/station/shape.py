"""How a glider looks, from its vehicle file: enough to draw it, not to build it."""

import math
from typing import Any

from stommel.vehicle import Vehicle

_NOSE_POINTS = 12
_NOSE_SHARE, _TAIL_SHARE = 0.15, 0.25
"""Of the length of the body, where the file has no wet nose and tail."""
_SPAN_SHARE, _CHORD_SHARE, _SWEEP_DEG = 0.75, 0.1, 30.0
"""Of a wing, by the length of the body: no file has its outline."""
_FINENESS = 7.0
"""Length by diameter, where the file has only one of them."""


def shape_of(vehicle: Vehicle) -> dict[str, Any]:
    """Return what a picture needs; lengths in metres, x forward of the centre of buoyancy.

    The profile is the radius of the body at places along it, from the tail to the nose: half an ellipse, a tube, a
    cone. Wings are where the file has their centre; their outline is a usual one, and `assumed` names it.
    """
    file = vehicle.description
    hull, specification = file.hull, file.specification
    assumed = ["outline of nose and tail"]
    diameter, length, nose_x = _body(vehicle)
    nose = hull.nose_length_m if hull is not None and hull.nose_length_m else _NOSE_SHARE * length
    tail = hull.tail_length_m if hull is not None and hull.tail_length_m else _TAIL_SHARE * length
    nose, tail = min(nose, 0.4 * length), min(tail, 0.5 * length)
    wing = None
    if file.wing is not None:
        assumed.append("outline of the wing")
        wing = {
            "x_m": -file.wing.aerodynamic_centre_aft_m, "span_m": _SPAN_SHARE * length,
            "chord_m": _CHORD_SHARE * length, "sweep_deg": _SWEEP_DEG,
        }  # fmt: skip
    rudder = None
    if file.rudder is not None:
        travel = file.actuators.rudder
        rudder = {
            "x_m": -file.rudder.aerodynamic_centre_aft_m, "z_m": -file.rudder.height_m, "height_m": 0.12 * length,
            "chord_m": 0.08 * length, "travel_deg": None if travel is None else travel.travel_deg,
        }  # fmt: skip
    mass, buoyancy = file.actuators.moving_mass, file.actuators.buoyancy
    bladder = None if buoyancy is None else buoyancy.bladder_position_m
    return {
        "name": file.name, "length_m": length, "diameter_m": diameter,
        "overall_length_m": None if specification is None else specification.overall_length_m,
        "profile": _profile(nose_x, length, 0.5 * diameter, nose, tail),
        "wings": wing, "rudder": rudder,
        "antenna_m": None if file.antenna is None else list(file.antenna.position_m),
        "moving_mass_range_m": None if mass is None else [each / 1e3 for each in mass.travel_mm],
        "moving_mass_neutral_m": file.moving_mass.neutral_position_m,
        "bladder_range_ml": None if buoyancy is None else list(buoyancy.volume_ml),
        "bladder_m": None if bladder is None else list(bladder),
        "assumed": assumed,
    }  # fmt: skip


def _body(vehicle: Vehicle) -> tuple[float, float, float]:
    """Diameter and length of the body, and where its nose is [m]."""
    hull, specification = vehicle.description.hull, vehicle.description.specification
    if hull is not None:
        length = hull.length_m + hull.nose_length_m + hull.tail_length_m
        return hull.outer_diameter_mm / 1e3, length, hull.nose_position_m + hull.nose_length_m
    if specification is not None:
        length = specification.body_length_m
        return specification.diameter_mm / 1e3, length, 0.5 * length
    return 1.5 / _FINENESS, 1.5, 0.75


def _profile(nose_x: float, length: float, radius: float, nose: float, tail: float) -> list[list[float]]:
    back, begin = nose_x - length, nose_x - nose
    points = [[back, 0.25 * radius], [back + tail, radius], [begin, radius]]
    for k in range(1, _NOSE_POINTS + 1):
        angle = 0.5 * math.pi * k / _NOSE_POINTS
        points.append([begin + nose * math.sin(angle), radius * math.cos(angle)])
    points[-1][1] = 0.0
    return [[round(x, 5), round(r, 5)] for x, r in points]
