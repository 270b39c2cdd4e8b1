"""The compass on a vehicle of iron and motors: calibration, the fields of the actuators, the heading that is left."""
