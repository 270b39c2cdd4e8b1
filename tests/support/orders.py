"""Orders as text, small and sound."""

_WAY = """
moving_mass_m = [[0.25, 0.26], [0.27, 0.28]]
angle_of_attack_rad = [[0.02, 0.02], [0.03, 0.03]]
speed_m_s = [[0.2, 0.3], [0.25, 0.35]]
turn_pole_per_s = [[-0.1, -0.1], [-0.2, -0.2]]
turn_drive_per_s2 = [[0.01, 0.01], [0.02, 0.02]]
"""
ORDERS = f"""\
format = 1
kind = "orders"
mission = "There and back"
created_from = "there.toml"
vehicle = "mine"
vehicle_sha256 = "{"0" * 64}"
physics = "full"
density_kg_m3 = 1025.0
stommel = "0"
expires_hours = 48.0
step_s = 1.0
guidance_every = 10
sampled_phases = ["descent", "ascent"]
waypoints_rad = [[0.52, 2.09], [0.53, 2.1]]
acceptance_radius_m = 500.0
lookahead_m = 3000.0

[dives]
depth_m = 100.0
turns_early_m = 2.0
pitch_rad = 0.6
ballast_dive_m3 = -1e-4
ballast_climb_m3 = 2e-4
ballast_surface_m3 = 3e-4
ballast_drift_m3 = 1e-5
moving_mass_drift_m = 0.25
surface_s = 300.0
longest_surface_s = 1800.0
drift_s = 0.0
least_altitude_m = 10.0
surfaced_depth_m = 1.0
per_surfacing = 2
turn_depth_m = 10.0
abort_depth_m = 110.0
abort_time_s = 43200.0

[pitch_control]
gain_m_per_rad = 0.07
dead_band_rad = 0.009
period_s = 120.0
tolerance_m = 0.0005

[heading_control]
response_s = 30.0
dead_band_rad = 0.017
limit_rad = 0.17

[drift_control]
gain_m3_s_m = 6e-5
return_time_s = 600.0
fastest_m_s = 0.05
dead_band_m = 3.0
period_s = 60.0

[alarms]
energy_j = 3e6
leak = true

[flight_table]
drag_per_mass_per_m = 0.03
pitch_rad = [0.3, 0.6]
ballast_m3 = [1e-4, 2e-4]
[flight_table.dive]{_WAY}
[flight_table.climb]{_WAY}
"""
