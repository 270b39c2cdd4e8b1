"""The plan that a vehicle is told: waypoints, dives, surfacing, aborts, control, sampling."""
