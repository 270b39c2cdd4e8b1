"""What the vehicle's software remembers from one decision to the next: one record of plain numbers."""

import numpy as np

MEMORY = np.dtype(
    [
        # the dive cycle
        ("phase", "f8"), ("since", "f8"), ("submerged_since", "f8"), ("dives", "f8"), ("dives_here", "f8"),
        ("event", "f8"), ("alarm", "i8"), ("surfaced_at", "f8"), ("under_water", "f8"),
        # guidance
        ("waypoint", "i8"), ("under_way", "i8"), ("until_guidance", "i8"), ("line_latitude", "f8"),
        ("line_longitude", "f8"), ("heading_wanted", "f8"),
        # laws of the actuators
        ("steering", "f8"), ("correction", "f8"), ("corrected_at", "f8"), ("drift_correction", "f8"),
        ("drift_corrected_at", "f8"), ("heading_before", "f8"), ("turning", "f8"),
        # dead reckoning
        ("depth_before", "f8"), ("path_speed", "f8"), ("vertical_speed", "f8"), ("latitude", "f8"),
        ("longitude", "f8"), ("metres_north", "f8"), ("metres_east", "f8"), ("reckoned_north", "f8"),
        ("reckoned_east", "f8"), ("submerged_latitude", "f8"), ("submerged_longitude", "f8"), ("adrift", "f8"),
        ("averaged_over", "f8"),
        # positions
        ("first_fix_at", "f8"), ("first_fix_latitude", "f8"), ("first_fix_longitude", "f8"), ("fix_at", "f8"),
        ("fix_latitude", "f8"), ("fix_longitude", "f8"), ("current_north", "f8"), ("current_east", "f8"),
        # energy account
        ("energy_used", "f8"),
    ]
)  # fmt: skip
"""Fields of the memory; SI units, radians, seconds of the mission."""


def new_memory(latitude: float, longitude: float, heading: float) -> np.record:
    """Memory of software that is switched on at a known place [rad], to hold a heading [rad] until it has a goal."""
    memory: np.record = np.zeros(1, MEMORY).view(np.recarray)[0]
    memory.latitude = memory.submerged_latitude = memory.line_latitude = latitude
    memory.longitude = memory.submerged_longitude = memory.line_longitude = longitude
    memory.heading_wanted = memory.heading_before = heading
    memory.first_fix_at = -1.0
    return memory
