"""Campaigns: many missions with random faults, what became of them, and the fewest faults that still do harm."""
