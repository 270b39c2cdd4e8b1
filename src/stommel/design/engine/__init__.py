"""Buoyancy engine: its parts and circuit, simulation, steady pumping, energy of an inflation (docs/theory/engine)."""
