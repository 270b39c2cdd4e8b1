"""Flies missions: scenario, plant (actuators, sensors, power), the compiled loop, results and pictures."""
