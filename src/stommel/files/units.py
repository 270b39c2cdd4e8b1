"""The unit that a key says in its name: one table for files, messages, tables, pictures and results."""

UNITS = {
    # of length, area, volume, angle
    "m": "m", "mm": "mm", "km": "km", "ml": "ml", "l": "l", "m3": "m3", "deg": "degrees", "rad": "rad",
    # of time and motion; what is longer than a second is a word
    "s": "s", "ms": "ms", "minutes": "min", "hours": "h", "days": "days",
    "m_s": "m/s", "mm_s": "mm/s", "m_s2": "m/s2", "deg_s": "deg/s", "rad_s": "rad/s", "rpm": "r/min",
    "per_s": "1/s", "per_s2": "1/s2", "per_m": "1/m", "mm_per_deg": "mm/deg", "m_per_rad": "m/rad",
    # of mass, force, moment
    "kg": "kg", "kg_m3": "kg/m3", "kg_m2": "kg m2", "g_cm2": "g cm2", "n": "N", "n_m": "N m", "mn_m": "mN m",
    "n_s_m": "N s/m", "n_m_s": "N m s", "mn_m_a": "mN m/A",
    # of the water's forces, over the square of the speed
    "kg_m": "kg/m", "kg_s": "kg s", "coupling_kg_m": "kg m",
    "per_rad_kg": "kg per rad", "per_rad_kg_m": "kg/m per rad", "per_rad2_kg_m": "kg/m per rad2",
    # of pressure and flow
    "mpa": "MPa", "kpa": "kPa", "pa": "Pa", "dbar": "dbar", "per_pa": "1/Pa",
    "ml_s": "ml/s", "ml_min": "ml/min", "ml_r": "ml/r", "ml_s_m": "ml s/m", "ml_s_mpa": "ml/(s MPa)",
    "m3_s_m": "m3 s/m", "mpa_ml": "MPa/ml", "mpa_s_ml": "MPa s/ml", "mpa_s2_ml2": "MPa s2/ml2",
    # of electricity, energy and magnetic fields
    "a": "A", "ah": "A h", "v": "V", "ohm": "ohm", "w": "W", "wh": "W h", "j": "J", "ut": "uT",
    # of a log
    "mib": "MiB",
    # of the sea
    "c": "deg C", "per_k": "1/K", "psu": "psu", "g_kg": "g/kg", "conductivity_noise_s_m": "S/m", "sv": "Sv",
    # said in words
    "per_month": "1/month", "seconds_per_surfacing": "s",
}  # fmt: skip
"""How a key ends, and the unit that it means. Of several endings that fit the longest counts: a torque constant in
`mn_m_a` is no current. Where two units are spelt alike, the longer ending holds the key's own words."""

_LONGEST_FIRST = sorted(UNITS, key=len, reverse=True)


def unit_of(key: str) -> str | None:
    """Unit that the name of a key ends with, or None; an index at the end of a dotted key counts for its list."""
    name = next((part for part in reversed(key.split(".")) if not part.isdigit()), key)
    return next((UNITS[ending] for ending in _LONGEST_FIRST if f"_{name}".endswith(f"_{ending}")), None)


def counted(count: str | float, one: str, many: str = "") -> str:
    """A number with its noun: 1 day, 2 days, 11.7 days."""
    text = count if isinstance(count, str) else f"{count:.12g}"
    return f"{text} {one if text == '1' else many or f'{one}s'}"
