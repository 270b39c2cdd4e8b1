"""The same circuit without losses, as the paper's AMESim model had it (section 4.3.2)."""

from collections.abc import Mapping
from types import MappingProxyType

from stommel.vehicle.schema import Engine

_NEARLY_NOTHING = 1e-5
"""MPa s/ml, ohm: below any effect, but not a division by zero."""

IDEAL: Mapping[str, Mapping[str, float]] = MappingProxyType(
    {
        "motors": {"driver_efficiency": 1.0, "no_load_current_a": 0.0, "resistance_ohm": _NEARLY_NOTHING},
        "gearboxes": {"efficiency": 1.0},
        "screws": {"efficiency": 1.0},
        "pumps": {"leakage_ml_s_mpa": 0.0, "friction_n_m": 0.0, "friction_share": 0.0, "damping_n_m_s": 0.0},
        "reservoirs": {"coulomb_n": 0.0, "stribeck_n": 0.0},
        "cylinders": {"coulomb_n": 0.0, "stribeck_n": 0.0, "viscous_n_s_m": 0.0},
        "lines": {"resistance_mpa_s_ml": _NEARLY_NOTHING, "loss_mpa_s2_ml2": 0.0},
        "check_valves": {"cracking_pressure_mpa": 0.0, "resistance_mpa_s_ml": _NEARLY_NOTHING},
    }
)
"""Values of the ideal parts. A free piston keeps its viscous friction, which damps it on the oil; so does the solenoid
valve, whose loss alone sets the time of a deflation."""


def ideal_engine(engine: Engine) -> Engine:
    """Return the circuit without leakage, friction and losses of lines and motor."""
    changed = {
        kind: tuple(part.model_copy(update=dict(values)) for part in getattr(engine, kind))
        for kind, values in IDEAL.items()
    }
    return engine.model_copy(update=changed)
