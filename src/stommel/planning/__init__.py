"""From a mission to orders: ballast, laws, waypoints."""
