"""Oceans in closed form, and a profile that stands everywhere."""
