"""The format of a vehicle's log: what the vehicle writes and everybody else reads."""
