"""One line to each vehicle, and what can be asked of it."""
