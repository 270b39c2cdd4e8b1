"""What the mission loop remembers from one decision to the next, and what it writes down."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.simulation.plant.parameters import CONSUMERS
from stommel.simulation.scenario.mission_file import LONGEST_LATENCY

Array = NDArray[np.float64]

STATE_COLUMNS = (
    "time", "latitude", "longitude", "depth", "roll", "pitch", "heading", "u", "v", "w", "p", "q", "r",
    "moving_mass", "ballast", "rudder", "roll_mass", "phase", "measured_pitch", "measured_heading", "measured_depth",
    "density", "temperature", "salinity", "current_north", "current_east", "bottom_depth",
    "reckoned_latitude", "reckoned_longitude", "voltage", "current", "internal_pressure",
    *(f"energy_{consumer}" for consumer in CONSUMERS),
)  # fmt: skip
"""Columns of the record."""

SAMPLE_COLUMNS = (
    "time", "latitude", "longitude", "pressure", "thermistor", "cell", "salinity", "phase",
)  # fmt: skip
"""Columns of the CTD's samples: believed position, true pressure, temperature of thermistor and of the conductivity
cell, true salinity."""

SURFACING_COLUMNS = (
    "time", "latitude", "longitude", "current_north", "current_east", "true_current_north", "true_current_east",
    "reckoning_error", "submerged", "dive",
)  # fmt: skip
"""Columns of the list of surfacings."""

EVENT_COLUMNS = ("time", "phase", "latitude", "longitude", "depth", "reason")
"""Columns of the list of events: every change of phase, and why where a dive or the mission ends."""

ROWS, SURFACINGS, EVENTS, SAMPLES = range(4)
"""Places of how many rows are filled, in `Log.counts`; the ocean cell follows."""
CELL = slice(4, 6)


class Log(NamedTuple):
    """What a mission leaves."""

    record: Array
    """Rows over time, `STATE_COLUMNS`."""
    samples: Array
    """`SAMPLE_COLUMNS`."""
    surfacings: Array
    """`SURFACING_COLUMNS`."""
    events: Array
    """`EVENT_COLUMNS`."""
    counts: NDArray[np.int64]
    """How many rows of each are filled, and the cell of the ocean where the vehicle was last."""


SOFTWARE_STATE = np.dtype(
    [
        ("phase", "f8"), ("since", "f8"), ("submerged_since", "f8"), ("dives", "f8"), ("dives_here", "f8"),
        ("event", "f8"), ("alarm", "i8"),
        ("waypoint", "i8"), ("line_latitude", "f8"), ("line_longitude", "f8"),
        ("heading_wanted", "f8"), ("steering", "f8"), ("correction", "f8"), ("corrected_at", "f8"),
        ("drift_correction", "f8"), ("drift_corrected_at", "f8"),
        ("depth_before", "f8"), ("path_speed", "f8"), ("vertical_speed", "f8"),
        ("heading_before", "f8"), ("turning", "f8"),
        ("latitude", "f8"), ("longitude", "f8"), ("metres_north", "f8"), ("metres_east", "f8"),
        ("reckoned_north", "f8"), ("reckoned_east", "f8"),
        ("submerged_latitude", "f8"), ("submerged_longitude", "f8"),
        ("surfaced_at", "f8"), ("under_water", "f8"), ("adrift", "f8"), ("reckoning_error", "f8"),
        ("received", "f8"), ("first_fix_at", "f8"), ("first_fix_latitude", "f8"), ("first_fix_longitude", "f8"),
        ("fix_at", "f8"), ("fix_latitude", "f8"), ("fix_longitude", "f8"),
        ("current_north", "f8"), ("current_east", "f8"), ("energy_used", "f8"),
    ]
)  # fmt: skip
"""What the vehicle's own software remembers from one decision to the next."""

PLANT_STATE = np.dtype(
    [
        ("latitude", "f8"), ("longitude", "f8"), ("metres_north", "f8"), ("metres_east", "f8"),
        ("afloat", "i8"), ("outside", "i8"), ("speed", "f8"),
        ("steering", "f8"), ("pumping", "i8"), ("valve_open", "i8"), ("mass_moving", "i8"), ("steering_moving", "i8"),
        ("moved_at", "f8"), ("energy", "f8", (len(CONSUMERS),)), ("energy_total", "f8"),
        ("voltage", "f8"), ("current", "f8"),
        ("leaked", "f8"), ("air_temperature", "f8"), ("internal_pressure", "f8"),
        ("thermistor", "f8"), ("cell_error", "f8"), ("water_before", "f8"),
        ("measured", "f8", (LONGEST_LATENCY, 3)),
        ("current_sum_north", "f8"), ("current_sum_east", "f8"), ("current_time", "f8"),
    ]
)  # fmt: skip
"""What the world knows beyond the state of the equations of motion."""
