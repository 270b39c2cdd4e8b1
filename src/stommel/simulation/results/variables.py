"""Names, units and meanings of what a mission's Dataset holds: a table, after CF 1.10."""

from typing import Any

from stommel.control.dive_cycle import PHASES
from stommel.simulation.results.energy import DRAINS
from stommel.simulation.results.events import NAMES

Attributes = dict[str, Any]

TIME = {"standard_name": "time", "long_name": "time", "axis": "T"}

PLACES: dict[str, Attributes] = {
    "latitude": {"standard_name": "latitude", "long_name": "latitude", "units": "degrees_north"},
    "longitude": {"standard_name": "longitude", "long_name": "longitude", "units": "degrees_east"},
}

_THROUGH_WATER = "velocity of the centre of buoyancy through the water"

RECORD: dict[str, tuple[str, float, Attributes]] = {
    "depth": (
        "depth",
        1.0,
        {"standard_name": "depth", "long_name": "depth", "units": "m", "positive": "down", "axis": "Z"},
    ),
    "roll": ("roll", 0.0, {"standard_name": "platform_roll", "long_name": "roll, starboard down", "units": "degree"}),
    "pitch": ("pitch", 0.0, {"standard_name": "platform_pitch", "long_name": "pitch, nose up", "units": "degree"}),
    "heading": (
        "heading",
        0.0,
        {"standard_name": "platform_orientation", "long_name": "true heading, clockwise from north", "units": "degree"},
    ),
    "surge": ("u", 1.0, {"long_name": f"{_THROUGH_WATER}, forward", "units": "m s-1"}),
    "sway": ("v", 1.0, {"long_name": f"{_THROUGH_WATER}, to starboard", "units": "m s-1"}),
    "heave": ("w", 1.0, {"long_name": f"{_THROUGH_WATER}, down through the keel", "units": "m s-1"}),
    "roll_rate": ("p", 0.0, {"long_name": "roll rate, about b1", "units": "degree s-1"}),
    "pitch_rate": ("q", 0.0, {"long_name": "pitch rate, about b2", "units": "degree s-1"}),
    "yaw_rate": ("r", 0.0, {"long_name": "yaw rate, about b3", "units": "degree s-1"}),
    "moving_mass_position": (
        "moving_mass",
        1.0,
        {"long_name": "position of the moving mass forward of the centre of buoyancy", "units": "m"},
    ),
    "ballast_volume": ("ballast", 1e6, {"long_name": "ballast volume, positive rises", "units": "ml"}),
    "rudder_angle": ("rudder", 0.0, {"long_name": "rudder angle", "units": "degree"}),
    "roll_mass_angle": ("roll_mass", 0.0, {"long_name": "roll angle of the moving mass", "units": "degree"}),
    "measured_pitch": ("measured_pitch", 0.0, {"long_name": "pitch by the tilt sensor", "units": "degree"}),
    "measured_heading": (
        "measured_heading",
        0.0,
        {"long_name": "magnetic heading by the compass, tilt compensated", "units": "degree"},
    ),
    "measured_depth": (
        "measured_depth",
        1.0,
        {"long_name": "depth by the pressure sensor", "units": "m", "positive": "down"},
    ),
    "density": (
        "density",
        1.0,
        {"standard_name": "sea_water_density", "long_name": "density in situ", "units": "kg m-3"},
    ),
    "temperature": (
        "temperature",
        1.0,
        {"standard_name": "sea_water_temperature", "long_name": "temperature in situ", "units": "degree_C"},
    ),
    "salinity": (
        "salinity",
        1.0,
        {"standard_name": "sea_water_absolute_salinity", "long_name": "Absolute Salinity", "units": "g kg-1"},
    ),
    "current_north": (
        "current_north",
        1.0,
        {"standard_name": "northward_sea_water_velocity", "long_name": "current to the north", "units": "m s-1"},
    ),
    "current_east": (
        "current_east",
        1.0,
        {"standard_name": "eastward_sea_water_velocity", "long_name": "current to the east", "units": "m s-1"},
    ),
    "bottom_depth": (
        "bottom_depth",
        1.0,
        {"standard_name": "sea_floor_depth_below_sea_surface", "long_name": "depth of the bottom", "units": "m"},
    ),
    "battery_voltage": ("voltage", 1.0, {"long_name": "voltage of the battery, measured", "units": "V"}),
    "battery_current": ("current", 1.0, {"long_name": "current out of the battery, measured", "units": "A"}),
    "internal_pressure": (
        "internal_pressure",
        1.0,
        {"long_name": "absolute pressure of the air in the hull, measured", "units": "Pa"},
    ),
    "reckoned_latitude": (
        "reckoned_latitude",
        0.0,
        {"long_name": "latitude that the vehicle believes, by dead reckoning", "units": "degrees_north"},
    ),
    "reckoned_longitude": (
        "reckoned_longitude",
        0.0,
        {"long_name": "longitude that the vehicle believes, by dead reckoning", "units": "degrees_east"},
    ),
}
"""Variable: its column in the record, the factor from SI (0 for radians to degrees), its attributes."""

