"""The whole system in the loop: plant, nodes, instruments and coordination software on virtual time."""
