"""The one port to the simulation: what a plan would become."""
