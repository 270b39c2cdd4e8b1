"""Files of a vehicle's software: the shortest configuration that is read, and a calibration of a compass."""

CONFIGURATION = """
format = 1
kind = "vehicle configuration"
vehicle = "x"
vehicle_id = 3
[limits]
vehicle_sha256 = "{digest}"
ballast_ml = [-250.0, 250.0]
moving_mass_mm = [-50.0, 550.0]
steering_deg = 60.0
depth_rating_m = 200.0
[positions]
nose_up_mm = 100.0
surface_mm = 490.0
calling_mm = 490.0
[compass]
port = "/dev/a"
[gnss]
port = "/dev/b"
[radio]
port = "/dev/c"
[safety]
submerged_depth_m = 2.0
longest_submerged_hours = 25.0
turning_time_s = 220.0
least_voltage_v = 19.0
lowest_voltage_v = 17.0
greatest_voltage_v = 28.0
greatest_current_a = 6.0
vacuum_lost_kpa = 80.0
hull_flooding_kpa = 106.0
""".format(digest="0" * 64)
CALIBRATION = """
format = 1
kind = "compass calibration"
hard_iron_ut = [9.0, -14.0, 6.0]
correction = [[1.0, 0.02, 0.0], [0.02, 0.95, 0.0], [0.0, 0.0, 1.05]]
believed_ut = [35.0, 60.0]
[actuator_ut]
pump = [4.0, 5.0, 3.0]
"""
