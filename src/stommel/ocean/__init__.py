"""The ocean around a mission: temperature, salinity, currents and bottom depth in space and time."""
