"""Vectors, attitude and the ellipsoid, for compiled code and plain Python alike."""