ENERGY: dict[str, Attributes] = {
    f"energy_{consumer}": {
        "long_name": f"energy from the battery since the start: {consumer.replace('_', ' ')}",
        "units": "J",
    }
    for consumer in DRAINS
}

SAMPLES: dict[str, Attributes] = {
    "pressure": {
        "standard_name": "sea_water_pressure_due_to_sea_water",
        "long_name": "sea pressure by the CTD",
        "units": "dbar",
    },
    "temperature": {
        "standard_name": "sea_water_temperature",
        "long_name": "temperature in situ by the CTD",
        "units": "degree_C",
    },
    "conductivity": {
        "standard_name": "sea_water_electrical_conductivity",
        "long_name": "conductivity by the CTD, with the lag of its cell",
        "units": "S m-1",
    },
    "practical_salinity": {
        "standard_name": "sea_water_practical_salinity",
        "long_name": "practical salinity by the CTD, lags not corrected",
        "units": "1",
    },
}
"""Measured by the CTD, one of each a sample."""

PROFILE: Attributes = {
    "long_name": "number of the profile: descents odd, ascents even, from 1; 0 between them",
    "units": "1",
}

PHASE: Attributes = {
    "long_name": "phase of the dive cycle",
    "flag_values": list(range(len(PHASES))),
    "flag_meanings": " ".join(PHASES),
}

REASON: Attributes = {
    "long_name": "why the dive or the mission ended, or what happened",
    "flag_values": list(range(len(NAMES))),
    "flag_meanings": " ".join(event.replace(":", "").replace("'", "").replace(" ", "_") for event in NAMES),
}

SURFACINGS: dict[str, tuple[str, Attributes]] = {
    "depth_averaged_current_north": (
        "current_north",
        {
            "standard_name": "northward_sea_water_velocity",
            "long_name": "depth-averaged current of the dive before, by dead reckoning against GPS, to the north",
            "units": "m s-1",
            "cell_methods": "surfacing: mean (of the dive before)",
        },
    ),
    "depth_averaged_current_east": (
        "current_east",
        {
            "standard_name": "eastward_sea_water_velocity",
            "long_name": "depth-averaged current of the dive before, by dead reckoning against GPS, to the east",
            "units": "m s-1",
            "cell_methods": "surfacing: mean (of the dive before)",
        },
    ),
    "true_current_north": (
        "true_current_north",
        {"long_name": "true mean of the current along the dive before, to the north", "units": "m s-1"},
    ),
    "true_current_east": (
        "true_current_east",
        {"long_name": "true mean of the current along the dive before, to the east", "units": "m s-1"},
    ),
    "reckoning_error": (
        "reckoning_error",
        {"long_name": "distance of the believed from the true position on surfacing", "units": "m"},
    ),
    "time_submerged": ("submerged", {"long_name": "time under water before this surfacing", "units": "s"}),
    "dive_number": ("dive", {"long_name": "number of the dive that ended here", "units": "1"}),
}
"""Variable: its column in the list of surfacings, its attributes."""

EVENT_WAYPOINT: Attributes = {"long_name": "number of the waypoint that it is about, 0 for none", "units": "1"}

SOUGHT: Attributes = {"long_name": "number of the waypoint that is sought, 0 for none", "units": "1"}
TO_WAYPOINT: Attributes = {"long_name": "true distance to the waypoint that is sought", "units": "m"}

ACCEPTANCE_RADIUS: Attributes = {"long_name": "distance within which a waypoint counts as reached", "units": "m"}

WAYPOINT_REACHED: Attributes = {
    "long_name": "whether the waypoint was reached, by the vehicle's own account",
    "flag_values": [0, 1],
    "flag_meanings": "not_reached reached",
}
WAYPOINTS: dict[str, Attributes] = {
    "waypoint_reached_after": {
        "long_name": "time from the start until the waypoint was reached, by the vehicle's own account",
        "units": "s",
    },
    "waypoint_closest_approach": {
        "long_name": "nearest that the vehicle truly came while it sought the waypoint",
        "units": "m",
    },
    "waypoint_distance": {
        "long_name": "true distance from the waypoint when it was reached, or at the end of the mission",
        "units": "m",
    },
    "leg_length": {"long_name": "length of the leg to the waypoint, from the one before or the start", "units": "m"},
    "leg_time": {"long_name": "time for which the waypoint was sought", "units": "s"},
    "leg_over_ground": {"long_name": "way over ground while the waypoint was sought", "units": "m"},
    "leg_made_good": {"long_name": "by how much the waypoint came nearer", "units": "m"},
    "leg_beside_line_rms": {
        "long_name": "root mean square distance from the rhumb line of the leg",
        "units": "m",
    },
    "leg_beside_line_greatest": {"long_name": "greatest distance from the rhumb line of the leg", "units": "m"},
}
"""One of each a waypoint; not a number where it was never reached or sought."""
