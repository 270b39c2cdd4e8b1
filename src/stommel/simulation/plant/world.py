"""What the world knows beyond the state of the equations of motion."""

import numpy as np

from stommel.simulation.plant.parameters import CONSUMERS
from stommel.simulation.scenario.scenario_file import LONGEST_LATENCY

WORLD = np.dtype(
    [
        # where the vehicle is
        ("latitude", "f8"), ("longitude", "f8"), ("metres_north", "f8"), ("metres_east", "f8"),
        ("afloat", "i8"), ("rising", "i8"), ("too_deep", "i8"), ("outside", "i8"), ("speed", "f8"),
        # machinery
        ("steering", "f8"), ("pumping", "i8"), ("valve_open", "i8"), ("mass_moving", "i8"), ("steering_moving", "i8"),
        ("V_b_wanted", "f8"), ("moved_at", "f8"),
        # battery and loads
        ("energy", "f8", (len(CONSUMERS),)), ("energy_total", "f8"),
        ("voltage", "f8"), ("current", "f8"),
        ("calling", "i8"), ("called_at", "f8"),
        # inside the hull
        ("leaked", "f8"), ("dropping", "i8"), ("dropped", "f8"), ("air_temperature", "f8"), ("internal_pressure", "f8"),
        # sensors
        ("thermistor", "f8"), ("cell_error", "f8"), ("water_before", "f8"),
        ("measured", "f8", (LONGEST_LATENCY, 5)),
        ("listening", "i8"), ("received", "f8"),
        ("fixed", "i8"), ("fix_time", "f8"), ("fix_latitude", "f8"), ("fix_longitude", "f8"),
        # truth to hold the software's beliefs against
        ("current_sum_north", "f8"), ("current_sum_east", "f8"), ("current_time", "f8"), ("reckoning_error", "f8"),
    ]
)  # fmt: skip
"""Fields of the world; SI units, radians, seconds of the mission."""


def new_world() -> np.record:
    """Return a world in which nothing has happened yet."""
    world: np.record = np.zeros(1, WORLD).view(np.recarray)[0]
    world.afloat, world.moved_at = 1, -1e9
    return world
