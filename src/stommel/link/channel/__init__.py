"""A radio channel on virtual time, for tests, the simulated vehicle and training."""
