"""Instruments: drivers that turn bytes into readings, and devices that speak the same bytes in a simulation."""
