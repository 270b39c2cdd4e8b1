"""The words on the vehicle's wires: the CAN database and what guards its frames."""
