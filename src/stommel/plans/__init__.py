"""From a plan on the map to orders that a vehicle understands."""
