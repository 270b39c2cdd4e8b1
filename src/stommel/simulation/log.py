"""What a mission writes down: rows over time, samples, surfacings, events."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.control.dive_cycle import EVENTS
from stommel.simulation.plant.parameters import CONSUMERS


def _numbers(*names: str) -> list[tuple[str, str]]:
    return [(name, "f8") for name in names]


ROW = np.dtype(
    [
        *_numbers(
            "time", "latitude", "longitude", "depth", "roll", "pitch", "heading", "u", "v", "w", "p", "q", "r",
            "moving_mass", "ballast", "rudder", "roll_mass", "phase", "measured_pitch", "measured_heading",
            "measured_depth", "density", "temperature", "salinity", "current_north", "current_east", "bottom_depth",
            "reckoned_latitude", "reckoned_longitude", "voltage", "current", "internal_pressure",
        ),
        ("energy", "f8", (len(CONSUMERS),)),
    ]
)  # fmt: skip
"""A row of the record, all of one moment; SI units and radians. `u`, `v`, `w` are those of the hull through the
water."""

SAMPLE = np.dtype(
    _numbers("time", "latitude", "longitude", "pressure", "thermistor", "cell", "salinity", "phase", "dive")
)
"""A sample of the CTD: believed position, true pressure, temperature of thermistor and of the conductivity cell, true
salinity; phase and number of the dive, from 1."""

SURFACING = np.dtype(
    _numbers(
        "time", "latitude", "longitude", "current_north", "current_east", "true_current_north", "true_current_east",
        "reckoning_error", "submerged", "dive",
    )
)  # fmt: skip
"""A stay at the surface that ended with a dive."""

EVENT = np.dtype(_numbers("time", "phase", "latitude", "longitude", "depth", "reason"))
"""Every change of phase, and why where a dive or the mission ends."""

OUTSIDE_DATA = len(EVENTS)
RATING_PASSED = OUTSIDE_DATA + 1
REASONS = (*EVENTS, "outside the ocean's data", "hull rating passed")
"""Why: what the software says, and what the simulator adds."""

ROWS, SURFACINGS, EVENT_ROWS, SAMPLES = range(4)
"""Places of how many rows are filled, in `Log.counts`; the ocean cell follows."""
CELL = slice(4, 6)


class Log(NamedTuple):
    """What a mission leaves."""

    record: NDArray[np.void]
    """`ROW` over time."""
    samples: NDArray[np.void]
    """`SAMPLE`."""
    surfacings: NDArray[np.void]
    """`SURFACING`."""
    events: NDArray[np.void]
    """`EVENT`."""
    counts: NDArray[np.int64]
    """How many rows of each are filled, and the cell of the ocean where the vehicle was last."""
