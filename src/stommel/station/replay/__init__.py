"""Past missions as if they were flown now."""
