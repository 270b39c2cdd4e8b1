"""The edge of the vehicle's software: real ports, the real bus, the real disk and clock around the coordinator."""
