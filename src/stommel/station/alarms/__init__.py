"""Limits of channels, what became of them, and words to people who are away."""
