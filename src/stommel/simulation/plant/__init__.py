"""The vehicle as metal: actuators, power, sensors, hull air, waves, motion."""
