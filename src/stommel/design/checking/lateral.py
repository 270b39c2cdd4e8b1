"""Lateral coefficients against the geometry of the vehicle (docs/theory/hydrodynamics).

None of these says what a coefficient is. Each says that two numbers of the file cannot both be those of one body.
"""

from collections.abc import Iterator
from math import pi

from stommel.design.named_warning import NamedWarning
from stommel.vehicle import Vehicle

LONGEST_REACH_M = 1.5
"""From the centre to the end of the longest gliders, where the file gives no length."""
DEFAULT_SPEED_M_S = 0.4
DAMPING_SHARES = (0.3, 15.0)
"""Yaw damping over that of the surface which the yaw moment implies. Hulls damp too, so the upper end is far off."""
BLADE_SHARES = (0.4, 1.6)
"""Rudder slope over that of its blade: gap, boundary layer and hull leave 0.5 to 1; the hull's carry-over adds some."""
SPAN_CHORDS = (0.8, 8.0)
"""Span over chord of blades that are built."""


def lateral_plane(vehicle: Vehicle) -> Iterator[NamedWarning]:
    """Lever, side force, yaw damping and rudder, each where the file has both sides of the comparison."""
    if next(vehicle.description.unknown_lateral(), None) is None:
        yield from _lever(vehicle)
        yield from _side_force(vehicle)
        yield from _yaw_damping(vehicle)
    yield from _rudder_slope(vehicle)


def reach(vehicle: Vehicle) -> tuple[float, str]:
    """Greatest distance from the centre of buoyancy to an end of the vehicle [m], and where it is read."""
    d = vehicle.description
    if d.hull is not None:
        nose = d.hull.nose_position_m + d.hull.nose_length_m
        tail = d.hull.nose_position_m - d.hull.length_m - d.hull.tail_length_m
        return max(nose, -tail), "the vehicle reaches"
    if d.specification is not None:
        return 0.5 * d.specification.overall_length_m, "half of specification.overall_length_m is"
    return LONGEST_REACH_M, "the file has no length, and half of the longest gliders is"


def _lever(vehicle: Vehicle) -> Iterator[NamedWarning]:
    h = vehicle.description.hydrodynamics
    S, N = h.side_force_per_rad_kg_m, h.yaw_moment_per_rad_kg
    assert S is not None
    assert N is not None
    most, where = reach(vehicle)
    if abs(N) > S * most:
        lever = (
            f"{abs(N) / S:.3g} m from the centre of buoyancy" if S > 0.0 else "infinitely far away, as there is none"
        )
        yield NamedWarning(
            "lateral_lever",
            f"hydrodynamics.yaw_moment_per_rad_kg = {N:g} over side_force_per_rad_kg_m = {S:g} means a side force that "
            f"acts {lever}; {where} {most:.3g} m",
        )


def _side_force(vehicle: Vehicle) -> Iterator[NamedWarning]:
    """A body of revolution has the same slope sideways as in lift; what the wing does not carry is the body's."""
    d = vehicle.description
    if d.wing is None:
        return
    S, body = d.hydrodynamics.side_force_per_rad_kg_m, d.hydrodynamics.lift_per_rad_kg_m - d.wing.lift_per_rad_kg_m
    assert S is not None
    if body > S:
        yield NamedWarning(
            "side_force_small",
            f"hydrodynamics.side_force_per_rad_kg_m = {S:g}; without its wing the vehicle lifts {body:g} kg/m per rad, "
            "and a round hull has the same slope sideways, before any fin",
        )


def _yaw_damping(vehicle: Vehicle) -> Iterator[NamedWarning]:
    """A surface at the lever l that gives the yaw moment N_beta damps with N_beta l / V."""
    d = vehicle.description
    N, damping = d.hydrodynamics.yaw_moment_per_rad_kg, d.hydrodynamics.yaw_damping_kg_s
    assert N is not None
    assert damping is not None
    speed = (d.specification.design_speed_m_s if d.specification else None) or DEFAULT_SPEED_M_S
    lever = d.rudder.aerodynamic_centre_aft_m if d.rudder is not None else reach(vehicle)[0]
    implied = N * lever / speed
    if implied <= 0.0:
        return
    share = -damping / implied
    if not DAMPING_SHARES[0] <= share <= DAMPING_SHARES[1]:
        yield NamedWarning(
            "yaw_damping",
            f"hydrodynamics.yaw_damping_kg_s = {damping:g} is {share:.2g} of what a fin {lever:.3g} m aft that gives "
            f"yaw_moment_per_rad_kg = {N:g} brings by itself at {speed:g} m/s, {-implied:.3g}",
        )


def _rudder_slope(vehicle: Vehicle) -> Iterator[NamedWarning]:
    """The slope in [rudder] against the blade in [drives.rudder]."""
    d = vehicle.description
    if d.rudder is None or d.drives is None or d.drives.rudder is None:
        return
    chord, stated, rho = d.drives.rudder.chord_mm / 1e3, d.rudder.side_force_per_rad_kg_m, d.water.density_kg_m3
    if d.drives.rudder.span_mm is not None:
        span = d.drives.rudder.span_mm / 1e3
        blade = blade_slope(rho, chord, span)
        if not BLADE_SHARES[0] <= stated / blade <= BLADE_SHARES[1]:
            yield NamedWarning(
                "rudder_slope",
                f"rudder.side_force_per_rad_kg_m = {stated:g}; a blade of {chord * 1e3:g} by {span * 1e3:g} mm in "
                f"[drives.rudder] has about {blade:.3g} kg/m per rad",
            )
        return
    low, high = (blade_slope(rho, chord, share * chord) for share in SPAN_CHORDS)
    if not low <= stated <= high:
        yield NamedWarning(
            "rudder_slope",
            f"rudder.side_force_per_rad_kg_m = {stated:g}; blades of drives.rudder.chord_mm = {chord * 1e3:g} have "
            f"{low:.3g} to {high:.3g} kg/m per rad with spans of {SPAN_CHORDS[0]:g} to {SPAN_CHORDS[1]:g} chords",
        )


def blade_slope(rho: float, chord: float, span: float) -> float:
    """Side force per angle and V^2 of a blade on a hull [kg/m], by Prestero's (2001) fin formula.

    c_La = 1 / (1 / (2 0.9 pi) + 1 / (pi AR_e)), with AR_e = 2 span / chord, for the hull mirrors the blade.
    """
    c_La = 1.0 / (1.0 / (1.8 * pi) + 1.0 / (2.0 * pi * span / chord))
    return 0.5 * rho * chord * span * c_La
