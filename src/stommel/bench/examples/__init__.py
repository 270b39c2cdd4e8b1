"""Bench tests that ship with stommel: published rows, with their source in the file."""
