"""The coordination layer: what the vehicle does next, where it is, what it keeps, and when it comes up."""
