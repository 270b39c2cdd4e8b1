"""A scenario: the plan of a mission, and the world that it is flown in."""
