"""Routes, a module for each concern."""
