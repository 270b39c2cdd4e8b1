"""Seawater by TEOS-10: density, sound speed, freezing, pressure, stratification, a density table for compiled code."""
