"""Flies missions: plant (actuators, sensors, power), the compiled loop, results, studies of many missions."""
