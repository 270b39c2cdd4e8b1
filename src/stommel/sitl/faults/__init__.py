"""What can break in the loop: the table of faults, and what puts them into the plant, the bus, the nodes, the ports."""
