"""Units that ocean files write, and their factor and summand to SI."""

import re

import numpy as np

_ANGLES = [
    f"degree{plural}{joint}{way}"
    for plural in ("", "s")
    for joint, ways in (("_", ("north", "east", "n", "e")), ("", ("n", "e")))
    for way in ways
]
"""As CF and UDUNITS spell them: degrees_north, degree_N, degreesN and so on."""
NORTH = tuple(unit for unit in _ANGLES if unit.endswith(("north", "n")))
EAST = tuple(unit for unit in _ANGLES if unit.endswith(("east", "e")))

UNITS: dict[str, dict[str, tuple[float, float]]] = {
    "temperature": {
        **dict.fromkeys(
            ("degc", "celsius", "degree_c", "degrees_c", "deg_c", "c", "degree_celsius", "degrees_celsius",
             "deg celsius", "degrees celsius", "degree celsius", "deg c", "degrees c", "degreec", "degreesc", "°c"),
            (1.0, 0.0),
        ),
        **dict.fromkeys(("k", "kelvin", "degk", "degree_k", "degrees_k", "deg_k", "degrees_kelvin"), (1.0, -273.15)),
    },
    "salinity": {
        **dict.fromkeys(
            ("1", "1e-3", "1e-03", "0.001", "10-3", "psu", "pss-78", "pss", "g kg-1", "g/kg", "ppt", "‰"), (1.0, 0.0)
        ),
        "kg kg-1": (1000.0, 0.0), "kg/kg": (1000.0, 0.0),
    },
    "velocity": {
        **dict.fromkeys(("m s-1", "m/s", "ms-1"), (1.0, 0.0)),
        **dict.fromkeys(("cm s-1", "cm/s"), (0.01, 0.0)),
        **dict.fromkeys(("mm s-1", "mm/s"), (0.001, 0.0)),
    },
    "length": {"m": (1.0, 0.0), "km": (1000.0, 0.0), "cm": (0.01, 0.0)},
    "length_of_map": {"m": (1.0, 0.0), "km": (1000.0, 0.0), "cm": (0.01, 0.0)},
    "angle": {
        **dict.fromkeys(("degree", "degrees", "deg", *_ANGLES), (np.pi / 180.0, 0.0)),
        "radian": (1.0, 0.0), "radians": (1.0, 0.0), "rad": (1.0, 0.0),
    },
}  # fmt: skip
"""Factor and summand to SI (temperature: deg C) by quantity and unit."""

QUANTITY_OF = {
    "temperature": "temperature", "salinity": "salinity", "current_east": "velocity", "current_north": "velocity",
    "current_x": "velocity", "current_y": "velocity", "bottom": "length", "depth": "length", "latitude": "angle",
    "longitude": "angle", "angle": "angle",
}  # fmt: skip
"""What users may state the unit of, by what it is."""


def plain(unit: str) -> str:
    """Write a unit the short way: `meter second-1` is `m s-1`."""
    text = unit.lower().replace("**", "").replace("^", "").replace(".", " " if not re.search(r"\d\.\d", unit) else ".")
    text = re.sub(r"\bcentimet(?:er|re)s?\b", "cm", text)
    text = re.sub(r"\bkilomet(?:er|re)s?\b", "km", text)
    text = re.sub(r"\bmet(?:er|re)s?\b", "m", text)
    text = re.sub(r"\bsec(?:ond)?s?(?=\b|-)", "s", text)
    return re.sub(r"\s+", " ", text).strip()
