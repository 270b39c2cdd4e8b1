"""What can be set of the vehicle's nodes: the nodes and the coordinator both know it."""
