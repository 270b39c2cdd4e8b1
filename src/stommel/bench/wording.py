"""The engine's constants in words and in the units of a vehicle file."""

PARAMETER_WORDS: dict[str, tuple[str, str, float]] = {
    "torque_constant_n_m_a": ("torque constant", "mN m/A", 1e3),
    "resistance_ohm": ("terminal resistance", "ohm", 1.0),
    "no_load_current_a": ("no-load current", "A", 1.0),
    "gear_ratio": ("gear ratio", "1", 1.0),
    "gear_efficiency": ("gear efficiency", "1", 1.0),
    "displacement_m3_rev": ("pump displacement", "ml/r", 1e6),
    "leakage_m3_s_pa": ("pump leakage", "ml/(s MPa)", 1e12),
    "pump_friction_n_m": ("pump friction", "N m", 1.0),
    "pump_friction_share": ("pump friction share", "1", 1.0),
    "pump_damping_n_m_s": ("pump damping", "N m s", 1.0),
    "piston_area_m2": ("piston area", "cm2", 1e4),
    "cylinder_coulomb_n": ("cylinder friction", "N", 1.0),
    "cylinder_viscous_n_s_m": ("cylinder viscous friction", "N s/m", 1.0),
    "line_resistance_pa_s_m3": ("line resistance", "MPa s/ml", 1e-12),
    "line_loss_pa_s2_m6": ("turbulent line loss", "MPa s2/ml2", 1e-18),
    "cracking_pressure_pa": ("cracking pressure", "MPa", 1e-6),
}
"""Words, unit, and how many of the unit one SI unit is."""


def parameter_words(name: str) -> str:
    """Name of a constant for people; its own name where there are no words."""
    return PARAMETER_WORDS.get(name, (name, "SI", 1.0))[0]


def parameter_unit(name: str) -> tuple[str, float]:
    """Unit of a vehicle file, and the factor from SI to it."""
    _, unit, factor = PARAMETER_WORDS.get(name, (name, "SI", 1.0))
    return unit, factor
